"""What point and line contacts have in common: a body pressed on a lubricated flat."""

from dataclasses import asdict, replace
from itertools import product

import numpy as np

from mgehl.config_value import AUTO, FARTHEST
from mgehl.kinds import loaded_checks, surface, time
from mgehl.kinds.bodies import roughness
from mgehl.kinds.domain_in_time import on_all_sides, reverses
from mgehl.kinds.friction import check_friction, friction_from, thinning_words
from mgehl.kinds.heat import check_factor, factor_words, heat_words, heated, solids_from
from mgehl.kinds.kind import Effort, Kind, film_unit, kept_together, pressure_unit
from mgehl.kinds.lubricant import check_laws, lubricant_from
from mgehl.model.films import formula_of
from mgehl.model.own_laws import OwnDensity
from mgehl.model.room import domain_for, interval_on_nodes
from mgehl.model.starvation import Starvation

RELAXATION = Effort(
    2e4, 1e-7, 1e-3, 500.0, "the relaxation has one a sweep, up to relaxation.max_sweeps"
)  # fmt: skip

BANDS, BANDS_WORDS = 10.0, "bands 2 to 23 more"
"""Convolutions that coarser grids take for the bands about a film."""


class LoadedKind(Kind):
    """A contact whose film and pressure answer to a load."""

    is_loaded = True
    load_key: str
    """The key of the load."""
    load_unit: str
    """Its SI unit."""

    def check_keys(self, config):
        """Neither the laws of the lubricant nor the surfaces may contradict themselves."""
        if not config.is_dry:
            time.check_motion(config)
        time.check_courses(config)
        surface.check_keys(config)
        check_laws(config)
        check_friction(config)

    def contact(self, config):
        """The contact, its oil thinned where heat thins its film."""
        section, friction, solids = config.contact, friction_from(config), solids_from(config)
        shared = {"lubricant": lubricant_from(config), "surface": surface.surface_from(config)}
        shared |= {"radius_x": section.radius_x, "reduced_modulus": section.reduced_modulus}
        shared |= {"tears": config.discretization.cavitation is not False}
        return heated(config, self.pressed(config, shared | {"friction": friction, "solids": solids}))

    def pressed(self, config, shared):
        """The contact, of what all kinds have in common and its own keys."""
        raise NotImplementedError

    def with_domain(self, config, contact):
        """With numbers where the domain is "auto"."""
        names = [name for name in ("x" if contact.is_line else "xy") if getattr(config.grid, name) == AUTO]
        if not names:
            return config
        ends = dict(zip("xy", self._domain(config, contact), strict=True))
        ends = on_all_sides(config, ends, contact.is_line)
        return replace(config, grid=replace(config.grid, **{name: ends[name] for name in names}))

    def _domain(self, config, contact):
        """The ends along x and y, in semi-axes of the first load, of a domain for every load of a run."""
        contacts = [
            turned for each in time.extremes(config, contact) for turned in time.towards_all(config, each)
        ]
        found = [self.domain(each, config.grid.nodes) for each in contacts]
        if len(found) == 1:
            return found[0]
        wide = np.array([each.x_scale / contact.x_scale for each in contacts])
        farthest = np.minimum(FARTHEST, np.max(wide[:, None, None] * np.abs(found), axis=0))
        return [interval_on_nodes(*map(float, ends)) if any(ends) else (0.0, 0.0) for ends in farthest]

    def domain(self, contact, nodes):
        """The ends along x and y of a domain as small as the film of a formula and the peaks that may touch
        allow, with most room upstream. Layered bodies count as half-spaces whose contact is as wide.
        """
        return domain_for(Starvation(contact, contact.flooded_film), nodes, FARTHEST)

    def check(self, config, contact):
        """The contact must be small beside the bodies; otherwise as `check_fluid`."""
        loaded_checks.check_deformation(config, contact)
        heaviest = time.extremes(config, contact)[-1]
        loaded_checks.check_size(*self.size(config, heaviest))
        loaded_checks.check_bodies(self.load_key, config, heaviest)
        if not config.is_dry:
            loaded_checks.check_exponent(heaviest)
        if contact.surface is not None:
            surface.check_known(config, contact)
        check_factor(config, heaviest)
        config = self.with_domain(config, contact)
        if contact.surface is not None:
            surface.check_surfaces(config, contact, self.mesh(config, contact))
        self.check_fluid(config.grid, contact)
        if config.is_in_time:
            self._check_in_all_directions(config, contact, heaviest)

    def _check_in_all_directions(self, config, contact, heaviest):
        """The domain must be large enough for every direction of a run in time, under the heaviest load."""
        senses, wide = (1.0, -1.0)[: 1 + reverses(config)], heaviest.x_scale / contact.x_scale
        for sense, turned in product(senses, time.towards_all(config, heaviest)):
            loaded_checks.check_domain(config.grid, turned, sense, wide)

    def check_fluid(self, grid, contact):
        """Laws must give numbers; the domain must be large enough for contact and inlet."""
        loaded_checks.check_own_laws(contact)
        loaded_checks.check_exponent(contact)
        loaded_checks.check_domain(grid, contact)

    def size(self, config, contact):
        """The key that the dry contact's size follows from, size and radii in words, and their ratio."""
        raise NotImplementedError

    def effort(self, config):
        """The `Effort` of the relaxation or of Newton's method."""
        if config.solver.by_newton:
            effort = self.newton_effort(config)
            return _with_bands(effort) if config.solver.error and config.solver.from_film else effort
        sweeps = float(config.relaxation.max_sweeps)
        return replace(RELAXATION, convolutions=sweeps)

    def newton_effort(self, config):
        """The `Effort` of a run by Newton's method."""
        raise NotImplementedError

    def load(self, contact):
        """The load and its unit as people say it."""
        raise NotImplementedError

    def hertz_words(self, hertz):
        """Size of the dry contact."""
        return f"a {1e3 * hertz.a:.4g} mm"

    def lines(self, config, contact, mesh):
        """Groups, dry contact, films of formulas with what they assume, load and speed."""
        stands, first = time.stands_still(config), time.of_first_load(config)
        own = contact.unheated
        groups = "   ".join(f"{name} {value:.4g}" for name, value in asdict(own.groups).items())
        moving = [f"groups     {groups}", f"regime     {own.regime} (Moes)"]
        speed = 0.0 if stands else contact.speed
        return [
            *([] if stands else moving),
            f"Hertz      {self.hertz_words(contact.hertz)}   {p_h_words(contact.hertz)}{first}",
            *([] if stands else _films(config, contact)),
            f"load       {_over_time(config, self.load_key, contact.load)} {self.load_unit}   "
            f"speed {_over_time(config, 'motion.speed', speed)} m/s, the mean of both surfaces' "
            "speeds",
        ]

    def parts(self, solution, times="x"):
        """Speed, of a course the largest one, load, of a course the least and the largest, and nodes."""
        config, contact, nodes = solution.config, solution.contact, self.nodes(solution.mesh, times)
        stands = time.stands_still(config)
        up_to = "up to " if isinstance(config.motion.speed, str) and not stands else ""
        load = " to ".join(" ".join(self.load(each)) for each in time.extremes(config, contact))
        return [up_to + speed_words(0.0 if stands else contact.speed), load, nodes]

    def heading(self, solution):
        """Kind, speed, load and nodes."""
        return ", ".join([self.noun.capitalize(), *map(kept_together, self.parts(solution, times="×"))])

    def position_labels(self, contact):
        """Over the semi-axes of the dry contact."""
        a, b = 1e3 * contact.x_scale, 1e3 * contact.y_scale
        return f"X = x/a, a = {a:.4g} mm", f"Y = y/b, b = {b:.4g} mm"


