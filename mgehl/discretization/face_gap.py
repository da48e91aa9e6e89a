"""A gap that is given between the nodes, too: what it carries and lets through is exact, edges and all.

Between two nodes a distance d apart q = c h - (rho/(eta lambda)) h^3 dP/dx is the same everywhere, so

    q = c `carried` - (rho/(eta lambda)) `cubed` (P_E - P_W)/d        [derived]
    cubed = d / int h^-3 dx,  carried = cubed int h^-2 dx / d

The oil is differenced as elsewhere, in a gap of 1.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class FaceGap:
    """What takes the place of H and H^3 at the faces along an axis; arrays of its faces."""

    carried: np.ndarray
    cubed: np.ndarray

    def of_lines(self, axis, lines):
        """That of the faces of some `lines` of nodes (a slice)."""
        return FaceGap(axis.of_lines(self.carried, lines), axis.of_lines(self.cubed, lines))
