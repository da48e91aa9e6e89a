"""The same answers on any number of ranks. Run as `mpiexec -n 2 python -m pytest -m parallel`.

Every rank runs every test, and collective calls must be reached by all: what is compared on one
rank is sent to all before the assertion.
"""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.discretization.residual import Linearisation
from mgehl.discretization.rows import rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED, WALL
from mgehl.errors import OutputError, Stopped
from mgehl.grid.ownership import MIN_LINES
from mgehl.grid.regroup import Move
from mgehl.grid.transfers import PartitionedTransfer
from mgehl.model.contact import RESOLVED_CELLS
from mgehl.multigrid.cliffs import CliffZone
from mgehl.multigrid.jacobian import BorderedSpace
from mgehl.output.checkpoint import Checkpoint
from mgehl.run import Watch
from mgehl.run import solve as solve_config
from mgehl.solver.inequality import check_pressure_inequality
from mgehl.solver.nested import single_loop
from mgehl.solver.problem import ContactProblem, State
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.settings import NestedSettings, NewtonSettings, SolverSettings
from mgehl.solver.squeeze import squeeze_rates
from mgehl.solver.verification import complementarity_error, flux_imbalance
from mgehl.studies.branch import Branches
from mgehl.studies.study import PAPER, Study, merged, papers_grid
from mgehl.studies.wedge import case as wedge_case
from mgehl.studies.wedge_pocket import case as pocket_case

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
CONFIGS = Path(__file__).resolve().parents[2] / "configs"
MESHES = [{"nodes": 65}, {"nodes": 65, "ny": 33, "coarsest": 65}]


@pytest.fixture
def pair(paper_contact, make_hierarchy):
    """Function: the same hierarchy on all ranks together, and on each by itself."""

    def make(ratio=1.0, **grid):
        contact = paper_contact(radius_y=ratio * 12.7e-3)
        return make_hierarchy(contact, comm=COMM, **grid), make_hierarchy(contact, **grid)

    return make


def lines(grid, whole):
    """This rank's lines of a whole array that every rank has."""
    return np.ascontiguousarray(whole[grid.first : grid.last])


def whole(grid, array):
    """The whole array on every rank (collective)."""
    return COMM.bcast(grid.gather(array))


def random(grid, seed=0):
    """The same whole array of random numbers on every rank."""
    return np.random.default_rng(seed).standard_normal((grid.mesh.ny, grid.mesh.nx))


def mixed_status(grid):
    """A disc of contact, a cavity behind it; whole, for a grid on one rank."""
    status = np.where(grid.X**2 + grid.Y**2 < 0.49, CONTACT, LUBRICATED)
    status = np.where(grid.X > 0.9, CAVITATED, status)
    return np.where(grid.boundary(), BOUNDARY, status).astype(np.int8)


def problem_of(hierarchy, contact, scheme=None):
    """The `ContactProblem` on the finest grid."""
    return ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme or Scheme())


class TestGrid:
    def test_lines_are_dealt_out_to_all_ranks(self, pair):
        together, _ = pair(nodes=129)
        for coarse, fine in zip(together.grids[:-1], together.grids[1:], strict=True):
            assert sum(COMM.allgather(fine.shape[0])) == fine.mesh.ny
            assert fine.shape[0] >= 2
            # A coarse line belongs to the rank that owns the same fine line.
            assert fine.first <= 2 * coarse.first and 2 * (coarse.last - 1) < fine.last

    @pytest.mark.parametrize("kind", [float, np.int8, bool])
    def test_halo_brings_the_neighbours_lines(self, pair, kind):
        together, _ = pair(nodes=65)
        grid = together.grids[-1]
        values = (random(grid) > 0.0).astype(kind)
        padded = np.pad(values, ((HALO, HALO), (0, 0)))
        ghosted = grid.halo(lines(grid, values))
        assert ghosted.dtype == kind
        np.testing.assert_array_equal(ghosted, padded[grid.first : grid.last + 2 * HALO])

    @pytest.mark.parametrize("kind", [float, bool])
    def test_as_many_lines_of_the_neighbours_as_they_have_at_the_least(self, pair, kind):
        together, _ = pair(nodes=65)
        for grid in together.grids:
            values = (random(grid) > 0.0).astype(kind)
            padded = np.pad(values, ((MIN_LINES, MIN_LINES), (0, 0)))
            if grid.has_lines:
                around = grid.lines_around(lines(grid, values), MIN_LINES)
                assert around.dtype == kind
                np.testing.assert_array_equal(around, padded[grid.first : grid.last + 2 * MIN_LINES])

    def test_only_beyond_the_domain_are_walls(self, pair):
        together, alone = pair(nodes=65)
        grid, status = together.grids[-1], mixed_status(alone.grids[-1])
        padded = np.pad(status, ((HALO, HALO), (0, 0)), constant_values=WALL)
        ghosted = grid.halo_status(lines(grid, status))
        np.testing.assert_array_equal(ghosted, padded[grid.first : grid.last + 2 * HALO])

    def test_refresh_brings_the_neighbours_lines_in_place(self, pair):
        together, _ = pair(nodes=65)
        grid = together.grids[-1]
        values = random(grid)
        ghosted = grid.halo(lines(grid, values))
        own(ghosted)[:] *= 2.0
        grid.refresh(ghosted)
        padded = np.pad(2.0 * values, ((HALO, HALO), (0, 0)))
        np.testing.assert_array_equal(ghosted, padded[grid.first : grid.last + 2 * HALO])

    def test_gather(self, pair):
        together, _ = pair(nodes=65)
        grid, values = together.grids[-1], random(together.grids[-1])
        gathered = grid.gather(lines(grid, values))
        assert (gathered is None) == (COMM.rank != 0)
        np.testing.assert_array_equal(COMM.bcast(gathered), values)
        several = np.stack([lines(grid, values), lines(grid, 2.0 * values)])
        whole = grid.gather(several)
        np.testing.assert_array_equal(COMM.bcast(whole), [values, 2.0 * values])
        np.testing.assert_array_equal(grid.scatter(whole), several)

    def test_reductions(self, pair):
        together, _ = pair(nodes=65)
        grid, values = together.grids[-1], random(together.grids[-1])
        mine = lines(grid, values)
        assert grid.max(mine) == values.max() and grid.min(mine) == values.min()
        assert grid.count(mine > 0.0) == np.count_nonzero(values > 0.0)
        assert grid.sum(mine.sum()) == pytest.approx(values.sum(), rel=1e-12)
        for j in (0, 32, 64):
            assert grid.value_at(mine, 10, j) == values[j, 10]

    def test_boundary(self, pair):
        together, alone = pair(nodes=65)
        grid = together.grids[-1]
        np.testing.assert_array_equal(whole(grid, grid.boundary()), alone.grids[-1].boundary())


