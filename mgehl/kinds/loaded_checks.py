"""Checks of a loaded contact: whether values that are allowed one by one fit each other."""

from mgehl.config_value import FARTHEST
from mgehl.errors import ConfigError
from mgehl.kinds.bodies import smallest_radii
from mgehl.model.images import wave_numbers
from mgehl.model.own_laws import OwnCompliance, OwnDensity, OwnRheology, OwnViscosity

LARGEST_CONTACT = 0.5
"""Largest semi-axis over radius. Beyond it a body is neither a half-space nor a paraboloid."""

LARGEST_EXPONENT = 200.0
"""Largest alpha p_h: above it the viscosity is no number a computer holds."""

CHECKED_SHEAR_RATE = 1e6
"""In 1/s: one of many at which a shear stress must be a number."""

CHECKED_PRESSURE = 2.0
"""Pressure up to which a user's own laws are checked, over that of Hertz."""


def check_deformation(config, contact):
    """A deformation of the user's own must be positive. Any deformation must be a sum of images."""
    deformation = contact.deformation
    if isinstance(deformation, OwnCompliance):
        deformation.check(wave_numbers() / contact.hertz.a)
    try:
        _ = contact.kernel
    except ValueError as error:
        raise ConfigError(f"contact.deformation = {config.contact.deformation!r}: {error}") from None


def check_size(key, size, radii, part):
    """The bodies must be half-spaces: `part` is the size of the dry contact over their radii."""
    if part > LARGEST_CONTACT:
        raise ConfigError(
            f"{key}: the contact would be {size} wide on radii of {radii}; it must be below half of them"
        )


def on_the_bodies(config, contact):
    """(Axis, semi-axis of the dry contact, smaller radius of the bodies) in m, where these tell theirs.
    Bodies that conform are wide apart by their reduced radius, and may be no half-spaces all the same."""
    wide = {"x": contact.hertz.a, "y": contact.hertz.b} if not contact.is_line else {"x": contact.hertz.a}
    for axis, radius in smallest_radii(config).items():
        yield axis, contact.widening * wide[axis], radius


def check_bodies(key, config, contact):
    """The dry contact may not be as wide as a body."""
    for axis, size, radius in on_the_bodies(config, contact):
        if size >= radius:
            raise ConfigError(
                f"{key}: the contact would be {2.0 * size:.2g} m long along {axis}, wider than a body "
                f"with a radius of {radius:g} m"
            )


def check_own_laws(contact):
    """The derivatives of a user's own laws must be those of their values, shear stresses must be some."""
    rheology, around = contact.friction.rheology, contact.lubricant.ambient_pressure
    highest = around + CHECKED_PRESSURE * contact.hertz.p_h
    check_own_laws_up_to(contact.lubricant, highest)
    if isinstance(contact.lubricant.viscosity_law, OwnViscosity):
        contact.lubricant.viscosity_law.check_alpha(highest)
    if isinstance(rheology, OwnRheology):
        rheology.check(highest, contact.lubricant.viscosity, CHECKED_SHEAR_RATE)


def check_own_laws_up_to(lubricant, highest):
    """The same of a `Lubricant`, up to the pressure `highest` in Pa."""
    viscosity, density = lubricant.viscosity_law, lubricant.density_law
    if isinstance(viscosity, OwnViscosity):
        viscosity.check(highest, "lubricant.viscosity in Pa s")
    if isinstance(density, OwnDensity):
        density.check(highest)


def check_exponent(contact):
    """The viscosity must stay a number."""
    exponent = contact.lubricant.pressure_viscosity * contact.hertz.p_h
    if exponent > LARGEST_EXPONENT:
        raise ConfigError(
            f"lubricant.pressure_viscosity = {contact.lubricant.pressure_viscosity:g}: times the Hertz "
            f"pressure of {contact.hertz.p_h:.2g} Pa it must be at most {LARGEST_EXPONENT:g}, "
            f"is {exponent:.2g}"
        )


def check_domain(grid, contact, sense=1.0, wide=1.0):
    """The contact must lie in the domain, and so must the inlet upstream of it. A `sense` of -1 is that of
    surfaces that have turned round, `wide` the contact's semi-axes over those of the grid."""
    length = sense * contact.inlet_length
    inlets = contact.motion[0] * length, contact.motion[1] * length * contact.k_e
    for (name, ends), inlet in zip(_sides(grid, contact), inlets, strict=False):
        needed, side = wide * (contact.reach + abs(inlet)), None
        if inlet > 0.0 and needed > -ends[0]:
            side = f"begin before {-needed:.3g}"
        elif inlet < 0.0 and needed > ends[1]:
            side = f"end beyond {needed:.3g}"
        if side and needed > FARTHEST:
            raise ConfigError(
                f"grid.{name}: the inlet that builds the film is {needed:.3g} semi-axes long, no domain "
                f"goes beyond {FARTHEST:g}: the load is too light, the speed too high or a radius too large"
            )
        if side:
            words = f"must {side}, where the inlet that builds the film begins"
            raise ConfigError(f"grid.{name} = {list(ends)!r}: {words}")
    check_reach(grid, contact, wide)


def check_reach(grid, contact, wide=1.0):
    """The contact must lie in the domain."""
    reach = wide * contact.reach
    who = "contact may on a layer so soft" if contact.reach > 1.0 else "contact of smooth bodies does"
    for name, ends in _sides(grid, contact):
        if min(-ends[0], ends[1]) <= reach:
            words = f"must reach beyond {reach:.3g} on both sides, as far as the {who}"
            raise ConfigError(f"grid.{name} = {list(ends)!r}: {words}")


def _sides(grid, contact):
    """Names and ends of the domain's axes."""
    return (("x", grid.x),) if contact.is_line else (("x", grid.x), ("y", grid.y))
