"""What the linear solver remembers on a rough surface, as a part of what is kept of a solve."""

from mgehl.multigrid.memory import Corrections
from mgehl.solver.record import Kept, Record


class Remembered(Kept):
    """The memory of a `MultigridSolver` as it is when it is asked: nothing is copied before. It is kept
    whole, deflections, too: what is left out changes the digits of all that follows."""

    def __init__(self, multigrid):
        self._multigrid, self._memory, self._space = multigrid, multigrid.memory, multigrid.space

    def record(self):
        """The `Record` of it; empty before the first linear system (collective)."""
        known = self._memory.known
        if known is None:
            return Record()
        P, H0 = self._space.parts(known.values)
        flow, load = self._space.parts(known.causes)
        H = known.deflections.reshape(P.shape)
        way = self._multigrid.way
        return Record.of(P=P, H0=H0, deflection=H, residual=flow, load_residual=load, way=way)

    def take_back(self, record):
        """Remember what a `record` has, and nothing else."""
        values, arrays, stack = record.values, record.arrays, self._space.stack
        H = arrays["deflection"]
        self._multigrid.way = values["way"]
        self._memory.known = Corrections(
            stack(arrays["P"], values["H0"]),
            H.reshape(len(H), -1),
            stack(arrays["residual"], values["load_residual"]),
        )