SMALL = {"nodes": 33, "coarsest": 5}
"""Down to a grid whose lines are too few for two ranks, by way of one that is too small for three."""


class TestCoarseGridsOnFewerRanks:
    def test_the_coarsest_is_one_rank_s_and_its_halo_is_too(self, pair):
        together, _ = pair(**SMALL)
        coarsest, finest = together.grids[0], together.grids[-1]
        assert COMM.allgather(coarsest.shape[0]) == [0] * (COMM.size - 1) + [5]
        assert COMM.allgather(finest.has_lines) == [True] * COMM.size
        values = random(coarsest)
        ghosted = coarsest.halo(lines(coarsest, values))
        assert ghosted.shape == coarsest.ghosted_shape
        np.testing.assert_array_equal(ghosted[HALO:-HALO], lines(coarsest, values))

    def test_what_all_ranks_ask_is_known_to_all(self, pair):
        together, alone = pair(**SMALL)
        grid, values = together.grids[0], random(together.grids[0])
        mine = lines(grid, values)
        assert grid.max(mine) == values.max() and grid.min(mine) == values.min()
        assert grid.count(mine > 0.0) == np.count_nonzero(values > 0.0)
        assert grid.value_at(mine, 1, 2) == values[2, 1]
        assert grid.sum(mine.sum()) == pytest.approx(values.sum(), rel=1e-12)
        np.testing.assert_array_equal(whole(grid, mine), values)
        np.testing.assert_array_equal(grid.scatter(values if COMM.rank == 0 else None), mine)
        np.testing.assert_array_equal(whole(grid, grid.boundary()), alone.grids[0].boundary())

    @pytest.mark.parametrize("kind", [float, np.int8, bool])
    def test_lines_move_to_the_coarse_ranks_and_back(self, pair, kind):
        together, alone = pair(**SMALL)
        for shared, serial in zip(together.transfers, alone.transfers, strict=True):
            fine = (random(serial.fine) > 0.0).astype(kind)
            injected = shared.inject(lines(shared.fine, fine))
            assert injected.dtype == kind
            np.testing.assert_array_equal(injected, lines(shared.coarse, fine[::2, ::2]))

    def test_transfers_equal_the_serial_ones(self, pair):
        together, alone = pair(**SMALL)
        for shared, serial in zip(together.transfers, alone.transfers, strict=True):
            fine, coarse = random(serial.fine, 1), random(serial.coarse, 2)
            down = whole(shared.coarse, shared.full_weighting(lines(shared.fine, fine)))
            up = whole(shared.fine, shared.bilinear(lines(shared.coarse, coarse)))
            np.testing.assert_allclose(down, serial.full_weighting(fine), rtol=0.0, atol=1e-14)
            np.testing.assert_allclose(up, serial.bilinear(coarse), rtol=0.0, atol=1e-14)

    def test_convolutions_equal_the_serial_ones(self, pair):
        together, alone = pair(**SMALL)
        for shared, serial in zip(together.deflections, alone.deflections, strict=True):
            P = np.where(serial.grid.boundary(), 0.0, random(serial.grid))
            expected = serial(P).copy()
            found = whole(shared.grid, shared(lines(shared.grid, P)).copy())
            assert np.max(np.abs(found - expected)) < 1e-12 * np.max(np.abs(expected))
        assert COMM.allgather(together.convolutions) == [alone.convolutions] * COMM.size

    def test_the_border_is_known_to_whom_it_concerns(self, pair, make_vec):
        together, _ = pair(**SMALL)
        grid = together.grids[0]
        space, values = BorderedSpace(grid), random(grid)
        vec = make_vec(space, lines(grid, values), 2.5)
        assert vec.getSize() == grid.mesh.nodes + 1
        assert space.read(vec)[1] == 2.5
        assert space.read_in_team(vec)[1] == (2.5 if grid.has_lines else 0.0)
        assert COMM.allgather(space.read_own(vec)[1]) == [0.0] * (COMM.size - 1) + [2.5]

    @pytest.mark.parametrize("start, speed", [("film", 1.0), ("contact", 5e-6)])
    def test_cycles_over_them_solve_as_on_one_rank(self, solve, paper_contact, start, speed):
        together, alone = (
            solve(paper_contact(speed), 33, start, coarsest=5, comm=comm) for comm in (COMM, MPI.COMM_SELF)
        )
        found, expected = together.outcome, alone.outcome
        assert found.converged and expected.converged
        work = [[cycle.linear_iterations for cycle in each.cycles] for each in (found, expected)]
        assert work[0] == work[1]
        H = whole(together.problem.grid, found.state.H)
        scale = np.abs(expected.state.H).max()
        np.testing.assert_allclose(H, expected.state.H, rtol=0.0, atol=1e-9 * scale)


