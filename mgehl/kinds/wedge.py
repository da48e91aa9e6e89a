"""The rigid wedge bearing: a plane pad over a plate; a pillar, a pocket or a blocked exit in its film."""

from dataclasses import dataclass

from mgehl.config_value import number, switch, word
from mgehl.discretization.mesh import Mesh
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, value_of, word_of
from mgehl.kinds.kind import Effort, Kind, kept_together
from mgehl.kinds.loaded_checks import check_own_laws_up_to
from mgehl.kinds.lubricant import check_laws, lubricant_from
from mgehl.model.wedge import PILLARS, Pocket, WedgeBearing

LARGEST_ASPECT = 100.0
"""Largest ratio of a pad's length and width."""

FEWEST_CELLS = 2
"""Cells that a pillar or a pocket must have, and the distance from the exit to the line of no gap."""

FILMS = ("wedge.length", "wedge.inlet_film", "wedge.exit_film")
REPLACED = ("wedge.exit", "wedge.inlet", "wedge.slope", "wedge.reversed")
"""Keys that describe a pad by its films, and those that they stand for."""

PILLAR = ("wedge.pillar_x", "wedge.pillar_y", "wedge.pillar_size")
POCKET = ("wedge.pocket_from", "wedge.pocket_to", "wedge.pocket_width")
"""Where a pillar and a pocket are."""

LAWS = ("lubricant.viscosity_law", "lubricant.pressure_viscosity", "lubricant.density_law")
"""Keys that say what a pressure changes."""

STEEPEST = 0.1
"""Largest slope of a pad."""

LARGEST_CHECKED = 1e9
"""Pressure in Pa up to which a user's own laws are checked."""

EFFORT = Effort(
    1.0, 17e-6, 0.1, 900.0, "a wedge makes no convolutions", False
)  # fmt: skip


@dataclass(frozen=True)
class WedgeSection:
    # fmt: off
    exit: float = number(20e-3, "where the pad ends: distance from the line of no gap", "m", 1e-6, 10.0)
    inlet: float = number(50e-3, "where the pad begins: distance from the line of no gap", "m", 1e-6, 10.0)
    width: float = number(20e-3, "width of the pad", "m", 1e-6, 10.0)
    slope: float = number(1e-3, "slope m of the pad", "", 1e-8, STEEPEST)
    length: float | None = number(None, "length of a pad that is described by its films; x then goes from "
        "the inlet with the motion", "m", 1e-6, 10.0)
    inlet_film: float | None = number(None, "film where the pad begins, beside wedge.length", "m", 1e-9,
        0.1)
    exit_film: float | None = number(None, "film where it ends, smaller or larger", "m", 1e-9, 0.1)
    sides: str = word("open", "what is at the sides: the surroundings, or walls (one line of nodes where "
        "nothing varies across)", ("open", "closed"))
    ambient_pressure: float = number(0.0, "pressure around the pad, above that at which the film tears",
        "Pa", 0.0, 1e9)
    pressure_laws: bool = switch(False, "whether viscosity and density follow the pressure, by the laws of "
        "lubricant")
    reversed: bool = switch(False, "turned by 180 degrees: the plate moves with the differencing")
    blocked_exit: bool = switch(False, "no flow at the exit")
    pillar: str = word("none", "rigid pillar between pad and plate", PILLARS)
    pillar_x: float = number(35e-3, "centre of the pillar along the motion", "m", 0.0, 10.0)
    pillar_y: float = number(0.0, "centre of the pillar across the motion", "m", -10.0, 10.0)
    pillar_size: float = number(8e-3, "side or diameter of the pillar", "m", 1e-6, 10.0)
    pocket_depth: float = number(0.0, "depth of a rectangular pocket in the pad, its bottom along the pad "
        "(0: no pocket)", "m", 0.0, 0.1)
    pocket_from: float | None = number(None, "where the pocket begins along x", "m", 0.0, 10.0)
    pocket_to: float | None = number(None, "where it ends along x", "m", 0.0, 10.0)
    pocket_width: float | None = number(None, "its width, about the middle of the pad (unset: the pad's)",
        "m", 1e-6, 10.0)
    # fmt: on

    @property
    def by_films(self):
        """Whether the pad is described by its films."""
        return self.length is not None

    @property
    def ends(self):
        """The pad's first and last x."""
        return (0.0, self.length) if self.by_films else (self.exit, self.inlet)


