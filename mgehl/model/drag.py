"""What drags bodies that roll beyond the domain, where all is full of oil.

Far from a point contact the pressure is that of rigid bodies [Kapitza 1955], p = -K x/h^2 with
h = x^2/2R_x + y^2/2R_y. Beside a line contact it rises by dp/dx = 12 eta u (h - h_c)/h^3.
"""

import numpy as np

DIRECTIONS = 3600
"""Of the quadrature around the contact, from the middle of each: good to six digits."""


def kapitza_factor(lubricant, speed, along, across):
    """K in N/m of Kapitza's p = -K x/h^2, a body with these radii along and across the motion in m."""
    return 12.0 * lubricant.viscosity * speed / (3.0 + 2.0 * along / across)


NODES, WEIGHTS = (0.5 * each for each in np.polynomial.legendre.leggauss(32))
"""Of the quadrature along a line contact, about its middle: good to ten digits."""


def line_drag_beyond(contact, x, downstream):
    """Half of the integral of h dp/dx, in N/m, from the domain's end upstream on, and `downstream`, too.
    The domain ends at `x` in units of X. The gap is that of the dry contact and a formula's film."""
    film = contact.flooded_film / contact.film_scale
    near = 0.5 + NODES  # end/X, from infinity to the end
    total = 0.0
    for end in (-x[0], x[1])[: 1 + downstream]:
        H = film + contact.dry_gap(end / near, None)
        total += float(np.sum(WEIGHTS * end / near**2 * (H - film) / H**2))
    unit = contact.x_scale / contact.film_scale
    return 6.0 * contact.lubricant.viscosity * contact.speed * unit * total


def kapitza_drag_beyond(contact, x, y, downstream=False):
    """Half of the integral of h dp/dx along the motion, in N, from the end of a domain, at `x` and `y` in
    units of X and Y, to a radius of curvature away, where bodies are no paraboloids any more: it grows with
    the logarithm of that distance. Upstream, and `downstream`, too."""
    angles = (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS
    c, s = np.cos(angles), np.sin(angles)
    motion_x, motion_y = contact.motion
    radii, lubricant, speed = (contact.radius_x, contact.radius_y), contact.lubricant, contact.speed
    K_x = kapitza_factor(lubricant, speed * motion_x, *radii)
    K_y = kapitza_factor(lubricant, speed * motion_y, *radii[::-1])
    curvature = 0.5 * (c**2 / radii[0] + s**2 / radii[1])
    way = np.minimum(_way(c, x, contact.x_scale), _way(s, y, contact.y_scale))
    steepness = c * motion_x / contact.radius_x + s * motion_y / contact.radius_y
    pressing = K_x * c + K_y * s
    dragged = 2.0 * pressing * steepness / curvature - K_x * motion_x - K_y * motion_y
    ratio = np.maximum(1.0 / (2.0 * curvature * way), 1.0)
    return float(
        np.mean(np.where((pressing < 0.0) | downstream, dragged * np.log(ratio) / curvature, 0.0)) * np.pi
    )


def _way(part, ends, scale):
    """Metres to the side of the domain in directions with this `part` along its normal."""
    return np.where(part > 0.0, ends[1], ends[0]) * scale / part
