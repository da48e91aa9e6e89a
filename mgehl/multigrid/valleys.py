"""The smoothers where film and contact change from node to node, as on rough surfaces."""

from math import inf

import numpy as np

from mgehl.discretization.kernels import deflect_nearby
from mgehl.discretization.rows import PRESSURE
from mgehl.grid.events import LINES, event
from mgehl.multigrid.crossed_lines import LinesBothWays
from mgehl.multigrid.nearby import NearbySolve

DRIVEN = 30.0
"""Mobility/dX over a node's own influence from which on it is relaxed along Y, too: elsewhere it is the gap
that moves, along X alone. With 5 and 150 about the same work."""

PATIENCE, OF_NODES = 15, 26_000
"""Relaxations of one system by lines, after which nearby nodes are solved at once. An LU of so many nodes
costs as much as so many relaxations, and n^1.5 on others: at most twice what was needed is paid."""

MOST_AT_ONCE = 150
"""Relaxations of one linear system with nearby nodes at once; then it is finished by lines, and so are all
later ones: in soft bodies what a valley couples to is not near. With 50 two of 120 balls without layers are
lost, close to their answers."""

ZONE = 1.25
"""How far nearby nodes are solved at once, over the reach of the dry contact. Beyond it films are thick.
With 1 peaks that touch outside take six times the work; all nodes take more time."""

LARGEST = 600_000
"""Most nodes of that zone: they take some 18 kB each, with what GMRES remembers."""

BY_LINES, AT_ONCE, BY_LINES_AGAIN = "by lines", "nearby nodes at once", "by lines again"
"""Ways of a `ValleySmoother`."""


class RoughLineSmoother(LinesBothWays):
    """Lines along X, and then along Y where the pressure drives the flow by far, as in valleys.

    c = c_X + omega Q Y^-1 D (r - J c_X), c_X = omega Q X^-1 r: J with the deflection of near nodes alone, D
    the nodes that are driven. Oil leaves a valley in any direction. The product of lines both ways
    (`CrossedLineSmoother`) leaves a residual as large as a driven node's mobility beside a stiff one. So a
    stiff node hands nothing over to a driven one beside its line.
    """

    words = "lines along x, in valleys along y, too"

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        grid = jacobian.grid
        self._correction, self._deflection = np.zeros(grid.shape), np.zeros(grid.shape)
        self._ghosted_c = np.zeros(grid.ghosted_shape)

    def partition(self, rows):
        """As of a `LineSmoother`."""
        super().partition(rows)
        jacobian = self._jacobian
        least = DRIVEN * self._K00 * jacobian.grid.mesh.dX
        self._driven = (jacobian.linearisation.eps > least) & (rows != PRESSURE)
        self._some_are_driven = jacobian.grid.sum_of_team(np.count_nonzero(self._driven)) > 0

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation, along Y where they are needed."""
        if self._some_are_driven:
            super().factor()
        else:
            self._factor_x_lines()

    @event(LINES)
    def relax(self, r):
        """As of a `LineSmoother`."""
        if not self._some_are_driven:
            self._bands.solve(r, self._w)
            return self._distributed(self._omega, along_y=False)
        rest, correction = r.copy(), self._correction  # the product overwrites `r`
        self._bands.solve(r, self._w)
        correction[:] = self._distributed(self._omega, along_y=False)
        rest -= self._near_product(correction)
        rest *= self._driven
        if self._has_lines:
            self._y_bands.solve(rest, self._w)
        correction += self._distributed(self._omega, along_x=False)
        return correction

    def _near_product(self, c):
        """J c, (lines, nx), but for the deflection by nodes that are not around a node."""
        self._jacobian.grid.halo(self._jacobian.pressures(c), out=self._ghosted_c)
        deflect_nearby(self._near[:2, :2], self._ghosted_c, self._deflection)
        return self._jacobian.product(c, self._deflection, 0.0)

    def view(self, viewer):
        viewer.printfASCII(f"  distributive Jacobi along x-lines, omega {self._omega}\n")
        viewer.printfASCII("    and then along y-lines where the pressure drives the flow by far\n")


class ValleySmoother(RoughLineSmoother):
    """The same until a linear system has taken `PATIENCE` relaxations, of more nodes more; from then on a
    `NearbySolve` around the contact and lines beyond, in the rest of that system and in all later ones.

    c = c_L + Q T^-1 (r - J c_L): c_L by lines for r beyond the zone, J with the deflection of near nodes
    alone. Zones above `LARGEST` keep the lines, and so do systems after `MOST_AT_ONCE`.
    """

    words = f"{RoughLineSmoother.words}, nearby nodes at once where that takes long"

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        grid = jacobian.grid
        self._zone = grid.X**2 + grid.Y**2 <= (ZONE * jacobian.contact.reach) ** 2
        self._nearby = NearbySolve(jacobian, self._near, self._share, self._zone)
        nodes = grid.count(self._zone)
        self._may_be_at_once = nodes <= LARGEST
        self._patience = max(round(PATIENCE * (nodes / OF_NODES) ** 0.5), 1)
        self.way, self._taken = BY_LINES, 0  # the present way, and relaxations of this system by it

    def free(self):
        """Free the PETSc objects and the MPI datatypes."""
        super().free()
        self._nearby.free()

    def partition(self, rows):
        """As of a `LineSmoother`."""
        super().partition(rows)
        self._movable = self._jacobian.grid.halo(rows != PRESSURE)

    def factor(self):
        """Factor what the next relaxation needs."""
        super().factor()
        self._begin()

    def _begin(self):
        """Begin to count relaxations by the present way, lines being factored."""
        self._taken = 0
        if self.way == AT_ONCE:
            self._nearby.factor(self._distributive, self._movable)

    def relax(self, r):
        """As of a `LineSmoother`."""
        if self._taken == self._most:
            if self.way == AT_ONCE:
                self._nearby.free()  # for good
            self.way = AT_ONCE if self.way == BY_LINES else BY_LINES_AGAIN
            self._begin()
        self._taken += 1
        return self._relax_at_once(r) if self.way == AT_ONCE else super().relax(r)

    def _relax_at_once(self, r):
        """Lines for what is beyond the zone, then the zone for what they leave."""
        rest = r.copy()  # lines overwrite `r`, and the zone `_w`
        r[self._zone] = 0.0
        correction = super().relax(r).copy()
        rest -= self._near_product(correction)
        self._nearby.solve(rest, self._w)
        correction += self._distributed(1.0)
        return correction

    @property
    def _most(self):
        """Relaxations of a system after which another way is taken."""
        if self.way == AT_ONCE:
            return MOST_AT_ONCE
        return self._patience if self.way == BY_LINES and self._may_be_at_once else inf

    def view(self, viewer):
        super().view(viewer)
        if self.way == AT_ONCE:
            self._nearby.view(viewer)
