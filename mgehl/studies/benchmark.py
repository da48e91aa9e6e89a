"""Fixed cases with their work, time, memory and time per part, to compare two commits on one machine.

A machine that others use is now faster, now slower. So a fixed FFT is timed beside every case, and times
are compared in units of it.
"""

import errno
import json
import resource
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import dacite
import numpy as np
from petsc4py import PETSc

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, one_line
from mgehl.grid.events import seconds_by_part
from mgehl.output.surroundings import versions
from mgehl.output.whole_file import write_whole
from mgehl.run import run
from mgehl.studies.study import PAPER, PAPERS_DOMAIN, merged, papers_grid


def _point(nodes, speed, start="film"):
    how = {"start": start, "error": False}
    return {"grid": papers_grid(nodes), "motion": {"speed": speed}, "solver": how}


_PILLAR = {"contact": {"kind": "wedge"}, "wedge": {"pillar": "square"}, "motion": {"speed": 1.0}}

CASES = {
    "film-257": _point(257, 0.5),
    "contact-257": _point(257, 5e-6, "contact"),
    "line-4097": {
        "contact": {"kind": "line"},
        "motion": {"speed": 0.1},
        "grid": {"nodes": 4097, "x": PAPERS_DOMAIN["x"]},
        "solver": {"error": False},
    },
    "wedge-257": _PILLAR | {"grid": {"nodes": 257}},
}
"""Name and configuration (nested tables) of every case, without bands, which would be timed with them;
every other key has its default."""

LARGE = {
    "film-513": _point(513, 0.03),
    "contact-513": _point(513, 5e-6, "contact"),
    "film-1025": _point(1025, 0.0075),
    "contact-1025": _point(1025, 5e-6, "contact"),
    "thick-1025": {
        "moes": {"M": 200.0, "L": 10.0},
        "lubricant": {"density_law": "constant"},
        "discretization": {"couette": "2B", "face_mobility": "arithmetic"},
        "grid": {"nodes": 1025, "x": [-4.5, 1.5], "y": [-3.0, 3.0]},
        "solver": {"error": False},
    },
}
"""Cases that take about a minute together."""

WARM_UP = (_point(65, 5e-6, "contact"), _PILLAR | {"grid": {"nodes": 65}})
"""Solved first and not timed, so that the first case does not pay for compiling and importing."""

REFERENCE_NODES, REFERENCE_SECONDS = 256, 0.3
"""Side of the plane whose FFT is the reference, and how long it is repeated before and after a case."""

NEGLIGIBLE = 0.01
"""Part of the whole below which a comparison says nothing."""


@dataclass(frozen=True)
class Clocks:
    """Seconds on the wall and of the processor, which a machine that is shared disturbs less."""

    wall: float
    cpu: float


def _since(start=(0.0, 0.0)):
    """Seconds on both clocks from `start` on, (2,)."""
    return np.array([time.perf_counter(), time.process_time()]) - start


@dataclass(frozen=True)
class Timing:
    """One case: work, and seconds (means over the ranks) of the whole and of its parts."""

    case: str
    converged: bool
    convolutions: float
    """In equivalents of one on the finest grid; 0 of a wedge."""
    steps: int
    """Newton steps on all grids, or a wedge's linear iterations."""
    time: Clocks
    reference: Clocks
    """Of one reference FFT beside this case."""
    memory_MiB: float
    """Largest memory of a rank since the program began: of a later case what it takes beyond."""
    parts: dict
    """Name of a part and its seconds of wall time; "other" is the rest."""

    @property
    def relative(self):
        """Times in units of the reference."""
        return Clocks(self.time.wall / self.reference.wall, self.time.cpu / self.reference.cpu)


@dataclass(frozen=True)
class Benchmark:
    """All timings of one commit on one machine: what the JSON file holds."""

    ranks: int
    versions: dict
    timings: list[Timing]


