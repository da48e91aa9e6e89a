"""Direct solve of the bordered Jacobian on the coarsest grid, redundantly on every rank that has lines."""

import warnings

import numpy as np
from scipy.linalg import LinAlgWarning, lu_factor, lu_solve
from scipy.sparse.linalg import splu

from mgehl.discretization.influence import influence_coefficients
from mgehl.grid.events import COARSE, event
from mgehl.multigrid.assembled import stencil_rows


class CoarseSolve:
    """LU of J with its border, sparse in a rigid gap; ranks without lines have nothing to do."""

    def __init__(self, jacobian):
        self._jacobian = jacobian
        if jacobian.grid.has_lines and not jacobian.rigid:
            self._K = dense_influence(jacobian.grid.mesh, jacobian.contact.kernel)

    @event(COARSE)
    def factor(self):
        """Gather the stencils, form the matrix and factor it."""
        if self._jacobian.grid.has_lines:
            self._factor()

    def _factor(self):
        with warnings.catch_warnings():
            # Of a singular matrix: the iteration that made it ends by itself.
            warnings.simplefilter("ignore", LinAlgWarning)
            self._invert = self._sparse_inverse() if self._jacobian.rigid else self._dense_inverse()

    def _sparse_inverse(self):
        """Function that solves for the fluid in a rigid gap: its stencil is all that couples its nodes."""
        A = self._gather(self._jacobian.linearisation.A)
        try:
            fluid = splu(A.tocsc())
        except RuntimeError:  # singular: likewise
            return lambda whole: np.full_like(whole, np.nan)
        return lambda whole: np.append(fluid.solve(whole[:-1]), whole[-1])

    def _dense_inverse(self):
        """Function that solves J with its border."""
        jacobian = self._jacobian
        lin, given = jacobian.linearisation, jacobian.grid.whole_of_team(jacobian.given).ravel()
        A, B = self._gather(lin.A), self._gather(lin.B)
        return DenseInverse(A, B, self._K, jacobian.load_weight, given)

    @event(COARSE)
    def solve(self, r, load):
        """Corrections of P, (lines, nx), and of H0 for a residual; the last rank alone knows its `load`."""
        space, grid = self._jacobian.space, self._jacobian.grid
        if not grid.has_lines:
            return r, 0.0
        whole = np.append(grid.whole_of_team(r).ravel(), space.border_in_team(load))
        solution = self._invert(whole)
        lines = solution[:-1].reshape(grid.mesh.ny, grid.mesh.nx)
        return lines[grid.first : grid.last], float(solution[-1])

    def view(self, viewer):
        viewer.printfASCII("  LU with the border, redundant on every rank with lines\n")

    def _gather(self, stencil):
        """Sparse matrix of a stencil (offsets, local lines, nx) of all ranks with lines."""
        grid, offsets = self._jacobian.grid, self._jacobian.linearisation.offsets
        whole = np.stack([grid.whole_of_team(position) for position in stencil])
        return stencil_rows(offsets, whole, 0, grid.mesh.nodes)


class DenseInverse:
    """LU of A + B K with its border, A and B sparse and K dense.

    Where the pressure is `given`, (nodes,) bool, a row is its diagonal and solved at once. The LU is that
    of the other nodes alone: in contact at low speed these are a half, and take an eighth of the work.
    """

    def __init__(self, A, B, K, load_weight, given):
        self._given, self._free = given, np.flatnonzero(~given)
        self._of_given = A.diagonal()[given]
        self._A, self._B, self._K, self._load_weight = A[self._free], B[self._free], K, load_weight
        matrix = np.empty((len(self._free) + 1,) * 2, order="F")  # as LAPACK has it: no copy
        matrix[:-1, :-1] = self._B @ np.take(K, self._free, axis=1)  # in a sixth of K[:, free]'s time
        matrix[:-1, :-1] += self._A[:, self._free].toarray()
        matrix[:-1, -1] = self._B.sum(axis=1).ravel()
        matrix[-1, :-1], matrix[-1, -1] = load_weight, 0.0
        self._lu = lu_factor(matrix, overwrite_a=True, check_finite=False)

    def __call__(self, whole):
        """The solution, (nodes + 1,) as the right-hand side; H0 and the load come last."""
        solution, right = np.zeros_like(whole), np.append(whole[self._free], whole[-1])
        P = solution[:-1]
        P[self._given] = whole[:-1][self._given] / self._of_given
        if P.any():
            right[:-1] -= self._A @ P + self._B @ (self._K @ P)
            right[-1] -= self._load_weight * P.sum()
        found = lu_solve(self._lu, right, check_finite=False)
        P[self._free], solution[-1] = found[:-1], found[-1]
        return solution


def dense_influence(mesh, kernel):
    """Influence of every node on every node, (nodes, nodes)."""
    nearby = influence_coefficients(mesh, kernel)
    distance_y = np.abs(np.subtract.outer(np.arange(mesh.ny), np.arange(mesh.ny)))
    distance_x = np.abs(np.subtract.outer(np.arange(mesh.nx), np.arange(mesh.nx)))
    K = nearby[distance_y[:, None, :, None], distance_x[None, :, None, :]]
    return K.reshape(mesh.nodes, mesh.nodes)
