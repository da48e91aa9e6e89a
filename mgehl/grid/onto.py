"""Values of one mesh's nodes at those of another."""

import numpy as np
from scipy.interpolate import RegularGridInterpolator


def onto(mesh, old, values, outside=0.0):
    """Values (ny, nx) of the `old` mesh's nodes at those of `mesh`: bilinear, and `outside` beyond it."""
    if old.is_line:
        return np.interp(mesh.X, old.X, values[0], left=outside, right=outside)[None, :]
    function = RegularGridInterpolator((old.Y, old.X), values, bounds_error=False, fill_value=outside)
    return function(tuple(np.meshgrid(mesh.Y, mesh.X, indexing="ij")))