def pillar_words(pillar):
    """What stands in the film."""
    return "no pillar" if pillar == "none" else f"{pillar} pillar"


def exit_words(blocked):
    """What the exit is."""
    return "exit blocked" if blocked else "exit open"


def pocket_words(depth):
    """What is cut into the pad."""
    return f"pocket {1e6 * depth:.4g} um deep" if depth else "no pocket"


def wedge_choices(tables):
    """Every `Choice` that keys of [wedge] make."""
    if word_of(tables, "wedge.pillar") == "none":
        yield Choice('where wedge.pillar = "none"', (), idle=PILLAR)
    if films := [key for key in FILMS if value_of(tables, key) is not None]:
        yield Choice(f"with {films[0]}", REPLACED, needs=FILMS)
    if word_of(tables, "contact.kind") == "wedge" and not value_of(tables, "wedge.pressure_laws"):
        yield Choice("without wedge.pressure_laws = true", LAWS)
    depth = value_of(tables, "wedge.pocket_depth")
    if depth:
        yield Choice("beside wedge.pocket_depth", (), needs=POCKET[:2])
    elif depth is not None:
        yield Choice("without wedge.pocket_depth", POCKET)


class WedgeKind(Kind):
    """A pad whose gap is given: no load, no elasticity; constant viscosity and density, or laws of them."""

    name, noun, model = "wedge", "wedge bearing", WedgeBearing
    about = "A rigid wedge bearing, with a pillar, a pocket or a blocked exit in its film."
    takes = (
        "wedge", "lubricant", "motion.speed", "grid.nodes", "discretization.couette",
        "discretization.face_mobility", "discretization.couette_at_interface",
        "discretization.cavitation", "solver.tolerance", "solver.max_steps",
        "solver.squeeze",  # without effect, but every configuration.toml of a wedge has it
    )  # fmt: skip
    essential = {
        "contact.kind": "wedge", "wedge.exit": "20 mm", "wedge.inlet": "50 mm", "wedge.width": "20 mm",
        "wedge.slope": 1e-3, "wedge.pillar": "square",
        "wedge.pillar_x": "35 mm", "wedge.pillar_y": "0 mm", "wedge.pillar_size": "8 mm",
        "lubricant.viscosity": "0.096 Pa*s", "motion.speed": "1 m/s", "grid.nodes": 129,
    }  # fmt: skip
    short = {
        "wedge.blocked_exit": exit_words, "wedge.pillar": pillar_words, "wedge.pocket_depth": pocket_words,
    }  # fmt: skip
    cavitates = False

    def check_keys(self, config):
        """The pad must have a length, its pocket must lie within it, laws must fit the viscosity."""
        if config.wedge.pressure_laws:
            check_laws(config)
        _check_pad(config.wedge)
        if config.wedge.pocket_depth:
            _check_place(config.wedge)

    def contact(self, config):
        """A `WedgeBearing`: x of a pad that is described by its films goes with the motion."""
        section = config.wedge
        side = -1.0 if section.by_films else 1.0
        first, last = sorted(side * end for end in section.ends)
        return WedgeBearing(
            exit=first,
            inlet=last,
            width=section.width,
            **_slope(section),
            viscosity=config.lubricant.viscosity,
            speed=config.motion.speed,
            turned=section.reversed or section.by_films,
            blocked_exit=section.blocked_exit,
            pillar=section.pillar,
            pillar_x=side * section.pillar_x,
            pillar_y=side * section.pillar_y,
            pillar_size=section.pillar_size,
            pocket=_pocket(section, side),
            ambient_pressure=section.ambient_pressure,
            closed_sides=section.sides == "closed",
            laws=lubricant_from(config) if section.pressure_laws else None,
        )

    def mesh(self, config, contact):
        """A square of nodes over the pad and half a cell beyond its exit; a line where all lines are alike.

        The outermost nodes lie on open sides, and half a cell from walls.
        """
        nodes = config.grid.nodes
        x, edges = contact.placement(nodes)
        if contact.is_plane:
            return Mesh(nodes, 1, x, (0.0, 0.0), edges=edges)
        half = 0.5 * contact.width / contact.y_scale
        half *= (nodes - 1) / nodes if contact.closed_sides else 1.0
        return Mesh(nodes, nodes, x, (-half, half), edges=edges)

    def check(self, config, contact):
        """The pad must be a plate, its gap, its pillar and its pocket larger than cells of the grid."""
        wedge, length = config.wedge, config.wedge.ends[1] - config.wedge.ends[0]
        if not (contact.is_plane or 1.0 / LARGEST_ASPECT <= wedge.width / length <= LARGEST_ASPECT):
            raise ConfigError(
                f"wedge.width = {wedge.width:g}: must be within a factor of {LARGEST_ASPECT:g} of the "
                f"pad's length of {length:g}"
            )
        mesh = self.mesh(config, contact)
        dx, dy = _cell(contact, mesh)
        if not wedge.by_films and wedge.exit < FEWEST_CELLS * dx:
            raise ConfigError(
                f"wedge.exit = {wedge.exit:g}: must be at least {FEWEST_CELLS} cells from the line of no "
                f"gap, {FEWEST_CELLS * dx:.3g} with {config.grid.nodes} nodes"
            )
        if wedge.pillar != "none":
            _check_pillar(wedge, FEWEST_CELLS * max(dx, dy), config.grid.nodes)
        if contact.pocket:
            _check_pocket(wedge, (dx, 0.0 if mesh.is_line else dy), config.grid.nodes)
        if wedge.pressure_laws:
            check_own_laws_up_to(contact.lubricant, LARGEST_CHECKED)

    def effort(self, config):
        """One linear solve, or a few."""
        return EFFORT

    def lines(self, config, contact, mesh):
        """Gap, scales, cells, pillar and pocket."""
        section, (dx, dy) = config.wedge, _cell(contact, mesh)
        exit, inlet = (f"{1e6 * film:.4g} um" for film in contact.films)
        size = f"{1e3 * dx:.3g} mm" + ("" if mesh.is_line else f" by {1e3 * dy:.3g} mm")
        left = (
            ""
            if section.by_films
            else f", {section.exit / dx:.1f} from the exit to where the gap would end"
        )
        lines = [
            f"gap        {exit} at the exit, {inlet} at the inlet",
            f"scales     P 1/mm is {1e-6 * contact.pressure_scale:.4g} MPa",
            f"cells      {size}{left}",
        ]
        if section.pillar != "none":
            across = f"{section.pillar_size / dx:.1f} by {section.pillar_size / dy:.1f} cells"
            lines.append(f"pillar     {section.pillar}, {across}")
        if contact.pocket:
            along, across = contact.pocket.along, contact.pocket.width
            wide = "all across" if across >= contact.width else f"by {across / dy:.1f}"
            lines.append(f"pocket     {1e6 * section.pocket_depth:.4g} um deep, "
                         f"{(along[1] - along[0]) / dx:.1f} cells {wide}")  # fmt: skip
        return lines

    def nodes(self, mesh, times="x"):
        """Of the one line, where there is but one."""
        return f"{mesh.nx} nodes" if mesh.is_line else super().nodes(mesh, times)

    def parts(self, solution):
        """What is in the film, the exit, cavitation, the nodes."""
        torn = ["film cavitates"] if solution.result.cavitated_nodes else []
        stands, leaves = _pad(solution.contact)
        return [f"wedge with {stands}", leaves, *torn, self.nodes(solution.mesh)]

    def heading(self, solution):
        """What stands in the film, the exit, the nodes."""
        stands, leaves = _pad(solution.contact)
        nodes = kept_together(self.nodes(solution.mesh, times="×"))
        return ", ".join([f"Wedge bearing with {stands}", leaves, nodes])

    def position_labels(self, contact):
        """In mm."""
        return "X, mm", "Y, mm"

    def scalars(self, solution):
        """Load and pressure: there are no groups and no central film."""
        result = solution.result
        return {
            "speed": (solution.contact.speed, "m s-1", "speed of the plate"),
            "normal_load": (result.load_N, "N", "load that the pressure carries"),
            "maximum_pressure": (1e6 * result.max_pressure_MPa, "Pa", "largest pressure"),
        }


