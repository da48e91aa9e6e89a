"""What a run will take, as far as that can be told before it starts, and whether it has room in memory.

One convolution is timed on this machine; how many a run takes, and how much time beside each, was measured
on configs/. Runs that converge take half to twice the estimate.
"""

import resource
import time
from dataclasses import dataclass, replace
from math import log
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mpi4py import MPI

from mgehl.config import COARSEST_NODES, SECTIONS
from mgehl.discretization.mesh import Mesh
from mgehl.errors import UserError
from mgehl.grid.convolution import Deflection
from mgehl.grid.freed_memory import is_large
from mgehl.grid.grid import meshes_of, single_grid
from mgehl.kinds.kind import Effort
from mgehl.kinds.time import scene_of
from mgehl.model.deformation import HalfPlane, HalfSpace
from mgehl.multigrid.cycle import DIRECT, DIRECT_IN_TIME
from mgehl.output.resolution import CONTACT_OPENS, FILM_TOUCHES, inlet_cells
from mgehl.output.surroundings import cores_allowed
from mgehl.solver.from_config import scheme_from, set_up
from mgehl.solver.nested import planned_solves
from mgehl.solver.pace import expected_steps

TIMED = 5
"""Convolutions of which the quickest counts."""

LARGEST_TIMED = 513
"""Nodes of the largest grid whose convolution is timed: half a second, most of it for the FFT's plan."""

LARGEST_NODES = SECTIONS["grid"].__dataclass_fields__["nodes"].metadata["high"]
"""Most nodes that a grid may have along each side."""

MiB = 2**20

SPARE = 128 * MiB
"""Bytes of buffers that BLAS and MPI take during a run."""

SAVED_ON_LARGE_GRIDS = 430.0
"""Bytes a node given back in time, or not asked for, where memory is short (`grid.freed_memory`)."""

START_SECONDS, RANK_BYTES = 3.0, 330 * MiB
"""Of every run: imports, plans, the coarsest grid, files, the picture; of every rank: the libraries."""

UNSEEN = Effort(
    90.0, 2e-7, 2e-3, 1300.0,
    "films that a grid hardly sees took 42 to 640 on 65 to 257 nodes, near rest up to 1800",
)  # fmt: skip
"""Films whose inlet has less than `FILM_TOUCHES` cells, 0.1 mm/s to 0.8 m/s."""

SHUT = replace(UNSEEN, convolutions=600.0, measured="films that touch took 230 to 1380, and few settled")
"""The same of contact that shuts its faces: 65 nodes, 5 to 100 mm/s."""

SIDE_BY_SIDE = Effort(
    120.0, 6e-7, 0.01, 1800.0, "film and contact side by side took 60 to 250 from a contact start"
)  # fmt: skip
"""Such contact as the start on grids that see the inlet."""

ROUGH = Effort(
    150.0, 2e-7, 0.01, 5000.0, "rough balls on 257 nodes took 38 to 2700", most_bytes_per_node=12500.0
)
"""Balls whose peaks reach through the film; `_of_peaks` has their convolutions. What GMRES and its memory
keep grows with the iterations, the more where nearby nodes are solved at once."""

ROUGH_LINE = Effort(
    90.0, 3e-7, 2e-3, 5000.0, "rough lines on 1025 nodes took 13 to 1600, half of them 36 to 133"
)
"""Line contacts of rough bodies, but for the direct solves (`study rollers`). Two matrices are kept."""

DIRECT_SECONDS = 0.24
"""Of the direct solves, for each convolution, on `DIRECT` nodes."""


class InletGrid(NamedTuple):
    """A grid of the hierarchy: cells in its inlet at the wanted speed, and the speed (m/s) it is solved at;
    None where nothing is solved on this grid alone."""

    nodes: int
    cells: float
    speed: float | None


@dataclass(frozen=True)
class Costs:
    """Memory (bytes, of all ranks) and time of a run; half or twice as many seconds are usual."""

    memory: float
    most_memory: float
    """Of runs that need the most."""
    seconds: float
    convolutions: float | None
    """None where a run makes none."""
    convolution_seconds: float
    """Of one on the finest grid, on one core, by one on `timed_nodes` along each side."""
    timed_nodes: int
    workers: int
    """Ranks that have a core of their own."""
    measured: str


def inlet_grids(case):
    """An `InletGrid` for each grid of the hierarchy of a loaded contact's `Case`, coarsest first."""
    parts, scene = set_up(case), case.scene if case.config.is_in_time else None
    # In the axes of the solve, whose X may be the user's y: other cells, other speeds.
    meshes = meshes_of(parts.mesh, COARSEST_NODES)
    solves = planned_solves(meshes, parts.contact, parts.settings, parts.recipe())
    speeds = {level: solve.speed for level, solve, _ in solves}
    return [
        InletGrid(mesh.nx, inlet_cells(case.contact, mesh, scene), speeds.get(level))
        for level, mesh in enumerate(meshes_of(case.mesh, COARSEST_NODES))
    ]


