"""What drags bodies that roll and slide beyond the domain, where all is full of oil but the wake.

Around a point contact the pressure is p = -K x/h^2, as of rigid bodies [Kapitza 1955], in the gap of the
pressed ones. Beside a line contact it rises by dp/dx = 12 eta u (h - h_c)/h^3. Oil between
surfaces that slide is sheared as hardly pressed oil is, tau = eta (u_1 - u_2)/h by Newton's law.
"""

import numpy as np

from mgehl.model.conditions import Conditions


def kapitza_factor(lubricant, speed, along, across):
    """K in N/m of Kapitza's p = -K x/h^2, a body with these radii along and across the motion in m."""
    return 12.0 * lubricant.viscosity * speed / (3.0 + 2.0 * along / across)


WAYS = 360
"""Directions of the quadrature around a point contact, from the middle of each: good to four digits."""

STEP = 1e-4
"""Over the distance: of the differences that tell how the gap opens along the motion."""

TORN = 1.0 / 3.0
"""Distance downstream over that beside at which the film tears: around a ball, and near enough another."""

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


def point_drag_beyond(contact, x, y, downstream):
    """Half of the integral of h dp/dx along the motion, in N, from the end of a domain, at `x` and `y` in
    units of X and Y, to a radius of curvature away, where bodies are no paraboloids any more: it grows with
    the logarithm of that distance. Upstream, and `downstream`, too; gap as in `line_drag_beyond`."""
    motion_x, motion_y = _motion(contact)
    radii, lubricant, speed = (contact.radius_x, contact.radius_y), contact.lubricant, contact.speed
    K_x = kapitza_factor(lubricant, speed * motion_x, *radii)
    K_y = kapitza_factor(lubricant, speed * motion_y, *radii[::-1])

    def dragged(px, py):
        h, step = _gap(contact, px, py), STEP * np.hypot(px, py)
        ahead, behind = (_gap(contact, px + way * motion_x, py + way * motion_y) for way in (step, -step))
        steepness = (ahead - behind) / (2.0 * step)
        return 2.0 * (K_x * px + K_y * py) * steepness / h**2 - (K_x * motion_x + K_y * motion_y) / h

    return max(0.5 * _integral_beyond(contact, x, y, downstream, dragged), 0.0)


def line_shear_beyond(contact, x, downstream):
    """What the shear of the oil takes from surfaces that slide, in N/m, from the domain's end upstream on,
    and `downstream`, too; gap and end as in `line_drag_beyond`."""
    near = 0.5 + NODES
    total = 0.0
    for end in (-x[0], x[1])[: 1 + downstream]:
        gap = _gap(contact, contact.x_scale * end / near, None)
        total += float(np.sum(WEIGHTS * end / near**2 * _shear_stress(contact, gap)))
    return contact.x_scale * total


def point_shear_beyond(contact, x, y, downstream):
    """The same in N, from the end of a domain, at `x` and `y` in units of X and Y, as far as in
    `point_drag_beyond`. Where the film tears, downstream what goes on beside the domain; `wake_shear` is
    what goes on behind it."""

    def sheared(px, py):
        return _shear_stress(contact, _gap(contact, px, py))

    found = _integral_beyond(contact, x, y, downstream, sheared)
    return found if downstream else found + _beside_the_wake(contact, x, y)


def _beside_the_wake(contact, x, y):
    """Shear in N of the oil that flows past a domain: full up to the line on which it tears, then in the
    streamers that leave that line."""
    c, s = _motion(contact)
    full = 0.5 + NODES[:, None]  # of the way to that line
    total = 0.0
    for left in (1.0, -1.0):
        end = max(left * (c * py * contact.y_scale - s * px * contact.x_scale) for px in x for py in y)
        far = max(end, contact.radius_y if c > s else contact.radius_x)
        beside = end * (far / end) ** (0.5 + NODES)  # evenly in its logarithm
        torn_x, torn_y = TORN * beside * c, TORN * beside * s
        side_x, side_y = -s * left * beside, c * left * beside
        before = _shear_stress(contact, _gap(contact, side_x + full * torn_x, side_y + full * torn_y))
        line = side_x + torn_x, side_y + torn_y
        sheared = TORN * beside * (WEIGHTS @ before) + wake_shear(contact, *line, _gap(contact, *line))
        total += float(np.log(far / end) * (WEIGHTS @ (beside * sheared)))
    return total


def wake_shear(contact, x, y, content):
    """Shear of the oil behind points of a domain's end, at `x` and `y` in m (None of a line contact), in N
    per m across the motion, shape as theirs. There the gap is torn: a streamer goes on along the motion
    with its `content`, the oil in m that the gap holds, and no film heals."""
    c, s = _motion(contact)
    far = np.abs(x) if y is None else np.hypot(x, y)
    # What lies before the middle of the contact counts as upstream.
    abeam = np.maximum(-(c * x + (0.0 if y is None else s * y)), 0.0)
    near = 0.5 + NODES[:, None]  # from infinity to there
    way = abeam + far * (1.0 / near - 1.0)
    gap = _gap(contact, x + way * c, None if y is None else y + way * s)
    sheared = _shear_stress(contact, gap) * np.minimum(content / gap, 1.0)
    return WEIGHTS @ (far / near**2 * sheared)


def _motion(contact):
    """Its parts along X and Y, neither below 0: the domain's ends are turned to it."""
    return tuple(map(abs, contact.motion))


def _integral_beyond(contact, x, y, downstream, stress):
    """Integral of a `stress` at (x, y) in m from a domain's end to a radius of curvature away."""
    angles = (np.arange(WAYS) + 0.5) * 2.0 * np.pi / WAYS
    c, s = np.cos(angles), np.sin(angles)
    near = np.minimum(_way(c, x, contact.x_scale), _way(s, y, contact.y_scale))
    far = np.maximum(1.0 / (c**2 / contact.radius_x + s**2 / contact.radius_y), near)
    r = near * (far / near) ** (0.5 + NODES[:, None])  # evenly in its logarithm, as what is sheared falls
    of_each = np.log(far / near) * (WEIGHTS @ (r**2 * stress(r * c, r * s)))
    motion_x, motion_y = _motion(contact)
    counted = (c * motion_x + s * motion_y < 0.0) | downstream
    return float(2.0 * np.pi * np.mean(np.where(counted, of_each, 0.0)))


def _gap(contact, x, y):
    """In m at (x, y) in m: that of the dry contact and a formula's film. A line contact has no y."""
    dry = contact.dry_gap(x / contact.x_scale, None if y is None else y / contact.y_scale)
    return contact.flooded_film + contact.film_scale * dry


def _shear_stress(contact, gap):
    """In Pa, of oil that is pressed no more than around the contact, where the gap is so many m."""
    oil, speed = contact.lubricant, contact.friction.sliding_speed(contact.speed)
    pressure, viscosity = (np.full(gap.shape, each) for each in (oil.ambient_pressure, oil.cold_viscosity))
    return contact.friction.rheology.shear_stress(Conditions(pressure, viscosity, shear_rate=speed / gap))


def _way(part, ends, scale):
    """Metres to the side of the domain in directions with this `part` along its normal."""
    return np.where(part > 0.0, ends[1], ends[0]) * scale / part
