"""What resists the motion, as one record: `friction` of result.json."""

from dataclasses import dataclass, replace

from mgehl.solver.shear import shear_of


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
    """What drags each body against the motion, over the load, whether or not they slide."""
    force_1_N: float
    """On body 1, of speed u (1 + S/2): positive along the motion."""
    force_2_N: float
    """On body 2, of speed u (1 - S/2)."""
    rolling_N: float
    """The part of both that is rolling's, against the motion."""
    power_loss_W: float
    largest_shear_MPa: float
    per_metre: bool = False
    """Whether forces and power are those of a metre: of a line contact."""
    coefficient_band: float | None = None
    """Half-width by the band of the load on solids; None without one."""
    is_the_grids: bool = False
    """Whether the load on solids is the grid's, and so is the coefficient."""


def friction_result(problem, state):
    """The `FrictionResult` of a state, and the shear stress in Pa, (lines, nx), None without sliding
    (collective)."""
    contact, friction = problem.contact, problem.contact.friction
    shear, slides = shear_of(problem, state), friction.slide_to_roll
    speed, total = contact.speed, shear.film_force + shear.solid_force
    stress, dragged = shear.film + shear.solids, total if slides > 0.0 else -total
    sliding = friction.sliding_speed(speed)
    result = FrictionResult(
        model=friction.rheology.name,
        slide_to_roll=slides,
        sliding_speed=slides * speed,
        coefficient=total / contact.load,
        film_coefficient=shear.film_force / contact.load,
        solid_coefficient=shear.solid_force / contact.load,
        rolling_coefficient=shear.rolling_force / contact.load,
        force_1_N=-dragged - shear.rolling_force,
        force_2_N=dragged - shear.rolling_force,
        rolling_N=-shear.rolling_force,
        power_loss_W=total * sliding + 2.0 * speed * shear.rolling_force,
        largest_shear_MPa=1e-6 * problem.grid.max(stress),
        per_metre=contact.is_plane,
    )
    return result, stress if slides else None


def with_band(friction, mixed, boundary_coefficient):
    """A `FrictionResult` with the band that the load on solids of a `MixedResult` gives it."""
    error = mixed and mixed.error
    if not (friction and friction.slide_to_roll and error):
        return friction
    share = error.solid_load_fraction
    band = None if share is None else boundary_coefficient * share
    return replace(friction, coefficient_band=band, is_the_grids=error.is_the_grids("solid_load_fraction"))


def friction_lines(friction, verbose):
    """What resists, in words: of sliding surfaces, and `verbose` of rolling ones, too."""
    if not friction or not (verbose or friction.slide_to_roll or friction.model != "newtonian"):
        return
    unit = "/m" if friction.per_metre else ""
    rolling = f"rolling takes {friction.rolling_coefficient:.3g} of the load on each body"
    if not friction.slide_to_roll:
        yield f"  friction 0: the surfaces do not slide; {rolling}"
        return
    band = "" if friction.coefficient_band is None else f" ± {friction.coefficient_band:.2g}"
    yield (
        f"  friction {friction.coefficient:.5f}{band} ({friction.model}): film "
        f"{friction.film_coefficient:.5f}, solids {friction.solid_coefficient:.5f}; {rolling}; "
        f"{friction.power_loss_W:.3g} W{unit}, largest shear {friction.largest_shear_MPa:.4g} MPa"
    )
    if friction.is_the_grids:
        yield "  friction is the grid's, as the load on solids is"
