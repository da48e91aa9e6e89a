"""Transfers between a grid and the one of every other node."""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.discretization.rows import FLOW
from mgehl.discretization.status import CONTACT
from mgehl.grid.events import TRANSFERS, event
from mgehl.grid.ownership import coarsened
from mgehl.grid.regroup import Aligned, Regrouped


class Transfer:
    """Between a `coarse` and a `fine` Grid; arrays are the local lines of either. A rank reckons with the
    coarse lines beside its fine ones; where others work on those, they move."""

    def __init__(self, coarse, fine):
        self.coarse, self.fine = coarse, fine
        beside = coarsened(fine.starts)
        aligned = np.array_equal(beside, coarse.starts)
        self._ranks = Aligned(coarse) if aligned else Regrouped(coarse, beside)
        self._odd = fine.first % 2
        """The first local line that the coarse grid has, too."""

    @event(TRANSFERS)
    def inject(self, fine):
        """Values at the nodes that both grids share."""
        return self._ranks.collect(np.ascontiguousarray(fine[self._odd :: 2, ::2]))

    @event(TRANSFERS)
    def halfway(self, ghosted, offset):
        """Values of a ghosted fine array halfway to the coarse nodes at an `offset` (line, node), one of
        the two 0 and the other 1 or -1. At the ends of lines, where there is no such node, any value."""
        line, node = offset
        first, end = self._odd + HALO, self.fine.shape[0] + HALO
        nodes = np.arange(0, self.fine.mesh.nx, 2) + node
        beside = np.take(ghosted[first + line : end + line : 2], nodes, axis=1, mode="clip")
        return self._ranks.collect(beside)

    @event(TRANSFERS)
    def full_weighting(self, fine):
        """Weighted mean of the nine fine values around each inner coarse node, on a single line of three.
        Zero on the ends of lines; elsewhere a quarter (a half) of the adjoint of `bilinear`."""
        along_y = fine if self.fine.mesh.is_line else self._weighted_lines(self.fine.halo(fine))
        coarse = np.zeros((len(along_y), self.coarse.mesh.nx))
        coarse[:, 1:-1] = 0.5 * along_y[:, 2:-2:2] + 0.25 * (along_y[:, 1:-3:2] + along_y[:, 3:-1:2])
        return self._ranks.collect(coarse)

    def averaged(self, fine):
        """Weighted mean of the fine values around each coarse node; those of a line's ends as they are."""
        coarse, weight = self.inject(fine), self.full_weighting(np.ones(self.fine.shape))
        return np.divide(self.full_weighting(fine), weight, out=coarse, where=weight > 0.0)

    def _weighted_lines(self, ghosted):
        """Every other line with half of the lines beside it, of a ghosted fine array."""
        first, end = self._odd + HALO, self.fine.shape[0] + HALO
        beside = ghosted[first - 1 : end - 1 : 2] + ghosted[first + 1 : end + 1 : 2]
        return 0.5 * ghosted[first:end:2] + 0.25 * beside

    @event(TRANSFERS)
    def bilinear(self, coarse):
        """Bilinear interpolation to the fine grid."""
        ghosted, fine, between = self._begun(coarse)
        # Coarse lines that bracket the local odd ones; an odd first line needs the ghost before.
        lines = ghosted[HALO - self._odd :]
        between[:] = 0.5 * (lines[: len(between)] + lines[1 : len(between) + 1])
        fine[:, 1::2] = 0.5 * (fine[:, :-2:2] + fine[:, 2::2])
        return fine

    @event(TRANSFERS)
    def cubic(self, coarse):
        """Cubic interpolation of a pressure to the fine grid, bilinear beside nodes that have none."""
        ghosted, fine, between = self._begun(coarse)
        first, count = HALO - self._odd - 1, len(between)
        between[:] = _midway(*(ghosted[k : k + count] for k in range(first, first + 4)))
        columns = np.pad(fine[:, ::2], ((0, 0), (1, 1)))
        cells = self.coarse.mesh.nx - 1
        fine[:, 1::2] = _midway(*(columns[:, k : k + cells] for k in range(4)))
        return fine

    def _begun(self, coarse):
        """Coarse values ghosted, the fine array with those that both grids have, and its lines between."""
        ghosted, fine = self._ranks.spread(coarse), np.empty(self.fine.shape)
        fine[self._odd :: 2, ::2] = own(ghosted)
        return ghosted, fine, fine[1 - self._odd :: 2, ::2]


class PartitionedTransfer:
    """Full weighting of residuals and bilinear corrections, fluid and contact kept apart: their rows are
    different equations and their pressures jump. A contact row is -H/dX on every grid, so what is gathered
    shrinks with the ratio of the spacings (or the coarse correction would be twice too large). Rows and
    corrections of boundary and cavitated nodes are zero."""

    def __init__(self, transfer):
        self._transfer = transfer

    @event(TRANSFERS)
    def partition(self, coarse, fine):
        """Take the (status, rows) of both grids: rows of the film, and contact."""
        transfer = self._transfer
        self._fine_film, self._coarse_film = fine[1] == FLOW, coarse[1] == FLOW
        fine_contact, coarse_contact = fine[0] == CONTACT, coarse[0] == CONTACT
        self._film_share = self._fine_film
        self._some_touch = transfer.coarse.count(coarse_contact) > 0
        if not self._some_touch:
            return
        spread = transfer.bilinear(coarse_contact.astype(float))
        self._film_share = _inverse(1.0 - spread, where=self._fine_film)
        self._fine_contact, self._coarse_contact = fine_contact, coarse_contact
        gathered = transfer.full_weighting(fine_contact.astype(float))
        self._restrict_contact = 0.5 * _inverse(gathered, where=coarse_contact)
        self._contact_share = _inverse(spread, where=fine_contact)

    def bilinear(self, coarse):
        """A field that knows neither fluid nor contact, such as a deflection, on the fine grid."""
        return self._transfer.bilinear(coarse)

    @event(TRANSFERS)
    def restrict(self, fine):
        """Residual (lines, nx) of the fine grid to the coarse one."""
        transfer = self._transfer
        coarse = transfer.full_weighting(fine * self._fine_film) * self._coarse_film
        if self._some_touch:
            coarse += transfer.full_weighting(fine * self._fine_contact) * self._restrict_contact
        return coarse

    @event(TRANSFERS)
    def prolong(self, coarse):
        """Correction (lines, nx) of the coarse grid to the fine one."""
        transfer = self._transfer
        if not self._some_touch:
            fine = transfer.bilinear(coarse)
            fine *= self._film_share
            return fine
        contact = transfer.bilinear(coarse * self._coarse_contact) * self._contact_share
        return contact + transfer.bilinear(coarse * ~self._coarse_contact) * self._film_share


def _inverse(weight, where):
    """1/weight on a set of nodes, 0 elsewhere and where there is no weight."""
    return np.divide(1.0, weight, out=np.zeros_like(weight), where=where & (weight > 0.0))


def _midway(before, left, right, after):
    """Pressure in the middle of `left` and `right`, of four that follow each other."""
    linear = 0.5 * (left + right)
    cubic = linear + 0.125 * (linear - 0.5 * (before + after))
    has_pressure = np.minimum(np.minimum(before, left), np.minimum(right, after)) > 0.0
    return np.where(has_pressure & (cubic > 0.0), cubic, linear)
