"""What a run will take, as far as that can be told before it starts.

Its time is that of so many convolutions. One convolution is timed on this machine; how many a run takes,
and how much time beside each, was measured (processor time on one rank, the cases of configs/). Runs that
converge take half to twice the estimate.
"""

import time
from dataclasses import dataclass, replace
from math import log

import numpy as np
from mpi4py import MPI

from mgehl.config import COARSEST_NODES, SECTIONS
from mgehl.discretization.mesh import Mesh
from mgehl.grid.convolution import Deflection
from mgehl.grid.freed_memory import is_large
from mgehl.grid.grid import single_grid
from mgehl.kinds import mesh_from
from mgehl.kinds.kind import Effort
from mgehl.model.deformation import HalfPlane, HalfSpace
from mgehl.multigrid.cycle import DIRECT
from mgehl.output.resolution import CONTACT_OPENS, FILM_TOUCHES
from mgehl.output.surroundings import cores_allowed
from mgehl.solver.from_config import settings_from
from mgehl.solver.nested import planned_solves

LARGEST_TIMED = 513
"""Nodes of the largest grid whose convolution is timed: half a second, most of it for the FFT's plan."""

LARGEST_NODES = SECTIONS["grid"].__dataclass_fields__["nodes"].metadata["high"]
"""Most nodes that a grid may have along each side."""

MiB = 2**20

SAVED_ON_LARGE_GRIDS = 430.0
"""Bytes a node that are given back in time, or not asked for, where memory is short
(`grid.freed_memory`)."""

START_SECONDS, RANK_BYTES = 3.0, 330 * MiB
"""Of every run: imports, plans, the coarsest grid, files, the picture; of every rank: the libraries."""

UNSEEN = Effort(
    600.0, 2e-7, 2e-3, 1300.0, "films that a grid hardly sees took 230 to 1380, and few settled"
)
"""Films whose inlet has so few cells that they touch: 65 nodes, 5 to 100 mm/s. Each step takes many
iterations."""

SIDE_BY_SIDE = Effort(
    120.0, 6e-7, 0.01, 1800.0, "film and contact side by side took 60 to 250 from a contact start"
)  # fmt: skip
"""Starts from contact on grids that see the inlet."""

MEASURED_NODES = 129
"""Nodes along X of the grids on which these were measured. The convolutions grow as the nodes along X:
`rough.toml` takes 142, 280 and 644 on 65, 129 and 257."""

HIGHEST = {False: 465.0, True: 376.0}
"""Convolutions of balls whose roughness is as large as the dry contact is deep, without and with a layer of
2 nm. Of 27 balls (drawn as in `study mixed`, seeds 41 and 42) 25 converged, and 20 of these took half to
twice as many."""

LOWER, THIN = 0.36, 0.15
"""The power with which they fall with less roughness; lambda below which they rise."""

THINNER = {False: 0.36, True: 0.75}
"""The power with which they rise with 1/lambda, without and with a boundary film."""

ROUGH = Effort(
    150.0, 2e-7, 0.01, 5000.0, "rough balls on 129 nodes took 42 to 1165", most_bytes_per_node=12500.0
)
"""Balls whose peaks reach through the film; `_of_peaks` has their convolutions. What GMRES and its memory
keep grows with the iterations: on 257 nodes runs took 450 to 680 MiB. Those whose nearby nodes were solved
at once took 1010 to 1100, and 11.4 GiB on 1025 nodes, where one by lines took 4.0."""

ROUGH_LINE = Effort(
    90.0, 3e-7, 2e-3, 5000.0, "rough lines on 1025 nodes took 13 to 1600, half of them 36 to 133"
)
"""Line contacts of rough bodies, but for the direct solves (`study rollers`). Two matrices are kept."""

DIRECT_SECONDS = 0.24
"""Of the direct solves, for each convolution, on `DIRECT` nodes."""


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
    most_memory: float
    """Those of runs that need the most."""
    seconds: float
    """Half or twice as many are usual."""
    convolutions: float | None
    """None where a run makes none."""
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
    effort = effort_of(config, contact, mesh)
    timed = _timed_mesh(mesh)
    second = time_convolution(timed) * _fft_work(mesh) / _fft_work(timed)
    shared = second + effort.node_seconds * mesh.nodes
    workers = 1 if mesh.is_line else min(ranks, cores_allowed())
    return Forecast(
        nodes=mesh.nodes,
        memory=ranks * RANK_BYTES + bytes_of_nodes(effort, mesh),
        most_memory=ranks * RANK_BYTES + most_bytes_of_nodes(effort, mesh),
        seconds=START_SECONDS + effort.convolutions * (shared / workers + effort.beside),
        convolutions=effort.convolutions if effort.counted else None,
        convolution_seconds=second,
        timed_nodes=timed.nx,
        workers=workers,
        measured=effort.measured,
    )


def bytes_of_nodes(effort, mesh):
    """Bytes for the nodes, on all ranks together, less what is saved where memory is short."""
    saved = SAVED_ON_LARGE_GRIDS if is_large(mesh) else 0.0
    return (effort.bytes_per_node - saved) * mesh.nodes


def most_bytes_of_nodes(effort, mesh):
    """The same of runs that need the most."""
    more = max(effort.most_bytes_per_node - effort.bytes_per_node, 0.0)
    return bytes_of_nodes(effort, mesh) + more * mesh.nodes


def bytes_of_rank(effort, mesh, ranks):
    """The most on the rank that has most of the nodes: one solves a line contact."""
    return most_bytes_of_nodes(effort, mesh) / (1 if mesh.is_line else ranks)


def effort_of(config, contact, mesh):
    """That of the kind; of a ball by its peaks, or by what the grid sees of its inlet."""
    by_kind = config.kind.effort(config)
    if not contact.is_loaded or config.is_dry or config.solver.method != "newton-mg":
        return by_kind
    if mesh.is_line:
        return _of_rough_line(mesh) if contact.roughness else by_kind
    cells = contact.inlet_cells(mesh)
    if contact.is_mixed:
        layers = config.contact.boundary_film > 0.0
        return replace(ROUGH, convolutions=_of_peaks(contact, layers, mesh))
    if config.solver.start == "contact":
        return SIDE_BY_SIDE if cells > CONTACT_OPENS else by_kind
    if cells < FILM_TOUCHES:
        return UNSEEN
    return by_kind


def _of_rough_line(mesh):
    """That of direct solves."""
    direct = min(mesh.nx, DIRECT)
    seconds = ROUGH_LINE.beside + DIRECT_SECONDS * (direct / DIRECT) ** 3
    each = ROUGH_LINE.bytes_per_node + 2.0 * 8.0 * direct**2 / mesh.nx
    return replace(ROUGH_LINE, beside=seconds, bytes_per_node=each)


def _of_peaks(contact, has_layers, mesh):
    """Convolutions of a ball whose peaks reach through the film."""
    film_ratio = contact.expected_film / contact.roughness
    thinner = max(THIN / film_ratio, 1.0) ** THINNER[has_layers]
    highest = HIGHEST[has_layers] * mesh.nx / MEASURED_NODES
    return highest * (contact.roughness / contact.film_scale) ** LOWER * thinner


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