WEDGE = WedgeKind()


def _pad(bearing):
    """What is in the film, and what the exit is."""
    depth = bearing.pocket.depth if bearing.pocket else 0.0
    within = pocket_words(depth) if depth else pillar_words(bearing.pillar)
    return within, exit_words(bearing.blocked_exit)


def _cell(bearing, mesh):
    """Sides of a cell in m."""
    return mesh.dX * bearing.x_scale, mesh.dY * bearing.y_scale


def _check_pillar(wedge, smallest, nodes):
    """A pillar stands within the pad and is larger than a few cells."""
    half = 0.5 * wedge.pillar_size
    if wedge.pillar_size < smallest:
        raise ConfigError(
            f"wedge.pillar_size = {wedge.pillar_size:g}: must be at least {FEWEST_CELLS} cells, "
            f"{smallest:.3g} with {nodes} nodes"
        )
    first, last = wedge.ends
    if not (first < wedge.pillar_x - half and wedge.pillar_x + half < last):
        names = ("inlet", "exit") if wedge.by_films else ("exit", "inlet")
        raise ConfigError(
            f"wedge.pillar_x = {wedge.pillar_x:g}: the pillar of {wedge.pillar_size:g} m must stand "
            f"between the {names[0]} at {first:g} and the {names[1]} at {last:g}"
        )
    if not abs(wedge.pillar_y) + half < 0.5 * wedge.width:
        raise ConfigError(
            f"wedge.pillar_y = {wedge.pillar_y:g}: the pillar of {wedge.pillar_size:g} m must stand within "
            f"the width of {wedge.width:g}"
        )


