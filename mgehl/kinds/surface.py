"""What is on the bodies, by the keys of [surface] and [second_surface]; their heights add up.

`contact.surface`, a function of the user's own, adds to them.
"""

from contextlib import contextmanager
from dataclasses import fields

import numpy as np

from mgehl.config_value import shown
from mgehl.errors import ConfigError
from mgehl.kinds.own import own_surface_from
from mgehl.kinds.surface_keys import MOVING, NAMES, NEEDS, TAKES, SurfaceSection
from mgehl.model.frame import direction
from mgehl.model.own_function import OwnFunctionError
from mgehl.model.own_laws import OwnSurface
from mgehl.model.surface import Dent, Measured, Preparation, Ridge, SelfAffine, Waviness, summed
from mgehl.model.surface.files import UNITS
from mgehl.model.surface.map import SurfaceFileError
from mgehl.model.surface.self_affine import LARGEST_SPAN

LINES = 256
"""Lines of a grid whose heights are looked at together."""

HIGHEST = 0.1
"""Largest height over the smaller radius of the bodies."""


def unused(config):
    """Sections and keys that the surfaces of a configuration do not use."""
    for name in NAMES:
        source = getattr(config, name).source
        yield from [name] if source is None else _not_taken(name, source)


def pushed_out(given):
    """Keys of a file that settings, {"section.key": value}, leave without a use."""
    for name in NAMES:
        kind = given.get(f"{name}.kind")
        if f"{name}.file" in given:
            yield from _not_taken(name, "file")
        elif kind in TAKES:
            yield from _not_taken(name, kind)


def _not_taken(name, source):
    return [f"{name}.{key.name}" for key in fields(SurfaceSection) if key.name not in TAKES[source]]


def check_keys(config, tables):
    """Raise ConfigError where the keys of a surface contradict each other."""
    for name in NAMES:
        section, given = getattr(config, name), tables.get(name, {})
        if section.kind is not None and section.file is not None:
            raise ConfigError(f"{name}.kind = {section.kind!r}: cannot be given with {name}.file")
        if given and not section.is_given:
            raise ConfigError(f"[{name}]: needs {name}.kind or {name}.file")
        if section.is_given:
            _check_section(name, section, given)
            _check_motion(name, section, config.motion.angle)


def _check_section(name, section, given):
    source = section.source
    called = f"{name}.file" if source == "file" else f'{name}.kind = "{source}"'
    for key in given:
        if key not in TAKES[source]:
            raise ConfigError(f"{name}.{key} = {shown(given[key])}: means nothing with {called}")
    for key in NEEDS[source]:
        if getattr(section, key) is None:
            raise ConfigError(f"{name}.{key}: must be given with {called}")
    if source == "waviness" and section.wavelength_x is None and section.wavelength_y is None:
        raise ConfigError(f"{name}.wavelength_x: it or {name}.wavelength_y must be given with {called}")
    shortest, longest = section.shortest_wavelength, section.longest_wavelength
    if shortest is not None and longest is not None and not shortest < longest:
        raise ConfigError(
            f"{name}.shortest_wavelength = {shortest:g}: must be below {longest:g}, "
            f"{name}.longest_wavelength"
        )
    if source == "self-affine" and section.aspect * longest > LARGEST_SPAN * shortest:
        raise ConfigError(
            f"{name}.shortest_wavelength = {shortest:g}: must be at least the longest wavelength times "
            f"{name}.aspect over {LARGEST_SPAN:g}, {section.aspect * longest / LARGEST_SPAN:.3g}"
        )


def _check_motion(name, section, angle):
    """The heights of a body that moves must be the same all along the motion."""
    if section.body == MOVING and surface_of(section).varies_along(direction(angle)):
        raise ConfigError(
            f'{name}.body = "moving": its heights change along the motion, and so the film with time; '
            "mgehl solves steady states: the rough body stands still, the other moves at twice motion.speed"
        )


def surface_from(config):
    """All that is on the bodies as one `Surface`; None of smooth ones."""
    return summed(surface for _, surface in parts_of(config))


def parts_of(config):
    """(Key, `Surface`) of every surface."""
    for name in NAMES:
        section = getattr(config, name)
        if section.is_given:
            key = "file" if section.file is not None else "kind"
            yield f"{name}.{key} = {getattr(section, key)!r}", surface_of(section)
    own = own_surface_from(config)
    if own:
        yield f"contact.surface = {config.contact.surface!r}", own


