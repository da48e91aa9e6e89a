"""What a valid configuration may still get wrong together: found before anything is written."""

from mgehl.config import ConfigError

LARGEST_RADIUS_RATIO = 1e3
"""Of the two radii: a longer ellipse is a line contact."""

LARGEST_CONTACT = 0.5
"""Semi-axis over radius up to which a body is taken for a half-space and a paraboloid."""

LARGEST_EXPONENT = 200.0
"""alpha p_h: the viscosity must stay a number."""


def check_contact(config, contact):
    """Raise ConfigError where a contact is none."""
    if config.contact.kind == "wedge":
        _check_pillar(config.wedge)
        return
    if config.contact.kind == "point":
        _check_radii(config.contact)
    _check_size(config, contact)
    exponent = contact.lubricant.pressure_viscosity * contact.hertz.p_h
    if exponent > LARGEST_EXPONENT:
        raise ConfigError(
            f"lubricant.pressure_viscosity = {contact.lubricant.pressure_viscosity:g}: times the Hertz "
            f"pressure of {contact.hertz.p_h:.2g} Pa it must be at most {LARGEST_EXPONENT:g}, "
            f"is {exponent:.2g}"
        )
    if 1.0 + contact.inlet_length > -config.grid.x[0]:
        raise ConfigError(
            f"grid.x = {list(config.grid.x)!r}: must begin before {-1.0 - contact.inlet_length:.3g}, "
            "where the inlet that builds the film begins"
        )


def _check_radii(section):
    ratio = max(section.radius_x, section.radius_y) / min(section.radius_x, section.radius_y)
    if ratio > LARGEST_RADIUS_RATIO:
        raise ConfigError(
            f"contact.radius_y = {section.radius_y:g}: must be within a factor of "
            f"{LARGEST_RADIUS_RATIO:g} of contact.radius_x = {section.radius_x:g}"
        )


def _check_size(config, contact):
    """The bodies must be half-spaces."""
    section, hertz = config.contact, contact.hertz
    if config.contact.kind == "line":
        name, size, radii = "contact.load_per_length", f"{hertz.a:.2g} m", f"{section.radius_x:g} m"
        part = hertz.a / section.radius_x
    else:
        name = "moes.M" if config.moes.M is not None else "contact.load"
        size = f"{hertz.a:.2g} m by {hertz.b:.2g} m"
        radii = f"{section.radius_x:g} m and {section.radius_y:g} m"
        part = max(hertz.a / section.radius_x, hertz.b / section.radius_y)
    if part > LARGEST_CONTACT:
        raise ConfigError(
            f"{name}: the contact would be {size} wide on radii of {radii}; it must be below half of them"
        )


def _check_pillar(wedge):
    """A pillar stands within the pad."""
    if wedge.pillar == "none":
        return
    half = 0.5 * wedge.pillar_size
    if not (wedge.exit < wedge.pillar_x - half and wedge.pillar_x + half < wedge.inlet):
        raise ConfigError(
            f"wedge.pillar_x = {wedge.pillar_x:g}: the pillar of {wedge.pillar_size:g} m must stand "
            f"between the exit at {wedge.exit:g} and the inlet at {wedge.inlet:g}"
        )
    if not abs(wedge.pillar_y) + half < 0.5 * wedge.width:
        raise ConfigError(
            f"wedge.pillar_y = {wedge.pillar_y:g}: the pillar of {wedge.pillar_size:g} m must stand within "
            f"the width of {wedge.width:g}"
        )
