"""Where the time goes: PETSc's own log events around the parts of a run, shown by -log_view.

An event decorates the functions that do one thing. Those of `PARTS` do not nest, so their times add up; the
rest of a linear solve is the Krylov method's own.
"""

from contextlib import contextmanager

from petsc4py import PETSc

event = PETSc.Log.EventDecorator
"""@event(NAME): log the calls of a function. Costs half a microsecond a call."""

SETUP, DEFLECTION, LINES, ASSEMBLY = "mgehlSetUp", "mgehlDeflection", "mgehlLines", "mgehlAssembly"
TRANSFERS, COARSE, NEARBY = "mgehlTransfers", "mgehlCoarse", "mgehlNearby"
FILES, LINEAR = "mgehlFiles", "mgehlLinear"

PARTS = {
    "set-up": SETUP,
    "deflection": DEFLECTION,
    "line solves": LINES,
    "nearby nodes": NEARBY,
    "assembly": ASSEMBLY,
    "transfers": TRANSFERS,
    "coarse solve": COARSE,
    "I/O": FILES,
}
"""Parts that do not overlap, and their events; waiting for a file of one rank is I/O, too."""

_MAIN = 0
_linear_stage = PETSc.Log.Stage("mgehl linear solves")


@contextmanager
def linear_solve():
    """Log what is done inside as a linear solve, in a log stage of its own."""
    with _linear_stage, PETSc.Log.Event(LINEAR):
        yield


def seconds_by_part():
    """Seconds that this rank has spent in each of `PARTS`, and as "Krylov" in the rest of linear solves."""
    inside = {part: _seconds(name, _linear_stage.id) for part, name in PARTS.items()}
    krylov = _seconds(LINEAR, _linear_stage.id) - sum(inside.values())
    return {part: inside[part] + _seconds(name, _MAIN) for part, name in PARTS.items()} | {"Krylov": krylov}


def _seconds(name, stage):
    return PETSc.Log.Event(name).getPerfInfo(stage)["time"]