class TestMove:
    """Lines 0, 1, ... of ten, wanted from elsewhere."""

    @pytest.mark.parametrize("kind", [float, np.int8, bool])
    def test_lines_reach_all_that_want_them_and_zeros_whom_they_do_not(self, kind):
        values = np.arange(1, 31).reshape(10, 3).astype(kind)
        last = COMM.size - 1
        held = [(0, 0)] * last + [(0, 10)]
        wanted = [(rank - 1, rank + 3) for rank in range(COMM.size)]
        mine = values[slice(*held[COMM.rank])]
        moved = Move(COMM, held, wanted)(mine)
        padded = np.zeros((12, 3), dtype=kind)
        padded[1:-1] = values
        assert moved.dtype == kind
        np.testing.assert_array_equal(moved, padded[COMM.rank : COMM.rank + 4])

    def test_who_wants_nothing_gets_nothing(self):
        held = [(0, 4)] + [(4, 4)] * (COMM.size - 1)
        moved = Move(COMM, held, held[::-1])(np.ones((held[COMM.rank][1] - held[COMM.rank][0], 2)))
        assert moved.shape == (4 if COMM.rank == COMM.size - 1 else 0, 2)


class TestConvolution:
    @pytest.mark.parametrize("grid", MESHES, ids=["square", "oblong"])
    @pytest.mark.parametrize("ratio", [1.0, 2.0])
    def test_it_equals_the_serial_one(self, pair, ratio, grid):
        together, alone = pair(ratio, **grid)
        for shared, serial in zip(together.deflections, alone.deflections, strict=True):
            P = np.where(serial.grid.boundary(), 0.0, random(serial.grid))
            expected = serial(P).copy()
            deflection = whole(shared.grid, shared(lines(shared.grid, P)).copy())
            assert np.max(np.abs(deflection - expected)) < 1e-12 * np.max(np.abs(expected))
            assert shared.count == 1


class TestTransfers:
    def test_they_equal_the_serial_ones(self, pair):
        together, alone = pair(nodes=129)
        for shared, serial in zip(together.transfers, alone.transfers, strict=True):
            fine, coarse = random(serial.fine, 1), random(serial.coarse, 2)
            for name, values, source, target in (
                ("inject", fine, shared.fine, shared.coarse),
                ("full_weighting", fine, shared.fine, shared.coarse),
                ("bilinear", coarse, shared.coarse, shared.fine),
                ("cubic", 5.0 + coarse, shared.coarse, shared.fine),
            ):
                expected = getattr(serial, name)(values)
                result = whole(target, getattr(shared, name)(lines(source, values)))
                np.testing.assert_allclose(result, expected, rtol=0.0, atol=1e-14, err_msg=name)

    @pytest.mark.parametrize("offset", [(-1, 0), (1, 0), (0, -1), (0, 1)])
    def test_halfway_between_coarse_nodes(self, pair, offset):
        together, alone = pair(nodes=129)
        for shared, serial in zip(together.transfers, alone.transfers, strict=True):
            fine = random(serial.fine)
            found = shared.halfway(shared.fine.halo(lines(shared.fine, fine)), offset)
            expected = serial.halfway(serial.fine.halo(fine), offset)
            np.testing.assert_array_equal(whole(shared.coarse, found), expected)

    def test_partitioned_ones_too(self, pair):
        together, alone = pair(nodes=65)
        shared, serial = together.transfers[0], alone.transfers[0]
        status = mixed_status(serial.fine)
        coarse_status = serial.inject(status)
        expected, partitioned = PartitionedTransfer(serial), PartitionedTransfer(shared)
        kinds = [(each, rows_of(each)) for each in (coarse_status, status)]
        expected.partition(*kinds)
        mine = zip((shared.coarse, shared.fine), kinds, strict=True)
        partitioned.partition(*([lines(grid, each) for each in kind] for grid, kind in mine))
        fine, coarse = random(serial.fine, 3), random(serial.coarse, 4)
        restricted = whole(shared.coarse, partitioned.restrict(lines(shared.fine, fine)))
        prolonged = whole(shared.fine, partitioned.prolong(lines(shared.coarse, coarse)))
        np.testing.assert_allclose(restricted, expected.restrict(fine), rtol=0.0, atol=1e-13)
        np.testing.assert_allclose(prolonged, expected.prolong(coarse), rtol=0.0, atol=1e-13)