def _slope(wedge):
    """The slope of a `WedgeBearing` and its level, where it has one."""
    if not wedge.by_films:
        return {"slope": wedge.slope}
    rise = wedge.inlet_film - wedge.exit_film
    return {"slope": rise / wedge.length, "level": wedge.inlet_film}


def _pocket(wedge, side):
    """The `Pocket`, its x against the motion; None without one."""
    if not wedge.pocket_depth:
        return None
    along = sorted(side * end for end in (wedge.pocket_from, wedge.pocket_to))
    return Pocket(wedge.pocket_depth, tuple(along), wedge.pocket_width or wedge.width)


def _check_pad(wedge):
    """A pad has a length, and a slope that is not too steep."""
    if not wedge.by_films:
        if not wedge.exit < wedge.inlet:
            raise ConfigError(f"wedge.inlet = {wedge.inlet:g}: must be above wedge.exit = {wedge.exit:g}")
        return
    steepness = abs(wedge.inlet_film - wedge.exit_film) / wedge.length
    if steepness > STEEPEST:
        raise ConfigError(
            f"wedge.length = {wedge.length:g}: the slope between these films would be {steepness:.2g}; it "
            f"must be at most {STEEPEST:g}"
        )


def _check_place(wedge):
    """A pocket lies within the pad."""
    (first, last), width = wedge.ends, wedge.pocket_width
    if not first <= wedge.pocket_from < wedge.pocket_to <= last:
        raise ConfigError(
            f"wedge.pocket_from = {wedge.pocket_from:g}, wedge.pocket_to = {wedge.pocket_to:g}: the first "
            f"must lie before the second, both on the pad from {first:g} to {last:g}"
        )
    if width is not None and width > wedge.width:
        raise ConfigError(
            f"wedge.pocket_width = {width:g}: must be at most the pad's wedge.width = {wedge.width:g}"
        )


def _check_pocket(wedge, cell, nodes):
    """A pocket has a few cells; one that is as wide as the pad has them."""
    along, across = wedge.pocket_to - wedge.pocket_from, wedge.pocket_width or float("inf")
    for key, size, dx in zip(("pocket_to", "pocket_width"), (along, across), cell, strict=True):
        if size < FEWEST_CELLS * dx:
            raise ConfigError(
                f"wedge.{key} = {getattr(wedge, key):g}: the pocket must be at least {FEWEST_CELLS} cells "
                f"long and wide, {FEWEST_CELLS * dx:.3g} with {nodes} nodes"
            )
