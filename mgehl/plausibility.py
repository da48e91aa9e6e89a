"""What a valid configuration may still get wrong together: found before anything is written."""

from mgehl.errors import ConfigError
from mgehl.model.images import wave_numbers
from mgehl.model.own_laws import OwnCompliance, OwnDensity, OwnViscosity
from mgehl.solver.from_config import mesh_from

LARGEST_RADIUS_RATIO = 1e3
"""Of the two radii: a longer ellipse is a line contact."""

LARGEST_CONTACT = 0.5
"""Semi-axis over radius up to which a body is taken for a half-space and a paraboloid."""

LARGEST_EXPONENT = 200.0
"""alpha p_h: the viscosity must stay a number."""

CHECKED_PRESSURE = 2.0
"""Pressure up to which a user's own laws are checked, over that of Hertz."""

LARGEST_ASPECT = 100.0
"""Of a pad's length and width."""

FEWEST_CELLS = 2
"""That a pillar must have, and the gap's way from the exit to nothing."""


def check_contact(config, contact):
    """Raise ConfigError where a contact is none."""
    if config.contact.kind == "wedge":
        _check_wedge(config, contact)
        return
    if config.contact.kind == "point":
        _check_radii(config.contact)
    _check_deformation(config, contact)
    _check_size(config, contact)
    _check_own_laws(config, contact)
    exponent = contact.lubricant.pressure_viscosity * contact.hertz.p_h
    if exponent > LARGEST_EXPONENT:
        raise ConfigError(
            f"lubricant.pressure_viscosity = {contact.lubricant.pressure_viscosity:g}: times the Hertz "
            f"pressure of {contact.hertz.p_h:.2g} Pa it must be at most {LARGEST_EXPONENT:g}, "
            f"is {exponent:.2g}"
        )
    _check_domain(config.grid, contact)


def _check_deformation(config, contact):
    """A user's own must be positive, and any must be a sum of images."""
    deformation = contact.deformation
    if isinstance(deformation, OwnCompliance):
        deformation.check(wave_numbers() / contact.hertz.a)
    try:
        _ = contact.kernel
    except ValueError as error:
        raise ConfigError(f"contact.deformation = {config.contact.deformation!r}: {error}") from None


def _check_own_laws(config, contact):
    """A user's own laws must hold with their derivatives, the surface must be heights."""
    highest = CHECKED_PRESSURE * contact.hertz.p_h
    for law in (contact.lubricant.viscosity_law, contact.lubricant.density_law):
        if isinstance(law, OwnViscosity | OwnDensity):
            law.check(highest)
    if contact.surface is not None:
        mesh = mesh_from(config, contact)
        contact.surface.check(mesh.X * contact.x_scale, mesh.Y * contact.y_scale, contact.hertz.a)


def _check_domain(grid, contact):
    """The inlet and the contact must lie in the domain.

    The widening by a soft layer is estimated, and low by up to a third.
    """
    width = contact.widening
    reach = width if width <= 1.0 else min(width**2, 1.3 * width)
    inlet = reach + contact.inlet_length
    if inlet > -grid.x[0]:
        raise ConfigError(
            f"grid.x = {list(grid.x)!r}: must begin before {-inlet:.3g}, where the inlet that builds the "
            "film begins"
        )
    for name, ends in (("x", grid.x), ("y", grid.y)):
        if min(-ends[0], ends[1]) <= reach:
            raise ConfigError(
                f"grid.{name} = {list(ends)!r}: must reach beyond {reach:.3g} on both sides, as far as the "
                "contact may on a layer so soft"
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
    section, hertz, wide = config.contact, contact.hertz, contact.widening
    if config.contact.kind == "line":
        name, size, radii = "contact.load_per_length", f"{hertz.a:.2g} m", f"{section.radius_x:g} m"
        part = hertz.a / section.radius_x
    else:
        name = "moes.M" if config.moes.M is not None else "contact.load"
        size = f"{wide * hertz.a:.2g} m by {wide * hertz.b:.2g} m"
        radii = f"{section.radius_x:g} m and {section.radius_y:g} m"
        part = wide * max(hertz.a / section.radius_x, hertz.b / section.radius_y)
    if part > LARGEST_CONTACT:
        raise ConfigError(
            f"{name}: the contact would be {size} wide on radii of {radii}; it must be below half of them"
        )


def _check_wedge(config, bearing):
    """The pad must be a plate, its gap and its pillar larger than cells of the grid."""
    wedge, mesh = config.wedge, mesh_from(config, bearing)
    length = wedge.inlet - wedge.exit
    if not 1.0 / LARGEST_ASPECT <= wedge.width / length <= LARGEST_ASPECT:
        raise ConfigError(
            f"wedge.width = {wedge.width:g}: must be within a factor of {LARGEST_ASPECT:g} of the pad's "
            f"length of {length:g}"
        )
    dx, dy = mesh.dX * bearing.x_scale, mesh.dY * bearing.y_scale
    if wedge.exit < FEWEST_CELLS * dx:
        raise ConfigError(
            f"wedge.exit = {wedge.exit:g}: must be at least {FEWEST_CELLS} cells from the line of no gap, "
            f"{FEWEST_CELLS * dx:.3g} with {config.grid.nodes} nodes"
        )
    if wedge.pillar != "none":
        _check_pillar(wedge, FEWEST_CELLS * max(dx, dy), config.grid.nodes)


def _check_pillar(wedge, smallest, nodes):
    """A pillar stands within the pad and is larger than a few cells."""
    half = 0.5 * wedge.pillar_size
    if wedge.pillar_size < smallest:
        raise ConfigError(
            f"wedge.pillar_size = {wedge.pillar_size:g}: must be at least {FEWEST_CELLS} cells, "
            f"{smallest:.3g} with {nodes} nodes"
        )
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
