"""Direct solve of the bordered Jacobian on the coarsest grid, redundantly on every rank that has lines."""

import warnings

import numpy as np
from scipy.linalg import LinAlgWarning, lu_factor, lu_solve

from mgehl.discretization.influence import influence_coefficients
from mgehl.grid.events import COARSE, event
from mgehl.multigrid.assembled import stencil_rows


class CoarseSolve:
    """Dense LU of J with its border; ranks without lines have nothing to do."""

    def __init__(self, jacobian):
        self._jacobian = jacobian
        if jacobian.grid.has_lines and not jacobian.rigid:
            self._K = dense_influence(jacobian.grid.mesh, jacobian.contact.kernel)

    @event(COARSE)
    def factor(self):
        """Gather the stencils, form the dense matrix and factor it."""
        if self._jacobian.grid.has_lines:
            self._factor()

    def _factor(self):
        jacobian = self._jacobian
        nodes = jacobian.grid.mesh.nodes
        matrix = np.zeros((nodes + 1, nodes + 1))
        matrix[:nodes, :nodes] = self._gather(jacobian.linearisation.A).toarray()
        if jacobian.rigid:
            matrix[nodes, nodes] = 1.0
        else:
            B = self._gather(jacobian.linearisation.B)
            matrix[:nodes, :nodes] += B @ self._K
            matrix[:nodes, nodes] = B @ np.ones(nodes)
            matrix[nodes, :nodes] = jacobian.load_weight
        with warnings.catch_warnings():
            # Of a singular matrix: the iteration that made it ends by itself.
            warnings.simplefilter("ignore", LinAlgWarning)
            self._factors = lu_factor(matrix, overwrite_a=True, check_finite=False)

    @event(COARSE)
    def solve(self, r, load):
        """Corrections of P, (lines, nx), and of H0 for a residual; the last rank alone knows its `load`."""
        space, grid = self._jacobian.space, self._jacobian.grid
        if not grid.has_lines:
            return r, 0.0
        whole = np.append(grid.whole_of_team(r).ravel(), space.border_in_team(load))
        solution = lu_solve(self._factors, whole, check_finite=False)
        lines = solution[:-1].reshape(grid.mesh.ny, grid.mesh.nx)
        return lines[grid.first : grid.last], float(solution[-1])

    def view(self, viewer):
        viewer.printfASCII("  dense LU with the border, redundant on every rank with lines\n")

    def _gather(self, stencil):
        """Sparse matrix of a stencil (offsets, local lines, nx) of all ranks with lines."""
        grid, offsets = self._jacobian.grid, self._jacobian.linearisation.offsets
        whole = np.stack([grid.whole_of_team(position) for position in stencil])
        return stencil_rows(offsets, whole, 0, grid.mesh.nodes)


def dense_influence(mesh, kernel):
    """Influence of every node on every node, (nodes, nodes)."""
    nearby = influence_coefficients(mesh, kernel)
    distance_y = np.abs(np.subtract.outer(np.arange(mesh.ny), np.arange(mesh.ny)))
    distance_x = np.abs(np.subtract.outer(np.arange(mesh.nx), np.arange(mesh.nx)))
    K = nearby[distance_y[:, None, :, None], distance_x[None, :, None, :]]
    return K.reshape(mesh.nodes, mesh.nodes)
