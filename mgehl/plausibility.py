"""What a valid configuration may still get wrong together: found before anything is written."""

from mgehl.config import ConfigError

LARGEST_RADIUS_RATIO = 1e3
"""Of the two radii: a longer ellipse is a line contact."""

LARGEST_CONTACT = 0.5
"""Semi-axis over radius up to which a body is taken for a half-space and a paraboloid."""

LARGEST_EXPONENT = 200.0
"""alpha p_h: the viscosity must stay a number."""


def check_contact(config, contact):
    """Raise ConfigError where a contact is none: too large for its body, or without an inlet."""
    section, hertz = config.contact, contact.hertz
    name = "moes.M" if config.moes.M is not None else "contact.load"
    ratio = max(section.radius_x, section.radius_y) / min(section.radius_x, section.radius_y)
    if ratio > LARGEST_RADIUS_RATIO:
        raise ConfigError(
            f"contact.radius_y = {section.radius_y:g}: must be within a factor of "
            f"{LARGEST_RADIUS_RATIO:g} of contact.radius_x = {section.radius_x:g}"
        )
    if max(hertz.a / section.radius_x, hertz.b / section.radius_y) > LARGEST_CONTACT:
        raise ConfigError(
            f"{name}: the contact would be {hertz.a:.2g} m by {hertz.b:.2g} m wide on radii of "
            f"{section.radius_x:g} m and {section.radius_y:g} m; it must be below half of them"
        )
    exponent = contact.lubricant.pressure_viscosity * hertz.p_h
    if exponent > LARGEST_EXPONENT:
        raise ConfigError(
            f"lubricant.pressure_viscosity = {contact.lubricant.pressure_viscosity:g}: times the Hertz "
            f"pressure of {hertz.p_h:.2g} Pa it must be at most {LARGEST_EXPONENT:g}, is {exponent:.2g}"
        )
    if 1.0 + contact.inlet_length > -config.grid.x[0]:
        raise ConfigError(
            f"grid.x = {list(config.grid.x)!r}: must begin before {-1.0 - contact.inlet_length:.3g}, "
            "where the inlet that builds the film begins"
        )
