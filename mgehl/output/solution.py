"""What was solved and found: the object that runs, studies, pictures and users share."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from mgehl.config import Config
from mgehl.discretization.mesh import Mesh
from mgehl.grid.grid import Grid
from mgehl.model.contact import LoadedContact
from mgehl.model.wedge import WedgeBearing
from mgehl.output.result import Result

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


@dataclass(eq=False)  # arrays are neither the same nor not
class Solution:
    """A solved contact; `rows` is the history, a dictionary per cycle.

    Whole-grid fields live on rank 0 and are None on the others.
    """

    config: Config
    contact: LoadedContact | WedgeBearing
    mesh: Mesh
    fields: Fields | None
    rows: list[dict[str, float]]
    result: Result
    H0: float = 0.0
    """Constant part of the gap in units of H  [Liu eq. 48], less the closer the bodies; 0 for a wedge."""
    frames: Any = None
    """Of a run in time: what has its fields at some instants, on rank 0 (`frames.Frames`)."""

    @property
    def is_dry(self) -> bool:
        """Whether there is no fluid: the film is a gap."""
        return self.contact.is_at_rest

    @property
    def last(self) -> dict[str, float] | None:
        """The last row of a run in time, whose instant the fields are of; None of a steady state."""
        return self.rows[-1] if self.config.is_in_time and self.rows else None

    @property
    def motion(self) -> tuple[float, float]:
        """Direction in which the surfaces of a loaded contact move, of a run in time at its end: a unit
        vector along x and y; (0, 0) of those at rest."""
        sign = np.sign(self.last["speed_mm_s"]) if self.last else 1.0 - self.is_dry
        along = self.at_the_end.motion
        return sign * along[0], sign * along[1]

    @property
    def load_share(self) -> float:
        """Load of the fields over that of the contact: of a run in time that of its last instant."""
        return self.last.get("load_share", 1.0) if self.last else 1.0

    @property
    def path(self) -> tuple[float, float]:
        """Way in m along x and y that the mean surface of a run in time has gone at its end, with that of
        the run that it started from; (0, 0) of a steady state."""
        last = self.last or {}
        x, y = last.get("path_um", last.get("path_x_um", 0.0)), last.get("path_y_um", 0.0)
        return 1e-6 * x, 1e-6 * y

    @property
    def at_the_end(self) -> LoadedContact | WedgeBearing:
        """The contact under the load and with the motion of the fields; its Hertz contact is shown beside
        them."""
        if isinstance(self.contact, WedgeBearing):
            return self.contact
        there = self.contact.under(self.load_share)
        return there.turned(self.last["angle_deg"]) if self.last and "angle_deg" in self.last else there

    @property
    def film(self) -> Reals | None:
        """Film thickness or gap h in m, (ny, nx); on rank 0."""
        return None if self.fields is None else self.fields.H * self.contact.film_scale

    @property
    def pressure(self) -> Reals | None:
        """Total pressure P in Pa, (ny, nx); on rank 0."""
        return None if self.fields is None else self.fields.P * self.contact.pressure_scale

    @property
    def status(self) -> NDArray[np.int8] | None:
        """What each node is, (ny, nx): an index of `mgehl.discretization.status.NAMES`; on rank 0."""
        return None if self.fields is None else self.fields.status.copy()

    @property
    def heights(self) -> Reals | None:
        """Heights of rough bodies over smooth ones in m, a peak positive, (ny, nx); on rank 0."""
        known = None if self.fields is None else self.fields.heights
        return None if known is None else known.copy()

    @property
    def x(self) -> Reals:
        """Distance along x in m, (nx,)."""
        return self.mesh.X * self.contact.x_scale

    @property
    def y(self) -> Reals:
        """Distance along y in m, (ny,)."""
        return self.mesh.Y * self.contact.y_scale

    @property
    def summary(self) -> Result:
        """Films, verdicts, contact, formulas and work: what result.json holds."""
        return self.result

    def __str__(self) -> str:
        return str(self.result)


def on_every_rank(comm: MPI.Comm, solution: "Solution | None") -> "Solution | None":
    """The `Solution` that rank 0 has or has not, and what the others know of it (collective)."""
    told = comm.bcast(solution and replace(solution, fields=None))
    return solution or told