def test_zones_of_cliffs_equal_the_serial_ones(pair):
    """Around a cliff that goes through all lines."""
    both, offsets = [], np.array([(0, 0), (0, -2), (0, -1), (0, 1), (-1, 0), (1, 0)])
    K = 1.0 / (1.0 + np.add.outer(np.arange(6), np.arange(8)))
    for hierarchy in pair():
        grid = hierarchy.grids[-1]
        A, B = (np.stack([lines(grid, random(grid, 10 * k + n)) for k in range(6)]) for n in (0, 1))
        masks = [lines(grid, random(grid, 2 + k) > limit) for k, limit in enumerate((2.0, 0.0, -2.0))]
        found, distributive, free = masks
        found[:, 7] = True
        zone = CliffZone(grid, K, 0.25)
        zone.gather(found, Linearisation(offsets, A, B, None), distributive, free)
        zone.factor()
        r, w = (lines(grid, random(grid, 70 + k)) for k in (0, 1))
        zone.solve(r, w, 1.2)
        both.append(whole(grid, w) if grid.comm.size > 1 else w)
    np.testing.assert_allclose(*both, rtol=1e-9, atol=1e-9)
    assert np.any(both[0] != random(hierarchy.grids[-1], 71))


def test_the_border_is_known_to_every_rank(pair, make_vec):
    together, _ = pair(nodes=65)
    grid = together.grids[-1]
    space, values = BorderedSpace(grid), random(grid)
    vec = make_vec(space, lines(grid, values), 2.5)
    assert vec.getSize() == grid.mesh.nodes + 1
    P, border = space.read(vec)
    np.testing.assert_array_equal(P, lines(grid, values))
    assert border == 2.5


CASES = {"film": (1.0, "film"), "contact": (5e-6, "contact")}


class TestSolutions:
    @pytest.mark.parametrize("nodes", [65, 129])
    @pytest.mark.parametrize("case", CASES)
    def test_they_equal_the_serial_ones(self, solve, paper_contact, case, nodes):
        """From 129 nodes on the fluid of a contact start is guessed from coarser grids."""
        speed, start = CASES[case]
        together = solve(paper_contact(speed), nodes, start, comm=COMM)
        alone = solve(paper_contact(speed), nodes, start)
        grid, state = together.problem.grid, together.outcome.state
        assert together.outcome.converged and alone.outcome.converged
        expected = alone.outcome.state
        np.testing.assert_array_equal(whole(grid, state.status), expected.status)
        H, scale = whole(grid, state.H), np.max(np.abs(expected.H))
        np.testing.assert_allclose(H, expected.H, rtol=0.0, atol=1e-9 * scale)
        np.testing.assert_allclose(whole(grid, state.P), expected.P, rtol=0.0, atol=1e-8)
        if case == "film":
            for film, expected_film in zip(together.films, alone.films, strict=True):
                assert film == pytest.approx(expected_film, rel=1e-9)
        # The verification says the same on every rank, and the same as on one.
        problem = together.problem
        inequality = check_pressure_inequality(problem, state)
        serial = check_pressure_inequality(alone.problem, expected)
        assert (inequality.checked, inequality.violations) == (serial.checked, serial.violations)
        assert complementarity_error(problem, state, problem.evaluate(state)) < 1e-7
        assert flux_imbalance(problem, problem.evaluate(state)) < 1e-7
        assert len(together.told) == len(alone.told)

    def test_every_rank_is_told_the_same(self, solve, paper_contact):
        solution = solve(paper_contact(), 65, comm=COMM)
        told = [(level.nodes, cycle.step, cycle.residual, cycle.central) for level, cycle in solution.told]
        assert all(each == told for each in COMM.allgather(told))

    def test_a_violation_is_listed_on_every_rank(self, pair, paper_contact):
        together, alone = (problem_of(each, paper_contact()) for each in pair(nodes=65))
        grid = together.grid
        status, P = mixed_status(alone.grid), np.zeros((65, 65))
        P[status == CONTACT] = 0.5
        j = grid.starts[1] if COMM.size > 1 else 32  # the first line of the second rank
        j = int(COMM.bcast(j))
        i = int(np.flatnonzero(status[j] == CONTACT)[0])
        P[j, i - 1] = 0.75
        H = np.ones((65, 65))
        mine = State(lines(grid, P), 0.0, lines(grid, H), lines(grid, status))
        result = check_pressure_inequality(together, mine)
        assert (i + 1, j + 1) in {(each.i, each.j) for each in result.violations}
        assert all(each == result.violations for each in COMM.allgather(result.violations))
        serial = check_pressure_inequality(alone, State(P, 0.0, H, status))
        assert sorted((v.i, v.j, v.size) for v in serial.violations) == sorted(
            (v.i, v.j, v.size) for v in result.violations
        )


