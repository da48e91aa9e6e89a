"""Slow dense matrices that say the same as the stencils and kernels."""

import numpy as np

OFFSETS = ((0, -2), (0, -1), (0, 0), (0, 1), (-1, 0), (1, 0))
"""Line and node offsets of the stencil positions WW, W, C, E, S, N."""


def line_stencils(rng, lines, nx):
    """Random A and B; line ends couple to nothing else and node 1 to no WW, as `linearise` has it."""
    A, B = rng.standard_normal((2, 6, lines, nx))
    for stencil in (A, B):
        stencil[:, :, [0, -1]] *= (np.arange(6) == 2)[:, None, None]
        stencil[0, :, 1] = 0.0
    # Diagonal entries that keep a factorisation without pivoting far from zero pivots.
    A[2] += 8.0
    return A, B


def dense_stencil(stencil):
    """Matrix (lines nx, (lines + 2) nx) from ghosted nodes to rows."""
    _, lines, nx = stencil.shape
    matrix = np.zeros((lines, nx, lines + 2, nx))
    for (dj, di), coefficient in zip(OFFSETS, stencil, strict=True):
        for j, i in np.argwhere(coefficient != 0.0):
            matrix[j, i, j + 1 + dj, i + di] = coefficient[j, i]
    return matrix.reshape(lines * nx, -1)


def dense_K(K, lines, nx):
    """The convolution with influence coefficients [l, k] as a matrix."""
    j, i = np.indices((lines, nx)).reshape(2, -1)
    return K[np.abs(np.subtract.outer(j, j)), np.abs(np.subtract.outer(i, i))]


def held_beyond(K_Q, lines, nx, reach):
    """K Q ((lines + 2) nx, lines nx) whose columns keep, beyond `reach` along X, their value there."""
    far = K_Q.reshape(lines + 2, nx, lines, nx).copy()
    for i, m in np.ndindex(nx, nx):
        if abs(i - m) > reach:
            # A column is even along X: whichever side lies on the line will do.
            far[:, i, :, m] = far[:, m + reach if m + reach < nx else m - reach, :, m]
    return far.reshape(K_Q.shape)


def dense_Q(distributive, share):
    """Columns of Q for the inner nodes of ghosted lines: ((lines + 2) nx, lines nx)."""
    lines, nx = distributive.shape
    Q = np.zeros((lines + 2, nx, lines, nx))
    for j, i in np.ndindex(lines, nx):
        Q[j + 1, i, j, i] = 1.0
        if distributive[j, i]:
            for dj, di in ((-1, 0), (1, 0), (0, -1), (0, 1)):
                if 0 <= i + di < nx:
                    Q[j + 1 + dj, i + di, j, i] = -share
    return Q.reshape(-1, lines * nx)
