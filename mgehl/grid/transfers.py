"""Transfers between a grid and the one of every other node."""

import numpy as np

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED


class Transfer:
    """Between a `coarse` and a `fine` Grid; arrays are the local lines of either."""

    def __init__(self, coarse, fine):
        self.coarse, self.fine = coarse, fine
        self._lines = 2 * np.arange(coarse.first, coarse.last) - fine.first
        self._odd = fine.first % 2

    def inject(self, fine):
        """Values at the nodes that both grids share."""
        return np.ascontiguousarray(fine[self._lines, ::2])

    def full_weighting(self, fine):
        """Weighted mean of nine fine values around each inner coarse node, zero on the ends of
        lines; a quarter of the adjoint of `bilinear` there."""
        ghosted = self.fine.halo(fine)
        first = self._lines[0]
        last = self._lines[-1]
        along_y = 0.5 * ghosted[first + 1 : last + 2 : 2]
        along_y += 0.25 * ghosted[first : last + 1 : 2]
        along_y += 0.25 * ghosted[first + 2 : last + 3 : 2]
        coarse = np.zeros(self.coarse.shape)
        coarse[:, 1:-1] = 0.5 * along_y[:, 2:-2:2] + 0.25 * (along_y[:, 1:-3:2] + along_y[:, 3:-1:2])
        return coarse

    def bilinear(self, coarse):
        """Bilinear interpolation to the fine grid."""
        ghosted = self.coarse.halo(coarse)
        # Coarse lines that bracket the local odd ones; an odd first line needs the ghost before.
        lines = ghosted if self._odd else ghosted[1:]
        fine = np.empty(self.fine.shape)
        even, odd = self._odd, 1 - self._odd
        fine[even::2, ::2] = ghosted[1:-1]
        between = fine[odd::2, ::2]
        between[:] = 0.5 * (lines[: len(between)] + lines[1 : len(between) + 1])
        fine[:, 1::2] = 0.5 * (fine[:, :-2:2] + fine[:, 2::2])
        return fine


class ResidualTransfer:
    """Full weighting of residuals and bilinear corrections that respect the partition.

    Lubricated and contact rows are different equations and are weighted apart; a contact row is
    normalised by the weight of the contact nodes it gathers. Rows and corrections of boundary and
    cavitated nodes are zero.
    """

    def __init__(self, transfer):
        self._transfer = transfer

    def partition(self, coarse_status, fine_status):
        """Take the partitions of both grids."""
        self._fine_lubricated = fine_status == LUBRICATED
        self._fine_contact = fine_status == CONTACT
        self._fine_given = (fine_status == BOUNDARY) | (fine_status == CAVITATED)
        self._coarse_lubricated = coarse_status == LUBRICATED
        self._any_contact = self._transfer.coarse.count(self._fine_contact) > 0
        if self._any_contact:
            weight = self._transfer.full_weighting(self._fine_contact.astype(float))
            is_contact = (coarse_status == CONTACT) & (weight > 0.0)
            self._coarse_contact_share = np.divide(1.0, weight, out=np.zeros_like(weight), where=is_contact)

    def restrict(self, fine):
        """Residual (lines, nx) of the fine grid to the coarse one."""
        coarse = self._transfer.full_weighting(fine * self._fine_lubricated) * self._coarse_lubricated
        if self._any_contact:
            gathered = self._transfer.full_weighting(fine * self._fine_contact)
            coarse += gathered * self._coarse_contact_share
        return coarse

    def prolong(self, coarse):
        """Correction (lines, nx) of the coarse grid to the fine one."""
        fine = self._transfer.bilinear(coarse)
        fine[self._fine_given] = 0.0
        return fine
