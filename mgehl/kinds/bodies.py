"""Two bodies and their motion as engineers and catalogues give them, to the numbers that are solved.

Elasticity of both to E', curvatures to the radii of a paraboloid on a flat, speeds or rotations to the mean
speed and the slide-to-roll ratio. A radius along x lies in the plane of the motion; a hollow is negative.
"""

from dataclasses import asdict, dataclass, fields
from math import inf, pi, sqrt

from mgehl.config_value import number, word
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Derived
from mgehl.model.materials import ALSO, MATERIALS, reduced_modulus

BODIES = "body_1", "body_2"

RQ_OF_RA = sqrt(0.5 * pi)
"""Rq over Ra of heights with the distribution of Gauss: 1.25."""

SMALLEST_RADIUS = 1e-7
"""In m."""


@dataclass(frozen=True)
class BodySection:
    # fmt: off
    material: str | None = word(None, "what it is made of, for Young's modulus and Poisson's ratio",
        tuple(MATERIALS), also=ALSO)
    modulus: float | None = number(None, "Young's modulus, where material does not tell it", "Pa", 1e3,
        1e13)
    poisson: float | None = number(None, "Poisson's ratio, beside modulus", low=0.0, high=0.5)
    diameter: float | None = number(None, "of a ball, or of a roller or ring whose y is told apart; "
        "negative: of a ring from within", "m", -1e3, 1e3)
    radius_x: float | None = number(None, "radius along x, negative where it is hollow; unset: flat", "m",
        -1e3, 1e3)
    radius_y: float | None = number(None, "radius along y, such as minus that of a groove; unset: flat",
        "m", -1e3, 1e3)
    conformity: float | None = number(None, "radius of its groove along y over the other body's diameter, "
        "0.515 to 0.53 of ball bearings", above=0.5, high=10.0)
    roughness: float | None = number(None, "rms height Rq, for lambda alone: its heights are not solved",
        "m", 0.0, 1e-3)
    Ra: float | None = number(None, "mean height Ra in place of roughness, which is taken for 1.2533 of it",
        "m", 0.0, 1e-3)
    speed: float | None = number(None, "speed of its surface as the contact sees it, that of both instead "
        "of motion.speed", "m/s", -1e3, 1e3)
    rotation: float | None = number(None, "rotation about an axis at rest instead of its speed", "rad/s",
        -1e6, 1e6)
    rotation_radius: float | None = number(None, "distance of the contact from that axis (unset: the "
        "radius along x)", "m", 0.0, 1e3)
    # fmt: on


GEOMETRY = ("diameter", "radius_x", "radius_y", "conformity")
ELASTICITY = ("material", "modulus", "poisson")
SPEEDS = ("speed", "rotation")


def keys(names):
    """These keys of both bodies."""
    return tuple(f"{body}.{name}" for body in BODIES for name in names)


MOTION = keys((*SPEEDS, "rotation_radius"))

OF_A_LINE = keys(
    [field.name for field in fields(BodySection) if field.name not in ("radius_y", "conformity")]
)
"""Keys of bodies that know no y."""


def derived_from_bodies(config):
    """What follows from the bodies: `Derived`, in order. Raises ConfigError where they do not fit."""
    bodies = config.body_1, config.body_2
    if _any(bodies, ELASTICITY):
        yield _modulus(bodies)
    if _any(bodies, GEOMETRY):
        yield from _radii(bodies, config.contact.kind)
    if _any(bodies, SPEEDS):
        yield from _speeds(bodies)
    if config.motion.ring_rotation is not None:
        yield from _bearing(bodies, config.motion.ring_rotation)


def roughness(config):
    """Rq of both bodies together in m, by their numbers; 0 without any."""
    return roughness_of({name: asdict(getattr(config, name)) for name in BODIES})


def roughness_of(tables):
    """The same of nested values in SI units."""
    bodies = (tables.get(name, {}) for name in BODIES)
    return sqrt(sum((body.get("roughness") or RQ_OF_RA * (body.get("Ra") or 0.0)) ** 2 for body in bodies))


def _any(bodies, names):
    return any(getattr(body, name) is not None for body in bodies for name in names)


def _needed(names, bodies, what):
    """Raise ConfigError unless both bodies have one of some keys."""
    for name, body in zip(BODIES, bodies, strict=True):
        if not _any([body], names):
            other = BODIES[name == BODIES[0]]
            words = " or ".join(f"{name}.{each}" for each in names)
            raise ConfigError(f"{words}: must be given beside {what} of {other}")


def _modulus(bodies):
    _needed(("material", "modulus"), bodies, "elasticity")
    both = []
    for body in bodies:
        known = MATERIALS.get(body.material)
        both.append((known.modulus, known.poisson) if known else (body.modulus, body.poisson))
    terms = " + ".join(f"(1 - {poisson:g}^2)/{1e-9 * modulus:g}" for modulus, poisson in both)
    return Derived("contact.reduced_modulus", reduced_modulus(*both), f"2/E' = {terms} 1/GPa")


def smallest_radii(config):
    """{axis: size of the smaller radius of both bodies in m}; of bodies that do not tell theirs none."""
    bodies = config.body_1, config.body_2
    found = _own_radii(bodies, config.contact.kind) if _any(bodies, GEOMETRY) else {}
    return {axis: min(map(abs, both)) for axis, both in found.items()}


