"""What is on the bodies, by the keys of [surface] and [second_surface]; their heights add up.

`contact.surface`, a function of the user's own, adds to them.
"""

import numpy as np

from mgehl.errors import ConfigError
from mgehl.kinds.own import naming
from mgehl.kinds.surface_kinds import NAMES, every_surface, share_of, surface_of
from mgehl.kinds.time import ways_of
from mgehl.model.frame import direction
from mgehl.model.own_laws import OwnSurface
from mgehl.model.scene import Moved
from mgehl.model.surface import Measured, summed
from mgehl.model.surface.doubts import farthest
from mgehl.model.surface.self_affine import LARGEST_SPAN

LINES = 256
"""Lines of a grid whose heights are looked at together."""

HIGHEST = 0.1
"""Largest height over the smaller radius of the bodies."""


def check_keys(config):
    """Raise ConfigError where the values of a surface contradict each other."""
    for name in NAMES:
        section = getattr(config, name)
        if section.kind == "waviness" and section.wavelength_x is None and section.wavelength_y is None:
            other = "" if config.contact.kind == "line" else f" it or {name}.wavelength_y"
            either = f"{name}.wavelength_x:{other}"
            raise ConfigError(f'{either} must be given with {name}.kind = "waviness"')
        _check_cut_offs(name, section)
        if not config.is_in_time:
            _check_motion(name, section, config.motion)


def _check_cut_offs(name, section):
    shortest, longest = section.shortest_wavelength, section.longest_wavelength
    if shortest is None or longest is None:
        return
    what = f"{name}.shortest_wavelength = {shortest:g}: must be"
    if not shortest < longest:
        raise ConfigError(f"{what} below {longest:g}, {name}.longest_wavelength")
    if section.kind == "self-affine" and section.aspect * longest > LARGEST_SPAN * shortest:
        raise ConfigError(
            f"{what} at least the longest wavelength times {name}.aspect over {LARGEST_SPAN:g}, "
            f"{section.aspect * longest / LARGEST_SPAN:.3g}"
        )


def _check_motion(name, section, motion):
    """The heights of a body that moves must be the same all along the motion."""
    moves = share_of(section.body, motion.slip) != 0.0
    if not moves or (surface := surface_of(section)) is None:
        return
    if surface.varies_along(direction(motion.angle)):
        raise ConfigError(
            f'{name}.body = "{section.body}": its heights change along the motion, and so the film with '
            "time: give time.end for a run in time; in a steady state the rough body stands still"
        )


def surface_from(config):
    """All that is on the bodies as one `Surface`; None of smooth ones."""
    return summed(surface for _, surface in parts_of(config))


def parts_of(config):
    """(Key, `Surface`) of every surface."""
    return [(key, surface) for key, surface, _ in every_surface(config)]


def check_surfaces(config, contact, mesh):
    """Raise ConfigError unless every surface covers the contact with heights that a ball may have."""
    radius = min(config.contact.radius_x, np.inf if contact.is_line else config.contact.radius_y)
    x, y = mesh.X * contact.x_scale, mesh.Y * contact.y_scale
    for key, surface in parts_of(config):
        with naming(key):
            if isinstance(surface, OwnSurface):
                surface.check(x, y, contact.hertz.a)
            else:
                _check_form(key, surface, contact)
                _check_heights(key, surface, x, y, radius)
                _check_size(key, surface, contact)
    check_ways(config, contact)


def check_ways(config, contact, begin=(0.0, 0.0)):
    """Raise ConfigError unless every surface covers the contact wherever it goes in time.

    The mean surface has gone the path `begin` in m before.
    """
    for key, surface in parts_of(config):
        if not isinstance(surface, Measured):
            continue
        with naming(key):
            for way in ways_of(config, contact, key.partition(".")[0], begin):
                _check_size(key, Moved(surface, way), contact, "on its way ")


def check_known(config, contact):
    """Raise ConfigError unless every surface has heights: an "auto" domain asks for them."""
    side = contact.hertz.a * np.linspace(-1.0, 1.0, 3)
    for key, surface in parts_of(config):
        with naming(key):
            if isinstance(surface, OwnSurface):
                surface.check(side, side, contact.hertz.a)
            else:
                surface.height(side[None, :], side[:, None])


def _check_heights(key, surface, x, y, radius):
    """Heights may not be too large, of a file at its own points, wherever the nodes are.

    A height that all have in common is no matter there.
    """
    common = 0.0
    if isinstance(surface, Measured):
        common, point = np.median(surface.heights.points), farthest(surface.heights.points)
        off, most = 1e6 * point.height, 1e6 * HIGHEST * radius
        if abs(off) > most:
            raise ConfigError(
                f"{key}: row {point.row}, column {point.column} is {off:.4g} um off the median; must be at "
                f"most {most:.4g}, a tenth of the radius; is it a missing value?"
            )
    for first in range(0, len(y), LINES):
        lines = y[first : first + LINES]
        heights = np.abs(surface.height(x[None, :], lines[:, None]) - common)
        if heights.max() > HIGHEST * radius:
            j, i = np.unravel_index(heights.argmax(), heights.shape)
            raise ConfigError(
                f"{key}: its height is {heights[j, i]:.3g} m at x = {x[i]:.3g} m, y = {lines[j]:.3g} m; "
                f"must be at most {HIGHEST * radius:.3g}, a tenth of the radius"
            )


def _check_form(key, surface, contact):
    """A profile is of a line contact."""
    if isinstance(surface, Measured) and surface.heights.is_profile and not contact.is_line:
        raise ConfigError(
            f'{key}: is a profile along a line, which contact.kind = "line" takes; a point contact needs '
            "heights over a rectangle"
        )


def _check_size(key, surface, contact, when=""):
    """A file that does not go on beyond its edge must cover the dry contact."""
    file = surface.surface if isinstance(surface, Moved) else surface
    if not isinstance(file, Measured):
        return
    turn = np.linspace(0.0, 2.0 * np.pi, 73)
    across = 0.0 if contact.is_line else contact.y_scale
    x, y = contact.reach * contact.x_scale * np.cos(turn), contact.reach * across * np.sin(turn)
    missing = ~surface.reaches(x, y)
    if missing.any():
        i = int(missing.argmax())
        at = f"x = {1e6 * x[i]:.4g} um" + ("" if contact.is_line else f", y = {1e6 * y[i]:.4g} um")
        raise ConfigError(
            f"{key}: is {file.heights.size_words} and {when}ends inside the contact, such as at {at}; "
            "give a larger one, or a continuation"
        )
