"""What was solved and found: the object that runs, studies, pictures and users share."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from mgehl.config import Config
from mgehl.discretization.mesh import Mesh
from mgehl.model.contact import LoadedContact
from mgehl.model.wedge import WedgeBearing
from mgehl.output.fields import Fields, Reals
from mgehl.output.result import Result


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
