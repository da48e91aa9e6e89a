"""What a run will meet and what it will take, as far as that can be told before it starts.

Time is that of so many convolutions: one is timed on this machine, and what a run takes for each was
measured (`mgehl bench`; two shared cores). None of it is more than an estimate.
"""

import time
from dataclasses import dataclass, replace
from math import log

import numpy as np
from mpi4py import MPI

from mgehl.config import COARSEST_NODES, SECTIONS
from mgehl.discretization.mesh import Mesh
from mgehl.grid.convolution import Deflection
from mgehl.grid.grid import single_grid
from mgehl.model.deformation import HalfPlane, HalfSpace
from mgehl.multigrid.cycle import LARGE_GRID
from mgehl.output.surroundings import cores_allowed

RESOLVED_CELLS = 4.0
"""Cells in the inlet from which on the film does not change with the grid."""

FILM_TOUCHES, CONTACT_OPENS = 1.5, 0.75
"""Cells in the inlet below which a film start has had contact, and above which a contact start has lost
full contact: `study onset` on 129 to 513 nodes, arithmetic mean."""

LARGEST_TIMED = 513
"""Nodes of the largest grid whose convolution is timed: half a second, most of it for the FFT's plan."""

LARGEST_NODES = SECTIONS["grid"].__dataclass_fields__["nodes"].metadata["high"]
"""That a grid may have along each side."""

MiB = 2**20


@dataclass(frozen=True)
class Work:
    """What a kind of run took where it was measured."""

    convolutions: tuple[float, float]
    """Fewest and most, in equivalents of one on the finest grid."""
    times_convolution: float
    """Its whole time in units of its convolutions' time."""
    bytes_per_node: float
    measured: str


WORK = {
    "film": Work((90.0, 240.0), 3.3, 1300.0, "full films on 65 to 4097 nodes took 90 to 233"),
    "contact": Work((25.0, 250.0), 20.0, 1800.0, "full contact on 65 to 2049 nodes took 24 to 254"),
    "line": Work((60.0, 200.0), 10.0, 2500.0, "line contacts on 1025 to 16385 nodes took 60 to 180"),
    "mean": Work(
        (1000.0, 4000.0), 3.3, 1300.0, "other means of the mobility took 1354 and 3617 on 129 nodes"
    ),
    "relaxation": Work(
        (2e4, 2e4), 4.6, 500.0, "the relaxation has one a sweep, up to relaxation.max_sweeps"
    ),
    "wedge": Work(
        (1.0, 1.0), 300.0, 900.0, "a wedge makes no convolutions, but takes the time of some 300"
    ),
}

KEPT_BY_GMRES = 210.0
"""Bytes a node that GMRES does without on grids so large that it is restarted (`multigrid.cycle`)."""

START_SECONDS, RANK_BYTES = 2.0, 330 * MiB
"""Of every run: imports, plans, the coarsest grid, files; and of every rank: the libraries."""


@dataclass(frozen=True)
class InletGrid:
    """A grid of the hierarchy: cells in its inlet at the wanted speed, and the speed it is solved at."""

    nodes: int
    cells: float
    speed: float | None
    """m/s; None where nothing is solved on this grid alone."""


@dataclass(frozen=True)
class Forecast:
    """Memory and time of a run."""

    nodes: int
    """Of the finest grid, all together."""
    memory: float
    """Bytes, of all ranks."""
    seconds: tuple[float, float]
    convolutions: tuple[float, float] | None
    convolution_seconds: float
    """Of one on the finest grid, on one core."""
    timed_nodes: int
    """Along each side of the grid on which that was timed."""
    workers: int
    """Ranks that have a core of their own."""
    measured: str


