"""Which equation each node has at the moment: the kinds of rows of the nonlinear residual.

    FLOW      net inflow/(dX dY) = 0   film, cavity that feeds it     [Liu eq. 35]
    PRESSURE  (P_given - P)/dX = 0     boundary, other cavity
    GAP       (h_b - H)/dX = 0         contact; h_b is the gap that its law keeps, mostly zero

Solids of a wedge, whose gap no pressure moves, have a given pressure (`solver.wedge`).
"""

import numpy as np

from mgehl.discretization.status import CONTACT, LUBRICATED

FLOW, PRESSURE, GAP = np.int8(0), np.int8(1), np.int8(2)


def rows_of(status, feeding=None):
    """The kind of row of every node, shape as `status`. The content of cavities that are `feeding` answers
    to the flow."""
    rows = np.full(status.shape, PRESSURE)
    rows[status == LUBRICATED] = FLOW
    if feeding is not None:
        rows[feeding] = FLOW
    rows[status == CONTACT] = GAP
    return rows