def measure(names, repeats, comm, tell=lambda timing: None):
    """Time the named cases on all ranks, the median of `repeats` times each; collective."""
    cases = CASES | LARGE
    PETSc.Log.begin()
    for tables in WARM_UP:
        _run(tables, comm)
    timings = []
    for name in names:
        runs = sorted(
            (_time(name, cases[name], comm) for _ in range(repeats)), key=lambda each: each.relative.cpu
        )
        timings.append(runs[(repeats - 1) // 2])
        tell(timings[-1])
    return Benchmark(comm.size, versions(), timings)


def _time(name, tables, comm):
    """Solve one case between two timings of the reference; collective."""
    reference, before = _reference(), seconds_by_part()
    comm.Barrier()
    started = _since()
    result = _run(tables, comm)
    elapsed = _since(started)
    parts = {part: total - before[part] for part, total in seconds_by_part().items()}
    parts["other"] = elapsed[0] - sum(parts.values())
    work = getattr(result, "work", None)
    return Timing(
        case=name,
        converged=result.converged,
        convolutions=work.convolutions if work else 0.0,
        steps=work.steps if work else result.linear_iterations,
        time=_mean(comm, elapsed),
        reference=_mean(comm, 0.5 * (reference + _reference())),
        memory_MiB=max(comm.allgather(_peak_memory())),
        parts={part: comm.allreduce(seconds) / comm.size for part, seconds in parts.items()},
    )


def _mean(comm, seconds):
    """Of all ranks (collective)."""
    return Clocks(*(float(each) for each in np.mean(comm.allgather(seconds), axis=0)))


def _run(tables, comm):
    """Solve and write everything, as a run does, into a directory that is removed."""
    with tempfile.TemporaryDirectory() as directory:
        return run(config_from_tables(merged(PAPER, tables)), Path(directory), comm)


def _reference():
    """Mean times of the reference FFT, now, (2,)."""
    plane = np.random.default_rng(1).random((REFERENCE_NODES, REFERENCE_NODES))
    started, repeats = _since(), 0
    while _since(started)[0] < REFERENCE_SECONDS:
        np.fft.irfft2(np.fft.rfft2(plane))
        repeats += 1
    return _since(started) / repeats


def _peak_memory():
    """MiB that this rank has held at the most."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)


def ratios(old, new):
    """{case: {quantity: new/old}} of the cases that both have; seconds in units of the reference. A part of
    less than `NEGLIGIBLE` in both is left out: its ratio is noise."""
    before = {timing.case: timing for timing in old.timings}
    return {now.case: _ratios(before[now.case], now) for now in new.timings if now.case in before}


def _ratios(old, new):
    wall, cpu = (getattr(new.relative, each) / getattr(old.relative, each) for each in ("wall", "cpu"))
    found = {"convolutions": new.convolutions / old.convolutions} if old.convolutions else {}
    found |= {"memory": new.memory_MiB / old.memory_MiB, "wall": wall, "cpu": cpu}
    for part in [part for part in new.parts if part in old.parts]:
        shares = [timing.parts[part] / timing.time.wall for timing in (old, new)]
        if max(shares) > NEGLIGIBLE and min(shares) > 0.0:
            found[part] = shares[1] / shares[0] * wall
    return found


def write_benchmark(path, benchmark):
    """Write a benchmark as JSON. Raises OutputError."""
    write_whole(path, json.dumps(asdict(benchmark), indent=2) + "\n")


def read_benchmark(path):
    """A benchmark that `write_benchmark` wrote. Raises OutputError."""
    try:
        if Path(path).exists() and not Path(path).is_file():  # a pipe or a device may have no end
            raise OSError(errno.EINVAL, "is no file")
        return dacite.from_dict(Benchmark, json.loads(Path(path).read_text()))
    except OSError as error:
        raise OutputError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, TypeError, dacite.DaciteError) as error:
        raise OutputError(f"{path}: no benchmark of mgehl: {one_line(error)}") from None