class TestMotionAtAnAngle:
    @pytest.mark.parametrize(
        "couette, mean", [("2B", "arithmetic"), ("3B", "linear-gap"), ("S2B-v", "logarithmic")]
    )
    def test_inflow_and_sources_are_the_serial_ones(self, pair, paper_contact, couette, mean):
        """Two lines upstream may be another rank's."""
        found, hierarchies = [], pair(nodes=65)
        status = mixed_status(hierarchies[1].grids[-1])
        for hierarchy in hierarchies:
            problem = problem_of(hierarchy, paper_contact(), Scheme(couette, mean, motion=(0.6, 0.8)))
            grid = problem.grid
            fields = (0.1 * np.abs(random(grid, 1)), 0.1 + 0.1 * np.abs(random(grid, 2)), status)
            P, H, mine = (lines(grid, each) for each in fields)
            evaluation = problem.evaluate(State(P, 0.0, H, mine))
            found.append([whole(grid, each) for each in (evaluation.inflow, evaluation.source)])
        for together, alone in zip(*found, strict=True):
            np.testing.assert_allclose(together, alone, rtol=1e-13, atol=1e-13)


class TestTimeSteps:
    def test_a_node_beside_another_rank_s_line_has_the_same(self, pair, paper_contact):
        """By the harmonic mean they ask for the neighbours' pressure."""
        settings, contact = NewtonSettings().squeezed(), paper_contact()
        found = []
        for hierarchy in pair(nodes=65):
            problem = problem_of(hierarchy, contact, Scheme(face_mobility="harmonic"))
            grid = problem.grid
            P, F = (lines(grid, random(grid, seed)) for seed in (1, 2))
            state = State(0.1 * np.abs(P), 0.0, 0.5 + 0.0 * P, np.full(grid.shape, LUBRICATED))
            now, rows = problem.evaluate(state), problem.rows(state.status)
            found.append(whole(grid, squeeze_rates(problem, now, rows, 1e-4 * F, settings)))
        shared = settings.squeeze * problem.rms(1e-4 * F) / grid.mesh.dX
        assert (found[1] > 10.0 * shared).any()
        np.testing.assert_allclose(*found, rtol=1e-10)


class TestRelaxation:
    """All lines are relaxed at once, so that it does not matter which rank has them."""

    @pytest.mark.parametrize("case", CASES)
    @pytest.mark.parametrize("update", ["line", "point"])
    def test_a_few_sweeps_equal_the_serial_ones(self, pair, paper_contact, case, update):
        speed, start = CASES[case]
        contact = paper_contact(speed)
        settings = SolverSettings(
            method="relaxation",
            nested=NestedSettings(start=start),
            relaxation=RelaxationSettings(
                fluid_update=update, contact_update=update, omega=0.2, max_sweeps=6, report_every=3
            ),
        )
        told = ([], [])
        solved = [
            single_loop(hierarchy, contact, settings, lambda _, sweep, rows=rows: rows.append(sweep))
            for hierarchy, rows in zip(pair(nodes=65), told, strict=True)
        ]
        (problem, together), (_, alone) = solved
        grid, state, expected = problem.grid, together.state, alone.state
        np.testing.assert_array_equal(whole(grid, state.status), expected.status)
        # A convolution differs by rounding, which the mobility at 0.005 mm/s magnifies.
        digits = 1e-12 if case == "film" else 1e-9
        np.testing.assert_allclose(whole(grid, state.P), expected.P, rtol=0.0, atol=digits)
        np.testing.assert_allclose(whole(grid, state.H), expected.H, rtol=0.0, atol=digits)
        assert state.H0 == pytest.approx(expected.H0, rel=digits)
        for one, other in zip(*told, strict=True):
            assert vars(one) == pytest.approx(vars(other), rel=1e-8, abs=digits)
        assert all(each == told[0] for each in COMM.allgather(told[0]))

    def test_a_rank_without_lines_takes_part(self, pair, paper_contact):
        """Five lines are one rank's."""
        settings = SolverSettings(
            method="relaxation", relaxation=RelaxationSettings(max_sweeps=3, report_every=1)
        )
        (problem, together), (_, alone) = (
            single_loop(hierarchy, paper_contact(), settings, lambda *_: None)
            for hierarchy in pair(nodes=5, coarsest=5)
        )
        np.testing.assert_allclose(
            whole(problem.grid, together.state.P), alone.state.P, rtol=0.0, atol=1e-12
        )
        assert COMM.allgather(together.state.H0) == [together.state.H0] * COMM.size


WEDGES = {
    "blocked exit": wedge_case("blocked exit", 65),
    "square pillar, turned, 2B": wedge_case("square pillar", 65, "2B", turned=True),
    "cylindrical pillar, untreated": wedge_case("cylindrical pillar", 65, interface="untreated"),
    "square pillar, cavitating": merged(
        wedge_case("square pillar", 65), {"discretization": {"cavitation": True}}
    ),
    "pocket": pocket_case(65, size="small"),
}


