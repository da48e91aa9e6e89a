"""Central and minimum film between the nodes, so that films of different grids can be compared.

A node lies at the centre by chance, and never at the bottom of the smallest gap: its film varies from grid
to grid by a few per cent. So films come from polynomials through the nodes around, but a run's minimum.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.solver.extrapolation import weights_at

_OFFSETS = np.array([-1.0, 0.0, 1.0])
_WEIGHTS = np.array([0.5, 1.0, 0.5])
"""Of the nodes in the fit of a paraboloid: those in the corners count least."""

AROUND = 3
"""Nodes on each side of the centre over which a difference of films is looked at."""

ALONG, BESIDE = 2, np.array([0.5, 1.0, 0.5])
"""Nodes on each side of the smallest gap, along its line, over which a difference of films is averaged, and
weights of the line before, its own and the one after. Nine alike make the minimum's bands a tenth wider."""


@dataclass(frozen=True)
class GridFilm:
    """Films of a grid's answer at the run's speed, in nm, between the nodes where need be. On a coarser
    grid the minimum is that of the finer one, less what differs at their common nodes around."""

    nodes: int
    central_nm: float
    minimum_nm: float
    contact_nodes: int
    settled: bool
    around_nm: float = 0.0
    """Difference from the finer grid around the centre, a root mean square."""
    spread_nm: float = 0.0
    """By how much the difference varies around the smallest gap, a standard deviation."""

    @property
    def is_film(self):
        """Whether the whole contact has a film there."""
        return self.settled and not self.contact_nodes


def films_between_nodes(problem, state):
    """Central film and bottom of the smallest gap, in units of H (collective)."""
    mesh = problem.grid.mesh
    return problem.grid.on_first(lambda H: (at_centre(H, mesh), smallest(H)), state.H)


def films_beside(problem, state, minimum, H):
    """The same of a coarser grid, beside a finer one of this `minimum`, whose gap at this grid's nodes is
    `H`, (lines, nx); and `around` and `spread` of a `GridFilm`, all in units of H (collective).

    The smallest gap is the finer grid's, less the mean of the gaps' differences around the node where `H`
    is smallest. This grid's own is too narrow for a polynomial: its difference often has the wrong sign.
    """
    mesh = problem.grid.mesh

    def found(whole, of_finer):
        difference = of_finer - whole
        mean, spread = _mean_and_spread(difference, *np.unravel_index(np.argmin(of_finer), of_finer.shape))
        return at_centre(whole, mesh), minimum - mean, _around_centre(difference, mesh), spread

    return problem.grid.on_first(found, state.H, H)


def _mean_and_spread(values, j, i):
    """Mean and standard deviation, weighted by line, of values (ny, nx) at a node and those around it."""
    lines = slice(max(j - 1, 0), j + 2)
    part = values[lines, max(i - ALONG, 0) : i + ALONG + 1]
    weights = BESIDE[lines.start - j + 1 :][: len(part), None] * np.ones(part.shape)
    mean = np.average(part, weights=weights)
    return float(mean), float(np.sqrt(np.average((part - mean) ** 2, weights=weights)))


def _around_centre(values, mesh):
    """Root mean square of values (ny, nx) at the nodes around the centre."""
    at = (int(np.argmin(np.abs(nodes))) for nodes in (mesh.Y, mesh.X))
    part = values[tuple(slice(max(k - AROUND, 0), k + AROUND + 1) for k in at)]
    return float(np.sqrt(np.mean(part**2)))


def at_centre(H, mesh):
    """H, (ny, nx), at the centre."""
    return float(np.vdot(weights_of_centre(mesh), H))


def weights_of_centre(mesh):
    """What nodes count for a value at the centre, (ny, nx): cubics through four along either axis."""
    across = np.ones(1) if mesh.is_line else _cubic(mesh.Y, 0.0)
    return np.outer(across, _cubic(mesh.X, 0.0))


def _cubic(nodes, point):
    """Lagrange's weights of the four nodes around a point, and none of the others."""
    at = (point - nodes[0]) / (nodes[1] - nodes[0])
    first = int(np.clip(np.floor(at) - 1, 0, len(nodes) - 4))
    weights = np.zeros(len(nodes))
    weights[first : first + 4] = weights_at(np.arange(4), at - first)
    return weights


def smallest(H):
    """Bottom of the smallest gap of H, (ny, nx), by a paraboloid through the nodes around the lowest."""
    j, i = np.unravel_index(np.argmin(H), H.shape)
    inside = 0 < i < H.shape[1] - 1
    if inside and len(H) == 1:
        return _bottom_along(H[0, i - 1 : i + 2])
    if inside and 0 < j < len(H) - 1:
        return _bottom_around(H[j - 1 : j + 2, i - 1 : i + 2])
    return float(H[j, i])


def _bottom_along(H):
    """Of a parabola through three nodes, the middle one the lowest."""
    slope, curvature = 0.5 * (H[2] - H[0]), H[2] - 2.0 * H[1] + H[0]
    return float(H[1] - (0.5 * slope**2 / curvature if curvature > 0.0 else 0.0))


def _bottom_around(H):
    """Of the paraboloid that fits nine nodes best, the middle one the lowest."""
    x, y = np.meshgrid(_OFFSETS, _OFFSETS)
    weights = np.outer(_WEIGHTS, _WEIGHTS)
    terms = np.stack([x, y, 0.5 * x**2, x * y, 0.5 * y**2, np.ones_like(x)]).reshape(6, 9)
    fitted = np.linalg.lstsq((terms * weights.ravel()).T, (weights * H).ravel(), rcond=None)[0]
    slope, (xx, xy, yy) = fitted[:2], fitted[2:5]
    curvature = np.array([[xx, xy], [xy, yy]])
    if np.linalg.eigvalsh(curvature)[0] <= 0.0:
        return min(_bottom_along(H[1]), _bottom_along(H[:, 1]))
    to = np.clip(np.linalg.solve(curvature, -slope), -1.0, 1.0)
    return float(H[1, 1] + min(0.0, 0.5 * to @ curvature @ to + slope @ to))