def forecast(config, contact, mesh, ranks):
    """The `Costs` of a run on so many ranks; times a convolution."""
    effort = effort_of(config, contact, mesh)
    nodes = mesh.nx if mesh.is_line else min(mesh.nx, LARGEST_TIMED)
    y = (1, (0.0, 0.0)) if mesh.is_line else (nodes, (-2.0, 2.0))
    timed = Mesh(nodes, y[0], (-2.0, 2.0), y[1])
    second = time_convolution(timed) * mesh.nodes * log(mesh.nodes) / (timed.nodes * log(timed.nodes))
    workers = 1 if mesh.is_line else min(ranks, cores_allowed())
    each = (second + effort.node_seconds * mesh.nodes) / workers + effort.beside
    return Costs(
        memory=ranks * RANK_BYTES + bytes_of_nodes(effort, mesh),
        most_memory=ranks * RANK_BYTES + bytes_of_nodes(effort, mesh, most=True),
        seconds=START_SECONDS + effort.convolutions * each,
        convolutions=effort.convolutions if effort.counted else None,
        convolution_seconds=second,
        timed_nodes=nodes,
        workers=workers,
        measured=effort.measured,
    )


OF_A_STEP = (12.0, 20.0, 45.0)
"""Convolutions of a step in time: of smooth bodies, of rough ones in a film, of those that touch. From
65 to 257 nodes they took 1 to 16, 18 to 33 and 24 to 60."""

OF_A_SHORT_LINE = 4.0
"""The same of a line that is solved directly."""


def bytes_of_nodes(effort, mesh, most=False):
    """Bytes for the nodes, on all ranks together, less what is saved where memory is short; those of most
    runs, or of the runs that need the `most`."""
    each = max(effort.most_bytes_per_node, effort.bytes_per_node) if most else effort.bytes_per_node
    return (each - (SAVED_ON_LARGE_GRIDS if is_large(mesh) else 0.0)) * mesh.nodes


def effort_of(config, contact, mesh):
    """That of the way to a steady state and, in time, of the steps."""
    steady = _steady_effort(config, contact, mesh)
    if not config.is_in_time:
        return steady
    steps = expected_steps(scene_of(config, contact), mesh, config.time.step)
    direct = mesh.is_line and mesh.nx <= DIRECT_IN_TIME
    each = OF_A_SHORT_LINE if direct else OF_A_STEP[contact.is_rough + contact.is_mixed]
    measured = f"{steps} steps of some {each:g} after the steady state"
    changes = any(isinstance(config.value(key), str) for key in ("motion.speed", config.kind.load_key))
    if changes and not contact.is_rough and not config.time.step:
        measured += "; waves of speed or load took up to six times as many"
    return replace(steady, convolutions=steady.convolutions + each * steps, measured=measured)


def _steady_effort(config, contact, mesh):
    """That of the kind; of a ball by its peaks, or by what the grid sees of its inlet."""
    by_kind = config.kind.effort(config)
    if not contact.is_loaded or config.is_dry or not config.solver.by_newton:
        return by_kind
    if mesh.is_line:
        if not contact.roughness:
            return by_kind
        direct = min(mesh.nx, DIRECT)
        seconds = ROUGH_LINE.beside + DIRECT_SECONDS * (direct / DIRECT) ** 3
        each = ROUGH_LINE.bytes_per_node + 2.0 * 8.0 * direct**2 / mesh.nx
        return replace(ROUGH_LINE, beside=seconds, bytes_per_node=each)
    cells = contact.inlet_cells(mesh)
    if contact.is_mixed:
        return replace(ROUGH, convolutions=_of_peaks(contact, config.contact.boundary_film > 0.0, mesh))
    shuts = scheme_from(config, contact).contact_law.closes_faces
    if shuts and not config.solver.from_film:
        return SIDE_BY_SIDE if cells > CONTACT_OPENS else by_kind
    return (SHUT if shuts else UNSEEN) if cells < FILM_TOUCHES else by_kind


def _of_peaks(contact, has_layers, mesh):
    """Convolutions of a ball whose peaks reach through the film: of two in three right within 2. Less rough
    over the depth of the dry contact they are fewer; below lambda = 0.15 they rise with 1/lambda, with
    layers of 2 nm faster."""
    thinner = max(0.15 * contact.roughness / contact.expected_film, 1.0) ** (0.75 if has_layers else 0.36)
    return 330.0 * (mesh.nx / 129) ** 0.5 * (contact.roughness / contact.film_scale) ** 0.36 * thinner


def time_convolution(mesh):
    """Seconds of one convolution on a mesh, on one core of this machine: the quickest of a few."""
    grid = single_grid(mesh, MPI.COMM_SELF)
    deflection = Deflection(grid, HalfPlane(1.0) if mesh.is_line else HalfSpace(1.0))
    try:
        pressure, seconds = np.zeros(grid.shape), []
        for _ in range(TIMED):
            started = time.perf_counter()
            deflection(pressure)
            seconds.append(time.perf_counter() - started)
    finally:
        for thing in (deflection, grid):
            thing.destroy()
    return min(seconds)


def check_memory(case, ranks):
    """UserError where a rank may not take what a `Case` needs (ulimit -v): libraries crash or hang."""
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return
    effort, at_work = effort_of(case.config, case.contact, case.mesh), 1 if case.mesh.is_line else ranks
    need = _taken() + SPARE + bytes_of_nodes(effort, case.mesh, most=True) / at_work
    if need > limit:
        what, nodes = f"about {need / MiB:.0f} MiB of address space", case.config.grid.nodes
        raise UserError(
            f"grid.nodes = {nodes}: takes {what}, and this shell allows {limit / MiB:.0f} (ulimit -v)"
        )


def _taken():
    """Bytes of address space that this process has."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    except (OSError, ValueError):
        return 0