def surface_of(section):
    """The `Surface` of a section that gives one."""
    return _BUILT[section.source](section, {"x": section.x, "y": section.y})


def _waviness(section, at):
    lengths = section.wavelength_x, section.wavelength_y
    return Waviness(section.amplitude, *lengths, angle=section.angle, **at)


def _self_affine(section, at):
    cut_offs = section.shortest_wavelength, section.longest_wavelength
    shape = section.hurst, section.seed, section.aspect, section.angle
    return SelfAffine(section.rms, *cut_offs, *shape, **at)


def _measured(section, at):
    preparation = Preparation(
        height_unit=section.height_unit and UNITS[section.height_unit],
        position_unit=section.position_unit and UNITS[section.position_unit],
        dx=section.spacing,
        dy=section.spacing_y,
        remove=section.remove,
        shortest_wavelength=section.shortest_wavelength,
        longest_wavelength=section.longest_wavelength,
        continuation=section.continuation,
    )
    return Measured(section.file, preparation, angle=section.angle, **at)


_BUILT = {
    "waviness": _waviness,
    "self-affine": _self_affine,
    "dent": lambda section, at: Dent(section.amplitude, section.width, **at),
    "ridge": lambda section, at: Ridge(section.amplitude, section.width, angle=section.angle, **at),
    "file": _measured,
}


def check_surfaces(config, contact, mesh):
    """Raise ConfigError unless every surface covers the contact with heights that a ball may have."""
    radius = min(config.contact.radius_x, np.inf if contact.is_plane else config.contact.radius_y)
    x, y = mesh.X * contact.x_scale, mesh.Y * contact.y_scale
    for key, surface in parts_of(config):
        with _naming(key):
            if isinstance(surface, OwnSurface):
                surface.check(x, y, contact.hertz.a)
            else:
                _check_heights(key, surface, x, y, radius)
                _check_size(key, surface, contact)


def check_known(config, contact):
    """Raise ConfigError unless every surface has heights: an "auto" domain asks for them."""
    side = contact.hertz.a * np.linspace(-1.0, 1.0, 3)
    for key, surface in parts_of(config):
        with _naming(key):
            if isinstance(surface, OwnSurface):
                surface.check(side, side, contact.hertz.a)
            else:
                surface.height(side[None, :], side[:, None])


@contextmanager
def _naming(key):
    """What is wrong with a surface becomes a ConfigError with its key."""
    try:
        yield
    except OwnFunctionError as error:
        raise ConfigError(f"contact.surface = {error}") from None
    except SurfaceFileError as error:
        raise ConfigError(f"{key}: {_about(error, key)}") from None


def _about(error, key):
    """What is wrong with a file, without its name: the key has said that already."""
    return error.what if repr(error.path) in key else str(error)


def _check_heights(key, surface, x, y, radius):
    for first in range(0, len(y), LINES):
        lines = y[first : first + LINES]
        heights = np.abs(surface.height(x[None, :], lines[:, None]))
        if heights.max() > HIGHEST * radius:
            j, i = np.unravel_index(heights.argmax(), heights.shape)
            raise ConfigError(
                f"{key}: its height is {heights[j, i]:.3g} m at x = {x[i]:.3g} m, y = {lines[j]:.3g} m; "
                f"must be at most {HIGHEST * radius:.3g}, a tenth of the radius"
            )


def _check_size(key, surface, contact):
    """A file that does not go on beyond its edge must cover the dry contact."""
    if not isinstance(surface, Measured):
        return
    turn = np.linspace(0.0, 2.0 * np.pi, 73)
    across = 0.0 if contact.is_plane else contact.y_scale
    x, y = contact.reach * contact.x_scale * np.cos(turn), contact.reach * across * np.sin(turn)
    missing = ~surface.reaches(x, y)
    if missing.any():
        i, (width, length) = int(missing.argmax()), surface.heights.size
        raise ConfigError(
            f"{key}: is {width:.3g} m by {length:.3g} m and ends inside the contact, such as at "
            f"x = {x[i]:.3g} m, y = {y[i]:.3g} m; give a larger one, or a continuation"
        )
