"""Where the film ends halfway between two nodes of a coarse grid.

A cavity may begin at a node that the coarse grid does not have. Its film would be half a cell too long and
too soft, and correct up to twice too much. Over half the distance the same pressure drives twice the flow:
5 % less work on 513 nodes. Not in thin films between peaks.
"""

import numpy as np

from mgehl.discretization.rows import FLOW, PRESSURE
from mgehl.discretization.status import CONTACT


def end_halfway(linearisation, coarse_rows, transfer, rows, status):
    """In place: a coarse film's flow to a cavity that begins halfway to the next node counts twice.

    `linearisation` and `coarse_rows` (lines, nx) of the coarse grid, `rows` and `status` of the fine one,
    between which is the `transfer`. Contact is no cavity: it closes its faces.
    """
    A, film = linearisation.A, coarse_rows == FLOW
    cavity = transfer.fine.halo((rows == PRESSURE) & (status != CONTACT))
    for beside, offset in zip(A, linearisation.offsets, strict=True):
        if np.abs(offset).sum() == 1:
            ends = film & transfer.halfway(cavity, offset)
            A[0][ends] -= beside[ends]
