"""What messages, bytes and flops an iteration takes on how many ranks: measured here, reckoned elsewhere.

The constants are measured on the ranks of this run, at best two of one machine. The table of iterations
sets times beside what the model says with them; the forecast says it for ranks that nobody has here. The
model's ranks send each other their columns, as those of several machines do. Ranks of one machine share
them and take less time.
"""

import time
from dataclasses import replace
from statistics import mean

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc
from scipy.linalg import lu_factor, lu_solve

from mgehl.config import COARSEST_NODES, config_from_tables
from mgehl.errors import UserError
from mgehl.grid.plane import SentPlane, even_widths
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.from_config import set_up
from mgehl.solver.nested import first_guess
from mgehl.solver.problem import ContactProblem
from mgehl.studies import rank_model
from mgehl.studies.rank_model import Constants, Cost
from mgehl.studies.study import PAPER, merged, papers_grid

NODES = (257, 513, 1025)
"""Grids whose iterations are timed; the work's constants are those of the last."""

FORECAST = {4097: (2, 16, 64), 16385: (1, 64, 512)}
"""Nodes along each side and ranks."""

SHORT = 8
"""Bytes of a message that is all latency."""

ALONE = time.process_time
"""Clock of what a rank does by itself."""

ITERATIONS = 2
"""Of GMRES in one timing."""

REPEATS, SECONDS = 3, 0.5
"""Timings at the least, and how long they are repeated: the shortest counts, for others use the machine."""


def run(study):
    """Write the tables `constants`, `iterations`, `forecast` and `levels`. Raises UserError on one rank."""
    if study.comm.size == 1:
        raise UserError("study ranks: one rank has nobody to send to; start it with mpiexec -n 2")
    nodes = study.nodes or NODES
    constants = _constants(study.comm, nodes[-1])
    study.write_table("constants", _constant_rows(constants))
    study.write_table("iterations", [_iteration_row(study.comm, each, constants) for each in nodes])
    rows = [_forecast_row(n, ranks, constants) for n, many in FORECAST.items() for ranks in many]
    study.write_table("forecast", rows)
    study.write_table("levels", _level_rows(max(FORECAST), FORECAST[max(FORECAST)][-1]))


def _constants(comm, nodes):
    """`Constants` of messages between this run's ranks and of the work of one rank alone."""
    latency = _shortest(comm, lambda: _to_and_fro(comm, SHORT, 200)) / 400
    exchange = _seconds_of_exchange(comm, comm.size) / (2 * (comm.size - 1))
    sent = rank_model.Level(nodes, comm.size).convolution().bytes
    bandwidth = sent / _seconds_of_exchange(comm, nodes)
    direct = _shortest(comm, _direct_solve(), ALONE)
    small, large = (_Iterations(MPI.COMM_SELF, each) for each in (COARSEST_NODES * 2 - 1, nodes))
    try:
        transforms = rank_model.Level(nodes, 1).convolution().transforms
        transform = _shortest(comm, large.convolve, ALONE)
        cost = rank_model.iteration(nodes, 1)
        rest = large.seconds(comm, ALONE) - cost.transforms * transform / transforms - direct
        speeds = transforms / transform, cost.sweeps / rest
        work = Constants(latency, exchange, bandwidth, *speeds, direct, 0.0)
        few = rank_model.iteration(COARSEST_NODES * 2 - 1, 1)
        calls = (small.seconds(comm, ALONE) - sum(few.seconds(work))) / few.grids
    finally:
        small.destroy()
        large.destroy()
    return replace(work, calls=max(calls, 0.0))


def _shortest(comm, function, clock=time.perf_counter):
    """Seconds of a call that all ranks make, the shortest of some; the mean over the ranks.

    By the processor's `clock` for what waits for nobody: a machine that others use disturbs it less.
    """
    function()
    began, times, spent = time.perf_counter(), [], 0.0
    while len(times) < REPEATS or spent < SECONDS:
        comm.Barrier()
        started = clock()
        function()
        times.append(mean(comm.allgather(clock() - started)))
        spent = comm.bcast(time.perf_counter() - began)
    return min(times)


def _to_and_fro(comm, size, times):
    """Ranks 0 and 1 send each other so many bytes, in turn."""
    message = np.zeros(size, dtype=np.uint8)
    for _ in range(times):
        if comm.rank == 0:
            comm.Send(message, 1)
            comm.Recv(message, 1)
        elif comm.rank == 1:
            comm.Recv(message, 0)
            comm.Send(message, 0)


def _seconds_of_exchange(comm, nodes):
    """Of a convolution's transforms of nodes by nodes, there and back."""
    starts = np.linspace(0, nodes, comm.size + 1).astype(int)
    plane = SentPlane(comm, starts, even_widths(nodes, comm.size), complex)

    def there_and_back():
        plane.to_columns()
        plane.to_lines()

    seconds = _shortest(comm, there_and_back)
    plane.destroy()
    return seconds


def _direct_solve():
    """Function that solves a system as large as the coarsest grid's."""
    size = COARSEST_NODES**2 + 1
    factors, right = lu_factor(np.eye(size) + 1.0 / size), np.ones(size)
    return lambda: lu_solve(factors, right, check_finite=False)


