"""What a run will take, as far as that can be told before it starts.

Its time is that of so many convolutions. One convolution is timed on this machine; how many a run takes,
and how much time beside each, was measured (`mgehl bench`; two shared cores). All of it is an estimate.
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
from mgehl.kinds import mesh_from
from mgehl.model.deformation import HalfPlane, HalfSpace
from mgehl.multigrid.cycle import LARGE_GRID
from mgehl.output.resolution import FILM_TOUCHES
from mgehl.output.surroundings import cores_allowed
from mgehl.solver.from_config import settings_from
from mgehl.solver.nested import planned_solves

LARGEST_TIMED = 513
"""Nodes of the largest grid whose convolution is timed: half a second, most of it for the FFT's plan."""

LARGEST_NODES = SECTIONS["grid"].__dataclass_fields__["nodes"].metadata["high"]
"""Most nodes that a grid may have along each side."""

MiB = 2**20


KEPT_BY_GMRES = 210.0
"""Bytes a node that GMRES does without on grids so large that it is restarted (`multigrid.cycle`)."""

START_SECONDS, RANK_BYTES = 4.0, 330 * MiB
"""Of every run: imports, plans, the coarsest grid, files, the picture; of every rank: the libraries."""

BESIDE = 0.01, 0.03
"""Seconds of what a run does besides for each convolution, on however small a grid: runs on 65 to 257
nodes took 4 to 90 ms, those of many convolutions the least."""

UNSEEN = 2381.0
"""Most convolutions of films that the grid hardly sees: on 65 to 257 nodes at 0.1 to 20 mm/s."""
UNSEEN_WORDS = f"films that a grid hardly sees took 299 to {UNSEEN:g}, and most did not settle"

MIXED = 90.0, 1440.0
"""Fewest and most convolutions of rough balls whose peaks reach through the film: 257 nodes, boundary film
2 nm, 1 to 0.01 mm/s."""
MIXED_WORDS = f"rough balls on 257 nodes took {MIXED[0]:g} to {MIXED[1]:g}, the more the slower they slid"


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
    meshes = [mesh_from(config, contact)]
    while meshes[0].nx > COARSEST_NODES:
        meshes.insert(0, meshes[0].coarsened())
    solves = planned_solves(meshes, contact, settings_from(config, contact))
    speeds = {solve.nodes: solve.speed for _, solve in solves}
    return [InletGrid(mesh.nx, contact.inlet_cells(mesh), speeds.get(mesh.nx)) for mesh in meshes]


def forecast(config, contact, mesh, ranks):
    """The `Forecast` of a run on so many ranks; times a convolution."""
    effort = _effort(config, contact, mesh)
    timed = _timed_mesh(mesh)
    second = time_convolution(timed) * _fft_work(mesh) / _fft_work(timed)
    workers = 1 if mesh.is_line else min(ranks, cores_allowed())
    copies = ranks if mesh.is_line else 1
    return Forecast(
        nodes=mesh.nodes,
        memory=ranks * RANK_BYTES + copies * _bytes_per_node(effort, mesh) * mesh.nodes,
        seconds=tuple(
            START_SECONDS + n * (effort.times_convolution * second / workers + beside)
            for n, beside in zip(effort.convolutions, BESIDE, strict=True)
        ),
        convolutions=effort.convolutions if effort.counted else None,
        convolution_seconds=second,
        timed_nodes=timed.nx,
        workers=workers,
        measured=effort.measured,
    )


def _effort(config, contact, mesh):
    """That of the kind; where the film is below what the grid sees a run may take far more."""
    effort = config.kind.effort(config)
    if _is_mixed(config, contact, mesh):
        return replace(effort, convolutions=MIXED, measured=MIXED_WORDS)
    if not _is_unseen(config, contact, mesh):
        return effort
    low, high = effort.convolutions
    return replace(effort, convolutions=(low, max(high, UNSEEN)), measured=UNSEEN_WORDS)


def _is_mixed(config, contact, mesh):
    """Whether it is a rough ball whose peaks reach through the film."""
    if not contact.is_loaded or config.is_dry or mesh.is_line or config.solver.method != "newton-mg":
        return False
    return contact.is_mixed


def _is_unseen(config, contact, mesh):
    """Whether a start from a film has had contact on such grids, and steps without end."""
    if not contact.is_loaded or config.is_dry or mesh.is_line or config.solver.start != "film":
        return False
    return config.solver.method == "newton-mg" and contact.inlet_cells(mesh) < FILM_TOUCHES


def _bytes_per_node(effort, mesh):
    """Measured ones, less what GMRES keeps where it is not restarted."""
    return effort.bytes_per_node - (KEPT_BY_GMRES if mesh.nodes > LARGE_GRID else 0.0)


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
