"""What resists the motion, as one record, `friction` of result.json, and in words."""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.discretization.status import is_fluid
from mgehl.model.flash import has_temperatures
from mgehl.output.digits import with_band
from mgehl.output.film_error import UNSETTLED
from mgehl.solver.gaps import gaps
from mgehl.solver.heat import rise_of
from mgehl.solver.shear import as_the_motion_goes, flows_out_whole, shear_of, shear_of_wake


@dataclass(frozen=True)
class Temperatures:
    """Rises above the temperature of the bodies in K."""

    largest_1: float
    """Of the surface of body 1."""
    largest_2: float
    film: float | None
    """Mean over thickness and by pressure; None in older results, of oil that tells no conductivity."""
    largest_film: float | None


@dataclass(frozen=True)
class FrictionResult:
    """Forces on the bodies along the motion and their parts; of a line contact those of a metre."""

    model: str
    """The law of the sheared oil."""
    slide_to_roll: float
    sliding_speed: float
    """u_1 - u_2 in m/s."""
    coefficient: float
    """Shear of film and solids over the load; 0 where the surfaces do not slide."""
    film_coefficient: float
    solid_coefficient: float
    rolling_coefficient: float
    """What drags a body against the motion, mean of both, over the load: in the domain."""
    rolling_beyond: float
    """What drags up to a radius of curvature away between rigid bodies full of oil: in no force."""
    force_1_N: float
    """On body 1, of speed u (1 + S/2): positive along the motion."""
    force_2_N: float
    """On body 2, of speed u (1 - S/2)."""
    rolling_N: float
    """The part that is rolling's, against the motion, mean of both."""
    power_loss_W: float
    """Of sliding and rolling, of both bodies, in the domain."""
    largest_shear_MPa: float
    temperatures: Temperatures | None = None
    """By the heat of sliding. None where [heat] says nothing of the bodies, of a band of heat on a body at
    rest, and in time."""
    per_metre: bool = False
    """Whether forces and power are those of a metre: of a line contact."""
    coefficient_band: float | None = None
    """Half-width of its band: by the coarser grid, of rough bodies at the least by solids' load."""
    rolling_band: float | None = None
    """That of `rolling_coefficient`, by the coarser grid."""
    is_the_grids: bool = False
    """Whether there is no band though one was asked for: the coarser grid has another coefficient, or load
    on solids, a spike of pressure decides on it, or no grid tells."""
    moment_1_Nm: float | None = None
    """Of the force on body 1 about its axis, positive as its surface moves along the motion; None: flat."""
    moment_2_Nm: float | None = None
    """The same of body 2; of a line contact those of a metre."""
    sliding_beyond: float = 0.0
    """What shear takes there by the same formula of the gap; in no force either."""
    unthinned_film_nm: float | None = None
    """Central film, or mean gap, if shear did not thin it; None where it does not, or nobody asked."""
    unthinned_minimum_nm: float | None = None
    """The minimum film then; None in older results, too."""
    thins: bool = False
    """Whether shear thins the film."""
    is_asked: bool = True
    """Whether a slide-to-roll ratio is given, be it 0."""
    rolling_power_W: float | None = None
    """The part of the power that is rolling's; None in older results."""


STRONGEST = 300.0
"""Largest shear stress in MPa that oils were seen to bear: a tenth of 3 GPa [Arana et al. 2019]."""

LEAST = 1e-5
"""Coefficient of surfaces that slide below which the stress of a user's law may have another unit."""

UNTOLD = 0.05
"""Part of the power that rolling makes and that is said beside temperatures, which leave it out."""

TINY = 1e-300
"""No pressure at all: the film has no mean by it."""

TOLD = 0.01
"""Part of the coefficient that is sheared beyond the domain and said."""