class TestOtherKinds:
    @pytest.mark.parametrize("tables", WEDGES.values(), ids=WEDGES)
    def test_wedge(self, tables):
        config = config_from_tables(tables)
        together, alone = solve_config(config, COMM), solve_config(config, MPI.COMM_SELF)
        assert together.result.converged and alone.result.converged
        assert (together.fields is None) == (COMM.rank != 0)
        whole = COMM.bcast(together.fields)
        np.testing.assert_array_equal(whole.status, alone.fields.status)
        np.testing.assert_allclose(whole.P, alone.fields.P, rtol=0.0, atol=1e-12)
        result, expected = together.result, alone.result
        assert result.ranks == COMM.size
        assert result.load == pytest.approx(expected.load, rel=1e-11)
        assert result.residual <= 1e-10 and result.flux_imbalance <= 1e-12
        assert result.closed_face_flow == pytest.approx(expected.closed_face_flow, rel=1e-12)
        assert result.solid_nodes == expected.solid_nodes
        assert result.cavitated_nodes == expected.cavitated_nodes
        assert all(each == result.load for each in COMM.allgather(result.load))

    @pytest.mark.parametrize("start, speed", [("film", 0.1), ("contact", 1e-4)])
    def test_line_belongs_to_one_rank_which_tells_the_others(self, start, speed):
        tables = {
            "contact": {"kind": "line", "load_per_length": 1859e3},
            "motion": {"speed": speed},
            "grid": {"nodes": 257, "x": [-2.5, 1.5]},
            "solver": {"start": start},
        }
        config = config_from_tables(tables)
        together, alone = solve_config(config, COMM), solve_config(config, MPI.COMM_SELF)
        assert together.result.converged
        assert (together.fields is None) == (COMM.rank > 0)
        if COMM.rank == 0:
            np.testing.assert_allclose(together.fields.P, alone.fields.P, rtol=0.0, atol=1e-10)
            np.testing.assert_array_equal(together.fields.status, alone.fields.status)
        assert COMM.bcast(together.result) == together.result
        assert together.contact.speed == speed
        assert together.result.work == COMM.bcast(alone.result.work)
        film = COMM.bcast(alone.result.central_film_nm)
        assert together.result.central_film_nm == pytest.approx(film, rel=1e-9, abs=1e-5)

    def test_film_whose_coarse_grids_are_visited_twice(self):
        tables = {"motion": {"speed": 8.0}, "grid": papers_grid(129)}
        config = config_from_tables(merged(tables, {"solver": {"error": False}}))
        together, alone = solve_config(config, COMM), solve_config(config, MPI.COMM_SELF)
        assert alone.contact.inlet_cells(alone.mesh) > 2 * RESOLVED_CELLS
        assert together.result.converged and alone.result.converged
        np.testing.assert_allclose(COMM.bcast(together.fields).P, alone.fields.P, rtol=0.0, atol=1e-9)
        assert together.result.central_film_nm == pytest.approx(alone.result.central_film_nm, rel=1e-9)
        assert together.result.work == alone.result.work

    def test_unified_equations(self):
        tables = {
            "motion": {"speed": 1.0},
            "grid": papers_grid(65),
            "discretization": {"contact_model": "unified"},
        }
        config = config_from_tables(tables)
        together, alone = solve_config(config, COMM), solve_config(config, MPI.COMM_SELF)
        assert together.result.converged
        assert together.result.overlap.nodes == alone.result.overlap.nodes
        assert together.result.central_film_nm == pytest.approx(alone.result.central_film_nm, rel=1e-9)


LAWS = CONFIGS / "my_laws.py"
OWN = {
    "coated": {
        "contact": {"deformation": "coated"},
        "coating": {"modulus": 50e9, "thickness": 40e-6},
        "grid": {"nodes": 65, "x": [-2.2, 1.6]},
    },
    "functions": {
        "contact": {"load": 20.0, "surface": f"{LAWS}:waves"},
        "lubricant": {"viscosity_law": f"{LAWS}:doolittle", "density_law": f"{LAWS}:tait"},
        "grid": {"nodes": 65, "x": [-2.5, 1.5]},
    },
    "surfaces": {  # whose waves coarse grids cannot show: one filtered exactly, one by samples
        "surface": {"kind": "self-affine", "rms": 2e-8, "shortest_wavelength": 6e-5,
                    "longest_wavelength": 3e-4},
        "second_surface": {"kind": "dent", "amplitude": 5e-8, "width": 8e-5, "x": 3e-5},
        "grid": {"nodes": 129, "x": [-2.5, 1.5]},
    },
}  # fmt: skip


class TestOwnFunctionsAndCoatings:
    @pytest.mark.parametrize("tables", OWN.values(), ids=OWN)
    def test_they_equal_the_serial_ones(self, tables):
        config = config_from_tables(merged({"motion": {"speed": 3.0}}, tables))
        together, alone = solve_config(config, COMM), solve_config(config, MPI.COMM_SELF)
        assert together.result.converged and alone.result.converged
        fields, expected = COMM.bcast(together.fields), alone.fields
        np.testing.assert_array_equal(fields.status, expected.status)
        np.testing.assert_allclose(fields.P, expected.P, rtol=0.0, atol=1e-8)
        scale = np.abs(expected.H).max()
        np.testing.assert_allclose(fields.H, expected.H, rtol=0.0, atol=1e-9 * scale)
        assert together.result.work.steps == alone.result.work.steps


