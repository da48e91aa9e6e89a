"""Values of one mesh's nodes at those of another."""

import numpy as np
from scipy.interpolate import RegularGridInterpolator


def onto(mesh, old, values, outside=0.0, method="linear"):
    """Values (ny, nx) of the `old` mesh's nodes at those of `mesh`, by a `method` of scipy's
    RegularGridInterpolator along each axis; `outside` beyond the old mesh."""
    found = [(old.X, mesh.X)] if old.is_line else [(old.Y, mesh.Y), (old.X, mesh.X)]
    nodes, wanted = zip(*found, strict=True)
    known = values[0] if old.is_line else values
    function = RegularGridInterpolator(nodes, known, method, bounds_error=False, fill_value=outside)
    return function(tuple(np.meshgrid(*wanted, indexing="ij"))).reshape(mesh.ny, mesh.nx)
