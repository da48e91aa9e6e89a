"""Direct solve of the bordered Jacobian on the coarsest grid, on the last rank, which has the border."""

import warnings
from functools import cache, partial

import numpy as np
from scipy.linalg import LinAlgWarning, lu_factor, lu_solve

from mgehl.discretization.compiled import compiled
from mgehl.discretization.influence import influence_coefficients
from mgehl.grid.events import COARSE, event
from mgehl.multigrid.stencil_matrix import stencil_rows

OF_A_LINE, OF_A_PLANE = (np.float64,), (np.float32, np.float64)
"""Precisions of the factors, in turn. Those of a line between rough bodies are hardly ever good enough in
single: 3 of 80 rollers were not found."""

GIVEN_BACK = 1e-3
"""How far a known solution may be off that single precision gives back; else it is double's turn, which
takes more than twice the time, half of a step's on 65 nodes."""


class CoarseSolve:
    """LU of J with its border; ranks without lines have nothing to do. While the
    last rank factors, the first one factors what stands at cliffs (`cliffs`)."""

    def __init__(self, jacobian):
        self._jacobian = jacobian
        if jacobian.space.owns_border:
            self._K = dense_influence(jacobian.grid.mesh, jacobian.contact.kernel)
            # New memory would take a third of the time.
            self._room = cache(partial(np.empty, (jacobian.grid.mesh.nodes + 1) ** 2))
            self._precisions = OF_A_LINE if jacobian.grid.mesh.is_line else OF_A_PLANE

    @event(COARSE)
    def gather(self):
        """Tell the last rank what the present linearisation is."""
        jacobian = self._jacobian
        if jacobian.grid.has_lines:
            lin = jacobian.linearisation
            self._A, self._B = (self._gathered(stencil) for stencil in (lin.by_unknown, lin.B))
            self._given = jacobian.grid.to_last(jacobian.given)
            contents = np.zeros(jacobian.grid.shape) if jacobian.contents is None else jacobian.contents
            self._moves = jacobian.grid.to_last(1.0 - contents)

    @event(COARSE)
    def factor(self):
        """Form the matrix on the last rank and factor it; the others return at once."""
        if not self._jacobian.space.owns_border:
            return
        with warnings.catch_warnings():
            # Of a singular matrix: the iteration that made it ends by itself.
            warnings.simplefilter("ignore", LinAlgWarning)
            masks, jacobian = (self._given.ravel(), self._moves.ravel()), self._jacobian
            load = jacobian.load_weight, jacobian.load_scale * jacobian.resistance
            self._invert = DenseInverse(
                self._A, self._B, self._K, load, *masks, self._room, self._precisions
            )

    @event(COARSE)
    def solve(self, r, load):
        """Corrections of P, (lines, nx), and of H0 for a residual. The last rank alone knows the residual's
        `load`, and alone is told the correction of H0."""
        grid, dP, dH0 = self._jacobian.grid, None, 0.0
        if not grid.has_lines:
            return r, dH0
        whole = grid.to_last(r)
        if self._jacobian.space.owns_border:
            dP, (dH0,) = np.split(self._invert(np.append(whole, load)), [-1])
        return grid.from_last(dP), dH0

    def view(self, viewer):
        viewer.printfASCII("  LU with the border, on the last rank\n")

    def _gathered(self, stencil):
        """Sparse matrix of a stencil (offsets, local lines, nx) of the team; None but on the last rank."""
        grid, offsets = self._jacobian.grid, self._jacobian.linearisation.offsets
        whole = [grid.to_last(position) for position in stencil]
        return None if whole[0] is None else stencil_rows(offsets, np.stack(whole), 0, grid.mesh.nodes)


