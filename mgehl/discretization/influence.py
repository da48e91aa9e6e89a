"""Influence coefficients of uniform pressure on rectangles or strips around nodes  [Liu eq. 51]."""

import numpy as np


def influence_coefficients(mesh, kernel, first=0, last=None):
    """Deflection l lines and k nodes away from a node carrying unit P: [l - first, k], lines `first` to
    `last` (default all), k from 0 to nx - 1. The `kernel` (`contact.kernel`) tells the deflection by unit P
    on the rectangle dX by dY/k_e, in units of a, around each node; on a single line by the strip dX."""
    last = mesh.ny if last is None else last
    x = (np.arange(mesh.nx + 1) - 0.5) * mesh.dX
    if mesh.is_line:
        K = np.zeros((last, mesh.nx))
        K[0] = kernel.of_strips(x)
        return K[first:]
    y = (np.arange(first, last + 1) - 0.5) * (mesh.dY / mesh.k_e)
    return kernel.of_rectangles(x, y)