def _films(config, contact):
    """Films of formulas and what they assume, lambda, heat."""
    compared = contact.unheated.compared
    scale, unit = film_unit(max(compared.values()))
    shown = "   ".join(f"{name.replace('_', ' ')} {scale * film:.4g}" for name, film in compared.items())
    yield f"films, {unit}  {shown}{time.of_formulas(config)}"
    heads = {
        "": assumptions(contact),
        "lambda": lambda_words(config, contact.expected_film, "a formula's"),
        "heat": (*factor_words(contact), *heat_words(config, contact)),
        "thinned": thinning_words(contact),
    }
    yield from (f"{head:11}{words}" for head, lines in heads.items() for words in lines)


def _over_time(config, key, value):
    """A value of a contact, or from where to where it goes in time."""
    least, most = time.range_of(config, key)
    return f"{value:.6g}" if least == most or config.moes.M is not None else f"{least:.6g} to {most:.6g}"


def _with_bands(effort):
    """The `Effort` of a run whose films get bands, too."""
    measured = f"{effort.measured}, {BANDS_WORDS}"
    return replace(effort, convolutions=effort.convolutions + BANDS, measured=measured)


def assumptions(contact):
    """What the formulas of a contact assume, a few words each; they know the oil's own viscosity."""
    contact = contact.unheated
    bodies = "smooth bodies"
    if contact.deformation is not None:
        known = contact.in_formulas.reduced_modulus != contact.reduced_modulus
        bodies = f"smooth half-spaces, {'in dry contact as wide' if known else 'not layered'}"
    yield f"all: {bodies}, flooded, isothermal, Newtonian oil"
    told = {formula.label: formula for formula in map(formula_of, contact.shown_formulas)}
    yield from (f"{label}: {formula.assumes}" for label, formula in told.items())
    if contact.is_flattened and any(formula.incompressible for formula in told.values()):
        # A law of the user's own may not be run again where results are read.
        own = isinstance(contact.lubricant.density_law, OwnDensity)
        ratio = "" if own else f"{contact.density_ratio:.4g}, "
        yield (
            f"central films of incompressible oil are divided by {ratio}the oil's density at p_h over that "
            "at rest"
        )


def lambda_words(config, film, whose):
    """lambda by a central `film` in m where the bodies' roughness is a number; nothing elsewhere."""
    if rms := roughness(config):
        yield (
            f"{film / rms:.3g}: {whose} central film over {1e9 * rms:.4g} nm rms, whose heights are not "
            "solved"
        )


def p_h_words(hertz):
    """The largest pressure of the dry contact."""
    factor, unit = pressure_unit(1e-9 * hertz.p_h)
    return f"p_h {1e-9 * factor * hertz.p_h:.4g} {unit}"


def speed_words(u):
    """A speed in mm/s, from 1 m/s on in m/s."""
    return f"{u:.4g} m/s" if abs(u) >= 1.0 - 1e-12 else f"{1e3 * u:.4g} mm/s"