def inlet_grids(config, contact):
    """An `InletGrid` for each grid of the hierarchy, coarsest first; of a loaded contact."""
    solver, length = config.solver, config.grid.x[1] - config.grid.x[0]
    alone = solver.start == "contact" or solver.method == "relaxation"
    grids, nodes = [], COARSEST_NODES
    while nodes <= config.grid.nodes:
        dX, finest = length / (nodes - 1), nodes == config.grid.nodes
        solved = finest or (nodes >= solver.first_nodes and not alone)
        speed = contact.speed if finest else contact.matched_speed(dX, solver.inlet_cells)
        grids.append(InletGrid(nodes, contact.inlet_length / dX, speed if solved else None))
        nodes = 2 * nodes - 1
    return grids


def resolving_nodes(config, contact):
    """Nodes along each side, 2^k + 1, that give the inlet `RESOLVED_CELLS`."""
    length, nodes = config.grid.x[1] - config.grid.x[0], COARSEST_NODES
    while contact.inlet_length * (nodes - 1) / length < RESOLVED_CELLS:
        nodes = 2 * nodes - 1
    return nodes


def expectation(cells, start):
    """What a run finds with so many cells in its inlet."""
    if cells >= RESOLVED_CELLS:
        return "a film that the grid resolves"
    if cells >= FILM_TOUCHES:
        return "a film that changes with the grid"
    if start == "contact" and cells < CONTACT_OPENS:
        return "full contact, whose inlet the grid does not see"
    return "film and contact side by side; where they meet is decided by the grid"


def forecast(config, contact, mesh, ranks):
    """The `Forecast` of a run on so many ranks; times a convolution."""
    work = expected_work(config)
    timed = _timed_mesh(mesh)
    second = time_convolution(timed) * _fft_work(mesh) / _fft_work(timed)
    workers = 1 if mesh.is_line else min(ranks, cores_allowed())
    copies = ranks if mesh.is_line else 1
    return Forecast(
        nodes=mesh.nodes,
        memory=ranks * RANK_BYTES + copies * _bytes_per_node(work, mesh) * mesh.nodes,
        seconds=tuple(
            START_SECONDS + n * work.times_convolution * second / workers for n in work.convolutions
        ),
        convolutions=None if config.contact.kind == "wedge" else work.convolutions,
        convolution_seconds=second,
        timed_nodes=timed.nx,
        workers=workers,
        measured=work.measured,
    )


def _bytes_per_node(work, mesh):
    """Measured ones, less what GMRES keeps where it is not restarted."""
    return work.bytes_per_node - (KEPT_BY_GMRES if mesh.nodes > LARGE_GRID else 0.0)


def expected_work(config):
    """The `Work` of runs like this one."""
    kind, solver = config.contact.kind, config.solver
    if kind != "wedge" and solver.method == "relaxation":
        sweeps = float(config.relaxation.max_sweeps)
        return replace(WORK["relaxation"], convolutions=(sweeps, sweeps))
    if kind != "point":
        return WORK[kind]
    if solver.start == "film" and config.discretization.face_mobility != "arithmetic":
        return WORK["mean"]
    return WORK[solver.start]


def time_convolution(mesh, repeats=5):
    """Seconds of one convolution on a mesh, on one core of this machine: the quickest of a few."""
    grid = single_grid(mesh, MPI.COMM_SELF)
    deflection = Deflection(grid, HalfPlane(1.0) if mesh.is_line else HalfSpace(1.0))
    try:
        pressure, seconds = np.zeros(grid.shape), []
        for _ in range(repeats):
            started = time.perf_counter()
            deflection(pressure)
            seconds.append(time.perf_counter() - started)
    finally:
        for thing in (deflection, grid):
            thing.destroy()
    return min(seconds)


def _timed_mesh(mesh):
    """The mesh itself, or one of its kind that is planned and timed in half a second."""
    nodes = min(mesh.nx, LARGEST_TIMED)
    if mesh.is_line:
        return Mesh(mesh.nx, 1, (-2.0, 2.0), (0.0, 0.0))
    return Mesh(nodes, nodes, (-2.0, 2.0), (-2.0, 2.0))


def _fft_work(mesh):
    """n log n."""
    return mesh.nodes * log(mesh.nodes)
