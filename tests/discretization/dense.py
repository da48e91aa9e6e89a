"""Slow dense matrices that say the same as the stencils and kernels."""

import numpy as np

from mgehl.discretization.axes import HALO

ALONG_X = ((0, 0), (0, -2), (0, -1), (0, 1), (-1, 0), (1, 0))
"""(lines, nodes) to the neighbours of a stencil that looks two nodes upstream along X, the node first."""

BOTH_WAYS = ((0, 0), (0, -2), (0, -1), (0, 1), (0, 2), (-2, 0), (-1, 0), (1, 0), (2, 0))
"""As far as any scheme looks along both axes."""


def line_stencils(rng, offsets, lines, nx):
    """Random A and B that reach no node beyond a line's ends; the ends couple to nothing else."""
    A, B = rng.standard_normal((2, len(offsets), lines, nx))
    node = np.arange(nx)
    for k, (line, ahead) in enumerate(offsets):
        there = (0 <= node + ahead) & (node + ahead < nx)
        if (line, ahead) != (0, 0):
            there &= (node > 0) & (node < nx - 1)
        A[k] *= there
        B[k] *= there
    # Diagonal entries that keep a factorisation without pivoting far from zero pivots.
    A[0] += 8.0
    return A, B


def dense_stencil(offsets, stencil):
    """Matrix (lines nx, (lines + 2 HALO) nx) from ghosted nodes to rows."""
    _, lines, nx = stencil.shape
    matrix = np.zeros((lines, nx, lines + 2 * HALO, nx))
    for (dj, di), coefficient in zip(offsets, stencil, strict=True):
        for j, i in np.argwhere(coefficient != 0.0):
            matrix[j, i, j + HALO + dj, i + di] = coefficient[j, i]
    return matrix.reshape(lines * nx, -1)


def dense_K(K, lines, nx):
    """The convolution with influence coefficients [l, k] as a matrix."""
    j, i = np.indices((lines, nx)).reshape(2, -1)
    return K[np.abs(np.subtract.outer(j, j)), np.abs(np.subtract.outer(i, i))]


def held_beyond(K_Q, lines, nx, reach):
    """K Q (ghosted lines nx, lines nx) whose columns keep, beyond `reach` along X, their value there."""
    far = K_Q.reshape(lines + 2 * HALO, nx, lines, nx).copy()
    for i, m in np.ndindex(nx, nx):
        if abs(i - m) > reach:
            # A column is even along X: whichever side lies on the line will do.
            far[:, i, :, m] = far[:, m + reach if m + reach < nx else m - reach, :, m]
    return far.reshape(K_Q.shape)


def dense_Q(distributive, share):
    """Columns of Q for the nodes of own lines: ((lines + 2 HALO) nx, lines nx)."""
    lines, nx = distributive.shape
    Q = np.zeros((lines + 2 * HALO, nx, lines, nx))
    for j, i in np.ndindex(lines, nx):
        Q[j + HALO, i, j, i] = 1.0
        if distributive[j, i]:
            for dj, di in ((-1, 0), (1, 0), (0, -1), (0, 1)):
                if 0 <= i + di < nx:
                    Q[j + HALO + dj, i + di, j, i] = -share
    return Q.reshape(-1, lines * nx)


def dense_JQ(offsets, A, B, K, distributive, share, reach):
    """(A + B K) Q of own lines, (lines, nx, lines, nx), K Q held beyond `reach`."""
    lines, nx = distributive.shape
    Q = dense_Q(distributive, share)
    K_Q = held_beyond(dense_K(K, lines + 2 * HALO, nx) @ Q, lines, nx, reach)
    JQ = dense_stencil(offsets, A) @ Q + dense_stencil(offsets, B) @ K_Q
    return JQ.reshape(lines, nx, lines, nx)
