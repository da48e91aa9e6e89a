"""What a solution has at each node."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mgehl.grid.grid import Grid

Reals = NDArray[np.float64]


@dataclass
class Fields:
    """Fields, dimensionless but for heights: (ny, nx) of the whole grid, or (lines, nx) of one rank."""

    P: Reals
    H: Reals
    status: NDArray[np.int8]
    p: Reals | None = None
    """The fluid's own pressure: P but under contact; None where it was not kept."""
    filling: Reals | None = None
    """The part of the gap above the layers that holds fluid: 1 but in cavities; None as of `p`."""
    heights: Reals | None = None
    """Heights of the bodies in m, a peak positive; None of smooth ones, and in older results."""
    shear: Reals | None = None
    """Shear stress by sliding in Pa, of film and solids; None where the surfaces do not slide."""
    flash_1: Reals | None = None
    """Rise of the surface of body 1 in K by friction; None where nothing is known of the bodies."""
    flash_2: Reals | None = None

    @property
    def fluid_pressure(self) -> Reals:
        """That of the fluid; `P` where it was not kept."""
        return self.P if self.p is None else self.p

    @property
    def full_part(self) -> Reals:
        """How full of oil the gap is; 1 in older results, whose cavities carry all of it."""
        return np.ones_like(self.H) if self.filling is None else self.filling

    @property
    def named(self) -> dict[str, NDArray[Any]]:
        """All that there are, by name, in their order."""
        return {name: each for name, each in vars(self).items() if each is not None}

    def gathered(self, grid: Grid) -> "Fields | None":
        """The whole grid's on rank 0, None elsewhere (collective)."""
        whole = {name: grid.gather(local) for name, local in self.named.items()}
        return None if whole["P"] is None else Fields(**whole)
