"""The load that a film carries beyond its domain: a tenth of it and more where a light load floats on oil.

Far outside the contact the bodies are rigid, the oil is thin, and the pressure is that of Kapitza (1955),

    p = -K x/h^2,   h = h_0 + x^2/2R_x + y^2/2R_y,   K = 12 eta u/(3 + 2 R_x/R_y)

upstream; downstream the film tears. Its load beyond a distance falls only as 1 over that distance. So a
domain that is to hold all of a light load is hundreds of semi-axes wide, and no grid resolves its inlet.
This load is known, however: the film in the domain need not carry it.
"""

from math import log

import numpy as np

MISSING, WIDE = 1.65, 0.07
"""Load that is missing in a domain over Kapitza's load beyond it: of a ball, and how much less it is by the
square of ln b/a where the contact is wide.

The film tears downstream of where Kapitza's pressure is zero, which is 1.05 times the load. And the sides
of the domain, where the pressure is zero, lower the pressure within: around a circle by half as much again.
Balls of M = 2, 3 and 5 on domains that end 10 to 40 semi-axes upstream and half as far beside ask for 1.64
to 1.68, by what they have on 160; domains as long downstream as upstream ask for 1.56 to 1.59. Bodies four
and ten times as curved along the motion as across it ask for some 1.59 and 1.51 on the domain of "auto"."""

MOST = 0.5
"""Part of the load that may be missing at the most: beyond it the domain ends in the contact's own film."""

DIRECTIONS = 3600
"""Of the quadrature around the contact, from the middle of each: good to six digits."""


def kapitza_factor(lubricant, speed, along, across):
    """K in N/m of a body with these radii along and across the motion, in m."""
    return 12.0 * lubricant.viscosity * speed / (3.0 + 2.0 * along / across)


def kapitza_load_beyond(contact, x, y):
    """Newtons that Kapitza's pressure carries upstream beyond a domain, its ends in units of X and Y."""
    c, s, way, curvature, K = _rays(contact, x, y)
    pressing = np.maximum(-(K[0] * c + K[1] * s), 0.0)
    return float(np.mean(pressing * _along_rays(way, curvature, contact.flooded_film)) * 2.0 * np.pi)


def kapitza_drag_beyond(contact, x, y):
    """Half of the integral of h dp/dx along the motion, in N, upstream from the end of a domain to where
    bodies are no paraboloids any more: a radius of curvature away.

    It grows with the logarithm of that distance, so it has no limit but the bodies' own size.
    """
    c, s, way, curvature, K = _rays(contact, x, y)
    motion_x, motion_y = contact.motion
    steepness = c * motion_x / contact.radius_x + s * motion_y / contact.radius_y
    pressing = K[0] * c + K[1] * s
    dragged = 2.0 * pressing * steepness / curvature - K[0] * motion_x - K[1] * motion_y
    ratio = np.maximum(1.0 / (2.0 * curvature * way), 1.0)
    return float(np.mean(np.where(pressing < 0.0, dragged * np.log(ratio) / curvature, 0.0)) * np.pi)


def _rays(contact, x, y):
    """Directions (c, s) around a contact, metres to the end of the domain, h/r^2, K along x and y."""
    angles = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
    c, s = np.cos(angles), np.sin(angles)
    motion_x, motion_y = contact.motion
    radii, lubricant, speed = (contact.radius_x, contact.radius_y), contact.lubricant, contact.speed
    K_x = kapitza_factor(lubricant, speed * motion_x, *radii)
    K_y = kapitza_factor(lubricant, speed * motion_y, *radii[::-1])
    curvature = 0.5 * (c**2 / radii[0] + s**2 / radii[1])
    way = np.minimum(_way(c, x, contact.x_scale), _way(s, y, contact.y_scale))
    return c, s, way, curvature, (K_x, K_y)


def missing_share(contact, x, y):
    """Part of a contact's load that is missing in a domain, its ends in units of X and Y."""
    missing = MISSING - WIDE * min(log(contact.likeness.k_e), 0.0) ** 2
    return min(missing * kapitza_load_beyond(contact, x, y) / contact.load, MOST)


def _way(part, ends, scale):
    """Metres to the side of the domain in directions with this `part` along its normal."""
    return np.where(part > 0.0, ends[1], ends[0]) * scale / part


def _along_rays(way, curvature, film):
    """Integral of r^2/h^2 from the end of a way on, with h = film + curvature r^2."""
    end = way / (2.0 * curvature * (film + curvature * way**2))
    rest = np.arctan2(np.sqrt(film), way * np.sqrt(curvature))
    return end + rest / (2.0 * curvature**1.5 * np.sqrt(film))