class TestBranches:
    """A film followed in speed, and full contact, with their points on disk."""

    def test_they_equal_the_serial_ones_and_are_read_again(self, tmp_path):
        shared = Path(COMM.bcast(str(tmp_path)))
        together = self.walk(COMM, shared)
        again = self.walk(COMM, shared)
        alone = self.walk(MPI.COMM_SELF, tmp_path / "alone")
        for point, copy, serial in zip(together, again, alone, strict=True):
            assert point.origin == serial.origin and point.result.settled
            assert point.result.contact.nodes == serial.result.contact.nodes
            assert point.result.central_film_nm == pytest.approx(serial.result.central_film_nm, abs=1e-4)
            assert point.result.minimum_film_nm == pytest.approx(serial.result.minimum_film_nm, abs=1e-4)
            # Each rank has its own clock; what is on disk is the first one's.
            assert replace(copy.result, wall_s=0.0) == replace(point.result, wall_s=0.0)
            assert (point.fields is None) == (copy.fields is None) == (COMM.rank > 0)

    def walk(self, comm, directory):
        if comm.rank == 0:
            directory.mkdir(exist_ok=True)
        comm.barrier()
        study = Study(directory, comm, (65,), speak=False)
        with Branches(study, merged(PAPER, {"grid": papers_grid(65)})) as branches:
            return branches.walk("down", [1.0, 0.7]) + branches.walk("up", [0.005, 0.007])


class TestCheckpoints:
    """What some ranks have kept others take up."""

    FILM = {"motion": {"speed": 0.12}, "grid": papers_grid(65), "solver": {"start": "film"}}
    STEPS = 5

    @pytest.mark.parametrize("before, after", [(COMM, MPI.COMM_SELF), (MPI.COMM_SELF, COMM)])
    def test_a_run_goes_on_on_another_number_of_ranks(self, tmp_path, before, after):
        config = config_from_tables(self.FILM)
        directory = Path(COMM.bcast(str(tmp_path)))
        if before is COMM or COMM.rank == 0:
            self.stopped(config, before, directory)
        COMM.barrier()
        solution = None
        if after is COMM or COMM.rank == 0:
            solution = solve_config(config, after, Watch(directory=directory))
        alone = solve_config(config, MPI.COMM_SELF)
        same = True
        if COMM.rank == 0:
            same = (
                np.array_equal(solution.fields.status, alone.fields.status)
                and np.allclose(solution.fields.P, alone.fields.P, rtol=0.0, atol=1e-10)
                and np.allclose(solution.fields.H, alone.fields.H, rtol=0.0, atol=1e-10)
                and len(solution.rows) == len(alone.rows)
            )
        assert COMM.bcast(same)

    def stopped(self, config, comm, directory):
        """Run until the last rank of all wants to stop."""
        asked = iter(range(100))

        def stop():
            last = comm.rank == comm.size - 1
            return Stopped("enough", 143) if next(asked) == self.STEPS and last else None

        with pytest.raises(Stopped, match="enough"):
            solve_config(config, comm, Watch(directory=directory, save_every=1e9, stop=stop))
        assert (directory / "checkpoint" / "under-way.npz").exists()

    def test_arrays_come_back_on_any_number_of_ranks(self, pair, tmp_path):
        together, alone = (hierarchy.grids[-1] for hierarchy in pair(nodes=65))
        values = random(alone)
        mine = lines(together, values)
        directory, config = Path(COMM.bcast(str(tmp_path))), config_from_tables(self.FILM)
        self.kept(directory, config).finish(together, State(mine, 0.1 + 0.2, mine, mine > 0))
        back = self.kept(directory, config).recall(together, State.from_record)
        whole_state = self.kept(directory, config).recall(alone, State.from_record)
        np.testing.assert_array_equal(whole_state.P, values)
        np.testing.assert_array_equal(whole_state.status, values > 0)
        np.testing.assert_array_equal(back.P, mine)
        assert back.H0 == 0.1 + 0.2 and back.status.dtype == bool

    def kept(self, directory, config):
        """A checkpoint, its run without history."""
        progress = SimpleNamespace(record=dict, go_on=lambda record: None)
        return Checkpoint(directory, config, progress, seconds=1e9)

    def test_arrays_of_another_grid_are_refused_on_every_rank(self, pair, tmp_path):
        hierarchy, _ = pair(nodes=65, coarsest=33)
        coarse, fine = hierarchy.grids[-2:]
        directory, config = Path(COMM.bcast(str(tmp_path))), config_from_tables(self.FILM)
        P = np.zeros(coarse.shape)
        self.kept(directory, config).finish(coarse, State(P, 0.0, P, P))
        with pytest.raises(OutputError, match="P is not of 65 x 65 nodes"):
            self.kept(directory, config).recall(fine, State.from_record)

    def test_a_damaged_one_is_refused_on_every_rank(self, tmp_path):
        directory = Path(COMM.bcast(str(tmp_path)))
        config = config_from_tables(self.FILM)
        self.stopped(config, COMM, directory)
        if COMM.rank == 0:
            (directory / "checkpoint" / "under-way.npz").write_bytes(b"PK")
        COMM.barrier()
        with pytest.raises(OutputError, match="is damaged"):
            solve_config(config, COMM, Watch(directory=directory))


