"""The distributive line smoother with lines along both axes."""

from mgehl.discretization.axes import own
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import STIFF, influence_of_columns
from mgehl.discretization.rows import PRESSURE
from mgehl.grid.events import LINES, event
from mgehl.multigrid.cliffs import CliffZone, cliffs
from mgehl.multigrid.smoother import LineSmoother, influence_nearby
from mgehl.multigrid.y_bands import YBands

AT_CLIFFS = 1.2
"""Times the residual that is solved for around cliffs, on grids that hold the film: damped as lines are, by
omega = 0.8, waves along a spike would be the last that are left. With 1 thick films take up to a quarter
more work, with 1.3 an eighth."""


class LinesBothWays(LineSmoother):
    """A smoother that has the bands of lines along both axes."""

    words = "lines along x and y"

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        grid = jacobian.grid
        kappa = influence_of_columns(influence_nearby(jacobian, turned=True), self._share)
        self._has_lines = grid.has_lines
        if self._has_lines:
            self._y_bands = YBands(grid, kappa, self._share)

    def free(self):
        """Free the MPI datatypes."""
        self.forget()

    def forget(self):
        """Free the memory of the factors."""
        super().forget()
        if self._has_lines:
            self._y_bands.forget()

    def factor(self):
        """Factor the bands of the present linearisation."""
        if self._has_lines:
            self._diagonal = self._factor_x_lines()
            jacobian = self._jacobian
            nodes = own(self._distributive), jacobian.given
            self._y_bands.factor(jacobian.linearisation, *nodes, jacobian.contents)


class CrossedLineSmoother(LinesBothWays):
    """The same with lines along both axes: c = omega Q (X D^-1 Y)^-1 r, but for what couples both J Q.

    X and Y are the parts of J Q along the x-lines and along the y-lines, D their diagonal. Lines along one
    axis leave waves across it, the more the finer the grid. The next relaxation goes along Y first.
    """

    @event(LINES)
    def factor(self):
        """As of `LinesBothWays`; the next relaxation begins along X."""
        self._along_y_first = False
        super().factor()

    def _solve_lines(self, r):
        """Solve along one axis, then along the other; the next time in the other order."""
        if not self._has_lines:
            return
        if self._along_y_first:
            self._y_bands.solve(r, self._w)
            self._w *= self._diagonal
            self._bands.solve(self._w, self._w)
        else:
            self._bands.solve(r, self._w)
            self._w *= self._diagonal
            self._y_bands.solve(self._w, self._w)
        self._along_y_first = not self._along_y_first

    def view(self, viewer):
        words = f"omega {self._omega}, {REACH} neighbours"
        viewer.printfASCII(f"  distributive Jacobi along x- and y-lines, {words}\n")


class CliffSmoother(CrossedLineSmoother):
    """The same, and then a direct solve of the nodes around cliffs of the mobility (`CliffZone`), which
    thick films have at their pressure spike."""

    words = f"{LinesBothWays.words}, nodes at cliffs of the mobility at once"
    sees_cliffs = True

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        self._zone = CliffZone(jacobian.grid, self._near, self._share)
        self._weight = AT_CLIFFS if jacobian.holds_film else 1.0

    def partition(self, rows):
        """As of a `LineSmoother`; find the cliffs and gather what is around them."""
        super().partition(rows)
        if self._has_lines:
            grid, linearisation = self._jacobian.grid, self._jacobian.linearisation
            free = rows != PRESSURE
            found = cliffs(grid.halo(linearisation.eps), STIFF * self._K00 * grid.mesh.dX) & free
            self._zone.gather(found, linearisation, own(self._distributive), free)

    def forget(self):
        """Free the memory of the factors."""
        super().forget()
        self._zone.forget()

    def factor_alone(self):
        """Factor the zone, on the first rank."""
        self._zone.factor()

    def _solve_lines(self, r):
        super()._solve_lines(r)
        if self._has_lines:
            self._zone.solve(r, self._w, self._weight)

    def view(self, viewer):
        super().view(viewer)
        viewer.printfASCII(
            f"    and nodes around cliffs at once, for {self._weight:g} times the residual\n"
        )