def _own_radii(bodies, kind):
    """{axis: radii of both bodies in m}. Of a line contact those along x."""
    return {
        axis: [_radius(*each, axis) for each in zip(BODIES, bodies, reversed(bodies), strict=True)]
        for axis in (("x",) if kind == "line" else ("x", "y"))
    }


def _radii(bodies, kind):
    """The radii of the paraboloid."""
    for axis, both in _own_radii(bodies, kind).items():
        if both == [inf, inf]:
            names = " or ".join(f"{body}.radius_{axis}" for body in BODIES)
            raise ConfigError(f"{names}: must be given beside the bodies' other radii: both are flat")
        curvature = sum(1.0 / radius for radius in both)
        terms = " + ".join("0" if radius == inf else f"1/{1e3 * radius:.6g}" for radius in both)
        if curvature <= 0.0:
            raise ConfigError(
                f"body_1, body_2: radii along {axis}: 1/R = {terms} 1/mm; must be positive, "
                "a hollow wider than what lies in it"
            )
        yield Derived(f"contact.radius_{axis}", 1.0 / curvature, f"1/R = {terms} 1/mm")


def _radius(name, body, other, axis):
    """Of one body along an axis: negative of a hollow, inf where it is flat."""
    if axis == "y" and body.conformity is not None:
        if other.diameter is None and other.radius_x is None:
            raise ConfigError(f"{name}.conformity: needs the other body's diameter or radius_x")
        return -2.0 * body.conformity * abs(_round(other))
    own = getattr(body, f"radius_{axis}")
    radius = own if own is not None else _round(body) if body.diameter is not None else inf
    if abs(radius) < SMALLEST_RADIUS:
        raise ConfigError(f"{name}: a radius of {radius:g} m along {axis}: must be at least 1e-07 m")
    return radius


def _round(body):
    """Its radius in the plane of the motion; None where it is flat."""
    return body.radius_x if body.diameter is None else 0.5 * body.diameter


def _speeds(bodies):
    _needed(SPEEDS, bodies, "a speed")
    first, second = (_surface_speed(*each) for each in zip(BODIES, bodies, strict=True))
    mean = 0.5 * (first + second)
    if mean <= 0.0:
        raise ConfigError(
            f"body_1, body_2: surface speeds of {first:.6g} and {second:.6g} m/s: their mean must be "
            "positive; motion.angle turns it"
        )
    yield Derived("motion.speed", mean, f"u = ({first:.6g} + {second:.6g})/2 m/s")
    yield Derived("motion.slide_to_roll", (first - second) / mean, "2 (u_1 - u_2)/(u_1 + u_2)")


def _surface_speed(name, body):
    if body.rotation is None:
        return body.speed
    if (arm := _arm(body)) is None:
        raise ConfigError(f"{name}.rotation_radius: must be given with {name}.rotation of a flat body")
    return body.rotation * arm


def _arm(body):
    """Distance of the contact from its axis in m; None of a flat body that does not tell it."""
    arm = body.rotation_radius if body.rotation_radius is not None else _round(body)
    return None if arm is None else abs(arm)


def arms(config, angle):
    """Distance of the contact from either body's axis in m, the motion being at an `angle` in degrees: the
    one by which its rotation is a speed, else the radius along the motion. None of a body that is flat that
    way, or whose radii differ where the motion is along neither."""
    bodies = config.body_1, config.body_2
    radii = zip(*_own_radii(bodies, config.contact.kind).values(), strict=True)
    return [_arm_towards(angle % 180.0, *each) for each in zip(bodies, radii, strict=True)]


def _arm_towards(angle, body, radii):
    if body.rotation is not None:
        return _arm(body)
    along = radii[0] if angle == 0.0 or len(set(radii)) == 1 else radii[1] if angle == 90.0 else inf
    return None if abs(along) == inf else abs(along)


def _bearing(bodies, rotation):
    """Rolling between two rings: u = omega d_m (1 - (d/d_m)^2)/4 at either, d_m the pitch diameter.
    motion.slide_to_roll, where it is given, is slip at this mean speed."""
    element, race = (_round(body) for body in bodies)
    if bodies[0].conformity is not None or (element or 0.0) < 0.0:  # it is the ring
        element, race = race, element
    elif race is not None and 0.0 < race < (element or 0.0):
        raise ConfigError(
            "motion.ring_rotation: body_1 is the ball or roller, but larger than body_2, the ring: "
            "exchange them"
        )
    if element is None or race is None or element <= 0.0 or abs(race) == inf:
        raise ConfigError(
            "motion.ring_rotation: needs diameter or radius_x of a ball or roller, and of the raceway "
            "(negative: that of the outer ring)"
        )
    pitch = 2.0 * abs(race + element)
    speed = 0.25 * rotation * pitch * (1.0 - (2.0 * element / pitch) ** 2)
    words = f"rolling on a pitch diameter of {1e3 * pitch:.6g} mm: omega d_m (1 - (d/d_m)^2)/4"
    yield Derived("motion.speed", speed, words)