def friction_result(problem, state, steady=True):
    """The `FrictionResult` of a state, and maps (lines, nx) by their names in `Fields`: shear stress, and
    of a `steady` state flash temperatures, as far as there are any (collective)."""
    contact, friction = problem.contact, problem.contact.friction
    shear, slides = shear_of(problem, state), friction.slide_to_roll
    speed, total, stress = contact.speed, shear.sliding_force, shear.stress
    rolled, sheared = (0.0, 0.0) if contact.is_at_rest else _beyond(problem, state)
    load = problem.load_share * contact.load
    dragged = total if slides > 0.0 else -total
    (rolling_1, rolling_2), half = shear.rolling, 0.5 * slides
    sliding = friction.sliding_speed(speed)
    rolls = speed * ((1.0 + half) * rolling_1 + (1.0 - half) * rolling_2)
    rise = rise_of(problem, state, stress) if steady and has_temperatures(contact) else None
    result = FrictionResult(
        model=friction.rheology.name,
        slide_to_roll=slides,
        sliding_speed=slides * speed,
        coefficient=total / load,
        film_coefficient=shear.film_force / load,
        solid_coefficient=shear.solid_force / load,
        rolling_coefficient=shear.rolling_force / load,
        rolling_beyond=rolled / load,
        sliding_beyond=sheared / load,
        force_1_N=-dragged - rolling_1,
        force_2_N=dragged - rolling_2,
        rolling_N=-shear.rolling_force,
        power_loss_W=total * sliding + rolls,
        rolling_power_W=rolls,
        largest_shear_MPa=1e-6 * problem.grid.max(stress),
        temperatures=rise and _temperatures(problem, state, rise),
        per_metre=contact.is_line,
        thins=friction.thins,
    )
    maps = {"shear": stress} if slides else {}
    return result, maps | ({"flash_1": rise.first, "flash_2": rise.second} if rise else {})


def _beyond(problem, state):
    """What rolling and sliding take from the bodies beyond the domain."""
    contact, whole = problem.contact.under(problem.load_share), flows_out_whole(problem, state)
    mesh, reach = as_the_motion_goes(problem), contact.x_scale / problem.contact.x_scale
    x, y = (tuple(end / reach for end in ends) for ends in (mesh.x, mesh.y))
    where = replace(mesh, x=x, y=y), whole
    dragged = contact.drag_beyond(*where)
    if contact.friction.slide_to_roll == 0.0:
        return dragged, 0.0
    return dragged, contact.shear_beyond(*where) + (0.0 if whole else shear_of_wake(problem, state))


def _temperatures(problem, state, rise):
    grid = problem.grid
    largest = [grid.max(each) for each in (rise.first, rise.second)]
    film = np.where(is_fluid(state.status), rise.film, 0.0)
    carried = np.where(is_fluid(state.status), np.maximum(state.p, 0.0), 0.0)
    by_pressure = grid.sum((carried * film).sum()) / max(grid.sum(carried.sum()), TINY)
    return Temperatures(*largest, by_pressure, grid.max(film))


def banded(friction, error, boundary_coefficient, asked=True):
    """A `FrictionResult` with the band that the grids of a `GapError` give it, where bands were `asked`
    for."""
    if not friction:
        return friction
    friction = replace(friction, rolling_band=error.rolling)
    if not friction.slide_to_roll:
        return friction
    share, own, band = error.solid_load_fraction, error.friction, None
    if share is not None and own is not None:
        band = max(boundary_coefficient * share, own)
    of_the_grid = band is None and asked and error.how != UNSETTLED
    return replace(friction, coefficient_band=band, is_the_grids=of_the_grid)


def banded_in_time(friction, half_width):
    """A `FrictionResult` with the band of surfaces that slide; `half_width` is None where there is none."""
    if not (friction and friction.slide_to_roll):
        return friction
    return replace(friction, coefficient_band=half_width)


def with_unthinned(friction, result, solve):
    """A `FrictionResult` with the films that there would be if shear did not thin it (collective).
    `solve()` returns that contact's problem and its `Outcome`."""
    if not result.converged:
        return friction
    problem, outcome = solve()
    if not outcome.converged:
        return friction
    nm, (central, minimum) = 1e9 * problem.contact.film_scale, problem.films(outcome.state)
    film = gaps(problem, outcome.state.P, outcome.state.H)[0] if result.mixed else central
    return replace(friction, unthinned_film_nm=nm * film, unthinned_minimum_nm=nm * minimum)