class TestBands:
    @pytest.mark.parametrize("couette", ["1B", "2B"])
    def test_they_do_not_depend_on_the_ranks(self, couette):
        tables = {"motion": {"speed": 3.0}, "grid": {"nodes": 65}, "discretization": {"couette": couette}}
        config = config_from_tables(tables)
        mine, alone = (solve_config(config, comm).result.error for comm in (COMM, MPI.COMM_SELF))
        assert mine.central_nm == pytest.approx(alone.central_nm, rel=1e-9)
        assert mine.minimum_nm == pytest.approx(alone.minimum_nm, rel=1e-9)
        assert mine.how == alone.how and len(mine.grids) == 2


class TestCommandLine:
    """`main` runs on all ranks of COMM_WORLD."""

    @pytest.fixture
    def directory(self, tmp_path):
        """Rank 0's temporary directory, the same on every rank."""
        return COMM.bcast(tmp_path)

    def test_bad_input_is_refused_on_every_rank_and_said_once(self, directory, capsys):
        from mgehl.cli import main

        status = main(["run", "--set", "grid.nodes=66", "--out", str(directory / "here")])
        lines = capsys.readouterr().err.splitlines()
        assert COMM.allgather(status) == [2] * COMM.size
        assert [len(each) for each in COMM.allgather(lines)] == [1] + [0] * (COMM.size - 1)
        assert not (directory / "here").exists()

    def test_a_wrong_law_is_refused_on_every_rank_and_said_once(self, directory, capsys):
        from mgehl.cli import main

        law = directory / "law.py"
        if COMM.rank == 0:
            law.write_text("def law(at): return 1.0 + 1e-10 * at.pressure, 1e-9")
        COMM.barrier()
        setting = f"lubricant.density_law={law}:law"
        status = main(["run", "--set", setting, "--out", str(directory / "here")])
        lines = capsys.readouterr().err.splitlines()
        assert COMM.allgather(status) == [2] * COMM.size
        assert [len(each) for each in COMM.allgather(lines)] == [1] + [0] * (COMM.size - 1)
        assert not (directory / "here").exists()

    def test_a_law_that_turns_nan_late_is_said_once_and_loses_nothing(self, directory, capsys):
        from mgehl.cli import main

        if COMM.rank == 0:
            (directory / "late.py").write_text(
                "import numpy as np\ncalls = 0\ndef law(at):\n    global calls\n    calls += 1\n"
                "    return (1.0 if calls < 18 else at.pressure * np.nan), 0.0\n"
            )
        COMM.barrier()
        words = ["--set", "grid.nodes=65", "--set", f"lubricant.density_law={directory}/late.py:law"]
        words += [
            "--set",
            "motion.speed=0.5",
            "--set",
            "solver.start=film",
            "--save-every",
            "1e-9",
            "--quiet",
        ]
        status = main(["run", *words, "--out", str(directory / "here")])
        said = COMM.allgather(capsys.readouterr().err)
        assert COMM.allgather(status) == [2] * COMM.size
        assert [err.count("\n") for err in said] == [1] + [0] * (COMM.size - 1)
        assert said[0].startswith("mgehl: lubricant.density_law = ") and "returns nan at" in said[0]
        assert (directory / "here" / "checkpoint" / "under-way.npz").exists()

    def test_a_directory_that_exists_is_refused_on_every_rank(self, directory, capsys):
        from mgehl.cli import main

        status = main(["run", "--set", "grid.nodes=65", "--out", str(directory)])
        lines = capsys.readouterr().err.splitlines()
        assert COMM.allgather(status) == [2] * COMM.size
        assert [len(each) for each in COMM.allgather(lines)] == [1] + [0] * (COMM.size - 1)

    @pytest.mark.parametrize("name", ["wedge_square_pillar", "line_contact"])
    def test_other_kinds_are_written_once(self, directory, capsys, name):
        from mgehl.cli import main

        here = directory / "here"
        status = main(["run", str(CONFIGS / f"{name}.toml"), "--set", "grid.nodes=257", "--out", str(here)])
        out = capsys.readouterr().out
        assert COMM.allgather(status) == [0] * COMM.size
        assert COMM.allgather(out.count("\nCONVERGED")) == [1] + [0] * (COMM.size - 1)
        assert ((here / "centerline.csv").exists()) == name.startswith("wedge")

    def test_bad_nodes_of_a_study_are_said_once(self, directory, capsys):
        from mgehl.cli import main

        status = main(["study", "schemes", "--nodes", "100", "--out", str(directory / "here")])
        lines = capsys.readouterr().err.splitlines()
        assert COMM.allgather(status) == [2] * COMM.size
        assert [len(each) for each in COMM.allgather(lines)] == [1] + [0] * (COMM.size - 1)
        assert not (directory / "here").exists()

    def test_one_directory_for_all(self, directory, capsys):
        from mgehl.cli import main

        here = directory / "here"
        arguments = ["run", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--out", str(here)]
        status = main(arguments)
        out = capsys.readouterr().out
        assert COMM.allgather(status) == [0] * COMM.size
        spoke = COMM.allgather(bool(out))
        assert spoke == [True] + [False] * (COMM.size - 1)
        names = {path.name for path in here.iterdir()}
        assert names == {"configuration.toml", "fields.h5", "history.csv", "picture.png",
                         "result.json"}  # fmt: skip
        assert f"{COMM.size} ranks" in (out if COMM.rank == 0 else f"{COMM.size} ranks")
