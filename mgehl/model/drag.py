"""What drags bodies that roll beyond the domain, where they are rigid and all is full of oil.

Far upstream of the contact the pressure is that of Kapitza (1955), p = -K x/h^2 with h = x^2/2R_x + y^2/2R_y.
"""

import numpy as np

DIRECTIONS = 3600
"""Of the quadrature around the contact, from the middle of each: good to six digits."""


def kapitza_factor(lubricant, speed, along, across):
    """K in N/m of Kapitza's p = -K x/h^2, a body with these radii along and across the motion in m."""
    return 12.0 * lubricant.viscosity * speed / (3.0 + 2.0 * along / across)


def kapitza_drag_beyond(contact, x, y):
    """Half of the integral of h dp/dx along the motion, in N, upstream from the end of a domain to where
    bodies are no paraboloids any more: a radius of curvature away. x and y are the domain's ends in units of
    X and Y.

    It grows with the logarithm of that distance, so it has no limit but the bodies' own size.
    """
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
    return float(np.mean(np.where(pressing < 0.0, dragged * np.log(ratio) / curvature, 0.0)) * np.pi)


def _way(part, ends, scale):
    """Metres to the side of the domain in directions with this `part` along its normal."""
    return np.where(part > 0.0, ends[1], ends[0]) * scale / part