class _Iterations:
    """GMRES with its cycle on a film that is being solved, to be timed.

    At 30 mm/s coarse grids of up to 513 nodes do not hold the film: the cycle is V, as the model's is.
    """

    def __init__(self, comm, nodes):
        tables = merged(PAPER, {"grid": papers_grid(nodes), "motion": {"speed": 0.03}})
        config = config_from_tables(tables)
        parts = set_up(config)
        contact, scheme = parts.contact, parts.settings.scheme
        self._hierarchy = grids = parts.hierarchy(comm)
        problem = ContactProblem(grids.grids[-1], grids.deflections[-1], contact, scheme)
        state = first_guess(problem, "film")
        evaluation = problem.evaluate(state)
        self._multigrid = MultigridSolver(
            grids, len(grids.grids) - 1, contact, scheme, parts.settings.cycle
        )
        self._multigrid.linearise(evaluation, problem.rows(state.status))
        self._ksp = PETSc.KSP().create(comm)
        self._multigrid.configure(self._ksp, rtol=1e-30)
        self._ksp.setTolerances(max_it=ITERATIONS)
        self._rhs, self._x = (self._multigrid.space.create_vec() for _ in range(2))
        residual = problem.residual(evaluation, state.status)
        self._multigrid.space.write(self._rhs, residual, 0.0)
        self.convolve = lambda: problem.deflection(state.P)

    def seconds(self, comm, clock=time.perf_counter):
        """Of one iteration; all ranks of `comm` do it at once."""
        spent = _shortest(comm, lambda: self._ksp.solve(self._rhs, self._x), clock)
        return spent / self._ksp.getIterationNumber()

    def destroy(self):
        """Free the PETSc and MPI objects."""
        for thing in (self._ksp, self._rhs, self._x):
            thing.destroy()
        self._multigrid.free()
        self._hierarchy.destroy()


def _constant_rows(constants):
    named = {
        "latency of a message": f"{1e6 * constants.latency:.2g} us",
        "a message of an exchange": f"{1e6 * constants.exchange:.2g} us",
        "bytes of an exchange, packed and unpacked": f"{1e-9 * constants.bandwidth:.2g} GB/s",
        "Fourier transforms": f"{1e-9 * constants.transforms:.2g} Gflop/s",
        "sweeps, products, transfers": f"{1e-9 * constants.sweeps:.2g} Gflop/s",
        "direct solve on the coarsest grid": f"{1e3 * constants.direct:.2g} ms",
        "calls on each grid": f"{1e6 * constants.calls:.0f} us",
    }
    return [{"constant": name, "measured": value} for name, value in named.items()]


def _iteration_row(comm, nodes, constants):
    """An iteration of this run's ranks, timed, beside the model."""
    iterations = _Iterations(comm, nodes)
    try:
        seconds = iterations.seconds(comm)
    finally:
        iterations.destroy()
    cost = rank_model.iteration(nodes, comm.size)
    return {
        "nodes": str(nodes),
        "ranks": str(comm.size),
        **_counted(cost),
        "model ms": f"{1e3 * sum(cost.seconds(constants)):.3g}",
        "measured ms": f"{1e3 * seconds:.3g}",
    }


def _forecast_row(nodes, ranks, constants):
    """An iteration of ranks that are not there, and where its time goes."""
    cost, alone = (rank_model.iteration(nodes, many) for many in (ranks, 1))
    waiting, moving, transforms, sweeps, direct, calls = cost.seconds(constants)
    total, serial = sum(cost.seconds(constants)), sum(alone.seconds(constants))
    return {
        "nodes": str(nodes),
        "ranks": str(ranks),
        "lines": str(rank_model.Level(nodes, ranks).lines),
        **_counted(cost),
        "waiting ms": f"{1e3 * waiting:.3g}",
        "bytes ms": f"{1e3 * moving:.3g}",
        "transforms ms": f"{1e3 * transforms:.3g}",
        "sweeps ms": f"{1e3 * sweeps:.3g}",
        "direct and calls ms": f"{1e3 * (direct + calls):.3g}",
        "whole ms": f"{1e3 * total:.3g}",
        "efficiency": f"{serial / total / ranks:.0%}",
    }


def _counted(cost: Cost):
    """Of one rank and iteration."""
    return {
        "halo messages": f"{cost.halos:.0f}",
        "exchange messages": f"{cost.exchanged:.0f}",
        "collective messages": f"{cost.collective:.0f}",
        "MB": f"{1e-6 * cost.bytes:.3g}",
        "Mflop": f"{1e-6 * (cost.transforms + cost.sweeps):.4g}",
    }


def _level_rows(nodes, ranks):
    """Who works on which grid, and how long the messages of an exchange are."""
    rows = []
    for level in rank_model.levels(nodes, ranks)[::-1]:
        length = rank_model.COMPLEX * level.mine / level.ranks
        rows.append(
            {
                "nodes": str(level.nodes),
                "ranks at work": str(level.ranks),
                "lines each": str(level.lines),
                "bytes of an exchange's message": f"{length:.0f}",
            }
        )
    return rows
