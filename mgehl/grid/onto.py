"""Values of one mesh's nodes at those of another."""

import numpy as np
from scipy.interpolate import RegularGridInterpolator, make_interp_spline


def onto(mesh, old, values, outside=0.0):
    """Values (ny, nx) of the `old` mesh's nodes at those of `mesh`: bilinear, and `outside` beyond it."""
    if old.is_line:
        return np.interp(mesh.X, old.X, values[0], left=outside, right=outside)[None, :]
    function = RegularGridInterpolator((old.Y, old.X), values, bounds_error=False, fill_value=outside)
    return function(tuple(np.meshgrid(mesh.Y, mesh.X, indexing="ij")))


def smoothly_onto(mesh, old, values):
    """The same by cubic splines, and nan beyond it."""
    along, across = _within(mesh.X, old.X), np.array([True])
    values = make_interp_spline(old.X, values, axis=1)(mesh.X)
    if not old.is_line:
        across = _within(mesh.Y, old.Y)
        values = make_interp_spline(old.Y, values, axis=0)(mesh.Y)
    return np.where(across[:, None] & along, values, np.nan)


def _within(new, old):
    return (new >= old[0]) & (new <= old[-1])
