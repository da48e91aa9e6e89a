"""Influence coefficients of uniform pressure on rectangles or strips around nodes  [Liu eq. 51]."""

import numpy as np


def influence_coefficients(mesh, deflection_scale, first=0, last=None):
    """Deflection l lines and k nodes away from a node carrying unit P: [l - first, k].

    Lines `first` to `last` (default all), k from 0 to nx - 1. Exact integral of 1/r over the
    rectangle dX by dY/k_e (both in units of a) times `deflection_scale`  [Liu eq. 49; Love 1929].
    On a single line the half-plane's: the exact integral of -ln|x| over dX, and no lines beside it.
    """
    last = mesh.ny if last is None else last
    if mesh.is_line:
        return _line_coefficients(mesh, deflection_scale, last)[first:]
    width, height = mesh.dX, mesh.dY / mesh.k_e
    x = (np.arange(mesh.nx + 1) - 0.5) * width
    y = (np.arange(first, last + 1) - 0.5) * height
    corner = _corner_integral(x[None, :], y[:, None])
    return deflection_scale * (corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1])


def _corner_integral(x, y):
    """Integral of 1/r over [0, x] x [0, y]; odd in x and in y."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def _line_coefficients(mesh, deflection_scale, lines):
    """Coefficients of a single line, in the first of `lines` rows."""
    x = (np.arange(mesh.nx + 1) - 0.5) * mesh.dX
    K = np.zeros((lines, mesh.nx))
    K[0] = deflection_scale * np.diff(x - x * np.log(np.abs(x)))
    return K