def with_moments(friction, arms):
    """A `FrictionResult` with moments, the contact being so far from the axis of either body, in m."""
    if not friction:
        return friction
    forces = friction.force_1_N, friction.force_2_N
    moments = (arm and arm * force for arm, force in zip(arms, forces, strict=True))
    return replace(friction, **dict(zip(("moment_1_Nm", "moment_2_Nm"), moments, strict=True)))


def friction_lines(friction, verbose, at_a_spike=False):
    """What resists, in words, where it is asked for, and `verbose` always. `at_a_spike`: the
    largest pressure is the grid's, and so is what it lets the oil bear."""
    if not friction or not (verbose or friction.is_asked or friction.model != "newtonian"):
        return
    unit = "/m" if friction.per_metre else ""
    beyond = friction.rolling_beyond
    more = f" (and {beyond:.2g} beyond it, were it flooded)" if beyond else ""
    rolling = f"{friction.rolling_coefficient:.3g}"
    if friction.rolling_band:
        rolling = with_band(friction.rolling_coefficient, friction.rolling_band)
    rolling = f"rolling takes {rolling} of the load in the domain, mean of both bodies{more}"
    if not friction.slide_to_roll:
        yield f"no sliding friction: motion.slide_to_roll is 0, or not given; {rolling}"
        return
    if coefficient_words(friction) == OUT_OF_RANGE:
        drag = f"{friction.model}: the film would drag by {friction.film_coefficient:.2g} times the load"
        yield f"friction {coefficient_words(friction)} ({drag}); {rolling}"
        yield from strength_lines(friction.largest_shear_MPa)
        return
    sheared, more = friction.sliding_beyond, ""
    if sheared > TOLD * friction.coefficient:
        more = f" (and {sheared:.2g} beyond the domain, were it flooded)"
    spike = " (the grid's)" if at_a_spike and friction.solid_coefficient == 0.0 else ""
    yield (
        f"friction {coefficient_words(friction)} ({friction.model}): film "
        f"{friction.film_coefficient:.5f}{more}, solids {friction.solid_coefficient:.5f}; {rolling}; "
        f"{friction.power_loss_W:.3g} W{unit}, largest shear {friction.largest_shear_MPa:.4g} MPa{spike}"
    )
    yield from strength_lines(friction.largest_shear_MPa)
    if friction.model == "own" and friction.coefficient < LEAST:
        yield f"friction below {LEAST:g} is less than oils have: the law's stress is to be in Pa"
    if friction.temperatures:
        yield _temperature_words(friction)
    if friction.is_the_grids:
        yield "no band of friction: another grid may give another coefficient"


def coefficient_words(friction):
    """The coefficient with its band."""
    if is_out_of_range(friction.film_coefficient, friction.largest_shear_MPa):
        return OUT_OF_RANGE
    if friction.coefficient_band:
        return with_band(friction.coefficient, friction.coefficient_band)
    return f"{friction.coefficient:.5f}"


OUT_OF_RANGE = "out of range"
"""Instead of a coefficient of a film that drags by more than the load and bears more than oils do."""


def is_out_of_range(coefficient, shear_MPa):
    """Whether it is, by a largest stress, None where nobody knows."""
    return coefficient > 1.0 and (shear_MPa or 0.0) > STRONGEST


def strength_lines(shear_MPa):
    """What to think of a larger shear stress than oils bear; nothing of others, nor of None."""
    if shear_MPa and shear_MPa > STRONGEST:
        yield (
            f"no oil bears more than some {STRONGEST:g} MPa: friction.model eyring or limiting knows less "
            "friction, and less heat"
        )


def _temperature_words(friction):
    """How much warmer surfaces and film are than the bodies."""
    found, rolls = friction.temperatures, friction.rolling_power_W or 0.0
    words = f"flash temperature: body 1 up to {found.largest_1:.3g} K, body 2 {found.largest_2:.3g} K"
    if found.film is not None:
        words += f", film on average {found.film:.3g} K, at most {found.largest_film:.3g} K"
    if rolls > UNTOLD * friction.power_loss_W:
        words += f"; without the heat of rolling, {rolls:.3g} W"
    return words