class DenseInverse:
    """LU of A + B K with its border, A and B sparse and K dense.

    It is that of the nodes whose pressure is not `given`, (nodes,) bool: half of them in contact at low
    speed. The row of the `load` has one weight for P, and takes another times H0 away. The inverse stands
    in `room(precision)`, (nodes + 1)^2 numbers. Factors in single precision are refined once by what they
    leave in doubles: without that domains that cut the contact are lost.
    """

    def __init__(self, A, B, K, load, given, moves, room, precisions=OF_A_PLANE):
        self._given, self._free = given, np.flatnonzero(~given)
        self._of_given, self._moves = A.diagonal()[given], np.where(given, 1.0, moves)
        self._A, self._B, self._K, self._load = A[self._free], B[self._free], K, load
        for self._precision in precisions:
            self._lu = self._factored(room(self._precision))
            if self._precision is precisions[-1] or self._gives_back():
                break

    def _factored(self, room):
        """Factors in the precision of a `room`."""
        size = len(self._free) + 1
        matrix = room[: size * size].reshape(size, size)
        stencils = [(each.indptr, each.indices, each.data) for each in (self._A, self._B)]
        fill_bordered(matrix, self._free, self._moves, *stencils, self._K, *self._load)
        # LAPACK counts along columns: to it this is the transpose, which it factors in its place.
        return lu_factor(matrix.T, overwrite_a=True, check_finite=False)

    def _gives_back(self):
        """Whether a known solution, 1 at each free node, comes back."""
        known = np.append(np.where(self._given, 0.0, 1.0), 1.0)
        found = self._solved(-self._missing(np.zeros_like(known), known))
        return np.abs(found - 1.0).max() <= GIVEN_BACK

    def _solved(self, right):
        return lu_solve(self._lu, right.astype(self._precision), trans=1, check_finite=False)

    def __call__(self, whole):
        """The solution, (nodes + 1,) as the right-hand side; H0 and the load come last."""
        solution = np.zeros_like(whole)
        solution[:-1][self._given] = whole[:-1][self._given] / self._of_given
        for _ in range(2 if self._precision is np.float32 else 1):
            found = self._solved(self._missing(whole, solution))
            solution[self._free] += found[:-1]
            solution[-1] += found[-1]
        return solution

    def _missing(self, whole, solution):
        """What a solution leaves of the right-hand side: of the free nodes, and of the load."""
        P, H0 = solution[:-1], solution[-1]
        moving = self._moves * P
        missing = whole[self._free] - self._A @ P - self._B @ (self._K @ moving + H0)
        weight, resistance = self._load
        return np.append(missing, whole[-1] - weight * moving.sum() + resistance * H0)


@compiled()
def fill_bordered(matrix, free, moves, A, B, K, load_weight, resistance):
    """Fill the `matrix` of A + B K for the `free` nodes, with its border. A and B have their rows: (where
    each begins, columns, values). `moves` is 1, and 0 where an unknown is no pressure."""
    count, place = len(free), np.full(len(K), -1)
    place[free] = np.arange(count)
    of_all = np.empty(len(K))
    for i in range(count):
        of_all[:], row = 0.0, matrix[i]
        row[count] = 0.0
        for entry in range(B[0][i], B[0][i + 1]):
            of_all += B[2][entry] * K[B[1][entry]]
            row[count] += B[2][entry]
        for j in range(count):
            row[j] = of_all[free[j]] * moves[free[j]]
        for entry in range(A[0][i], A[0][i + 1]):
            if place[A[1][entry]] >= 0:
                row[place[A[1][entry]]] += A[2][entry]
    matrix[count, :count] = load_weight * moves[free]
    matrix[count, count] = -resistance


def dense_influence(mesh, kernel):
    """Influence of every node on every node, (nodes, nodes)."""
    nearby = influence_coefficients(mesh, kernel)
    distance_y = np.abs(np.subtract.outer(np.arange(mesh.ny), np.arange(mesh.ny)))
    distance_x = np.abs(np.subtract.outer(np.arange(mesh.nx), np.arange(mesh.nx)))
    K = nearby[distance_y[:, None, :, None], distance_x[None, :, None, :]]
    return K.reshape(mesh.nodes, mesh.nodes)
