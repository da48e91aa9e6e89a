"""The same answers on any number of ranks. Run as `mpiexec -n 2 python -m pytest -m parallel`.

Every rank runs every test, and collective calls must be reached by all: what is compared on one
rank is sent to all before the assertion.
"""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from both import COMM, both, same_fields
from contacts import line
from mpi4py import MPI
from places import CONFIGS, RUN_FILES, names_in
from pocket_reference import case as pocket_case

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.errors import OutputError, Stopped
from mgehl.output.study_directory import StudyRecord
from mgehl.run import Watch
from mgehl.run import solve as solve_config
from mgehl.solver.inequality import check_pressure_inequality
from mgehl.solver.nested import single_loop
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.settings import SolverSettings
from mgehl.solver.task import Task
from mgehl.solver.verification import complementarity_error, flux_imbalance
from mgehl.studies.branch import Branch
from mgehl.studies.study import PAPER, Study, merged, papers_grid
from mgehl.studies.wedge import case as wedge_case

pytestmark = pytest.mark.parallel


@pytest.fixture
def pair(paper_contact, make_hierarchy):
    """Function: the same hierarchy on all ranks together, and on each by itself."""

    def make(ratio=1.0, **grid):
        contact = paper_contact(radius_y=ratio * 12.7e-3)
        return make_hierarchy(contact, comm=COMM, **grid), make_hierarchy(contact, **grid)

    return make


def lines(grid, whole):
    return np.ascontiguousarray(whole[grid.first : grid.last])


def whole(grid, array):
    return COMM.bcast(grid.gather(array))


def random(grid, seed=0):
    return np.random.default_rng(seed).standard_normal((grid.mesh.ny, grid.mesh.nx))


def mixed_status(grid):
    """A disc of contact, a cavity behind it; whole, for a grid on one rank."""
    status = np.where(grid.X**2 + grid.Y**2 < 0.49, CONTACT, LUBRICATED)
    status = np.where(grid.X > 0.9, CAVITATED, status)
    return np.where(grid.boundary(), BOUNDARY, status).astype(np.int8)


@pytest.mark.parametrize("start, speed", [("film", 1.0), ("contact", 5e-6)])
def test_cycles_over_coarse_grids_on_fewer_ranks_solve_as_on_one(solve, paper_contact, start, speed):
    how = paper_contact(speed), 33, start
    together, alone = (solve(*how, coarsest=5, comm=comm) for comm in (COMM, MPI.COMM_SELF))
    found, expected = together.outcome, alone.outcome
    assert found.converged and expected.converged
    work = [[cycle.linear_iterations for cycle in each.cycles] for each in (found, expected)]
    assert work[0] == work[1]
    H = whole(together.problem.grid, found.state.H)
    scale = np.abs(expected.state.H).max()
    np.testing.assert_allclose(H, expected.state.H, rtol=0.0, atol=1e-9 * scale)


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
        assert (inequality.checked, inequality.nodes) == (serial.checked, serial.nodes)
        assert complementarity_error(problem, state, problem.evaluate(state)) < 1e-7
        assert flux_imbalance(problem, problem.evaluate(state)) < 1e-7
        told = [(level.nodes, cycle.step, cycle.residual, cycle.central) for level, cycle in together.told]
        assert len(told) == len(alone.told) and all(each == told for each in COMM.allgather(told))

    def test_a_violation_is_listed_on_every_rank(self, make_problem):
        together, alone = make_problem(comm=COMM), make_problem()
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
        assert (i + 1, j + 1) in {(each["i"], each["j"]) for each in result.nodes}
        assert all(each == result.nodes for each in COMM.allgather(result.nodes))
        serial = check_pressure_inequality(alone, State(P, 0.0, H, status))
        assert serial.nodes == result.nodes

    def test_neighbours_on_two_ranks_change_in_turn(self, make_problem):
        """Film that is torn everywhere, somewhere by more than around it."""
        found = []
        for problem in (make_problem(comm=COMM), make_problem()):
            grid, scheme = problem.grid, replace(problem.scheme, contact_law=BoundaryFilm(1e-3))
            problem.scheme, partition = scheme, Partition(problem)
            torn = -np.abs(random(grid))
            status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
            state = State(lines(grid, torn), 0.0, np.ones(grid.shape), status)
            partition.cut_tension(state, changes := Changes(), in_turn=True)
            found.append((whole(grid, state.status), changes.total))
            np.testing.assert_array_equal(state.P == 0.0, state.status == CAVITATED)
        (status, total), (serial, expected) = found
        np.testing.assert_array_equal(status, serial)
        assert 100 < total == expected < 63**2 // 4


class TestRelaxation:
    """All lines are relaxed at once, so that it does not matter which rank has them."""

    @pytest.mark.parametrize("case", CASES)
    @pytest.mark.parametrize("update", ["line", "point"])
    def test_a_few_sweeps_equal_the_serial_ones(self, pair, paper_contact, case, update):
        speed, start = CASES[case]
        contact = paper_contact(speed)
        settings = SolverSettings(
            by_newton=False, start=start,
            relaxation=RelaxationSettings(fluid_update=update, contact_update=update, omega=0.2,
                                          max_sweeps=6),
        )  # fmt: skip
        told = ([], [])
        solved = [
            single_loop(Task(hierarchy, contact, settings, lambda _, sweep, rows=rows: rows.append(sweep)))
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


WEDGES = {
    "blocked exit": wedge_case("blocked exit", 65),
    "square pillar, turned, 2B": wedge_case("square pillar", 65, "2B", turned=True),
    "cylindrical pillar, untreated": wedge_case("cylindrical pillar", 65, interface="untreated"),
    "square pillar, cavitating": merged(
        wedge_case("square pillar", 65), {"discretization": {"cavitation": True}}
    ),
    "pocket": pocket_case(65, size="small"),
}


@pytest.mark.parametrize("tables", WEDGES.values(), ids=WEDGES)
def test_wedge(tables):
    together, alone = both(tables)
    assert (together.fields is None) == (COMM.rank != 0)
    same_fields(together, alone, P=1e-12)
    result, expected = together.result, alone.result
    assert result.ranks == COMM.size
    assert result.load == pytest.approx(expected.load, rel=1e-11)
    assert result.residual <= 1e-10 and result.flux_imbalance <= 1e-12
    assert result.closed_face_flow == pytest.approx(expected.closed_face_flow, rel=1e-12)
    assert result.solid_nodes == expected.solid_nodes
    assert result.cavitated_nodes == expected.cavitated_nodes
    assert all(each == result.load for each in COMM.allgather(result.load))


@pytest.mark.parametrize("start, speed", [("film", 0.1), ("contact", 1e-4)])
def test_line_belongs_to_one_rank_which_tells_the_others(start, speed):
    grid = {"nodes": 257, "x": [-2.5, 1.5]}
    together, alone = both(line(1859e3, speed), {"grid": grid, "solver": {"start": start}})
    assert (together.fields is None) == (COMM.rank > 0)
    same_fields(together, alone, P=1e-10)
    assert COMM.bcast(together.result) == together.result
    assert together.contact.speed == speed
    assert together.result.work == COMM.bcast(alone.result.work)
    film = COMM.bcast(alone.result.central_film_nm)
    assert together.result.central_film_nm == pytest.approx(film, rel=1e-9, abs=1e-5)


LAWS = CONFIGS / "my_laws.py"
ANGLES = (30.0, 110.0)
"""In the user's axes, and in others."""
WIDE = {"contact": {"radius_y": 25.4e-3}, "grid": {"nodes": 65, "x": [-1.9, 1.7], "y": [-1.8, 1.9]}}
DRY = PAPER | {"grid": papers_grid(129), "solver": {"start": "contact"}}
DENT = {
    "contact": {"load": 15.0, "radius_x": 0.0125, "radius_y": 0.0125, "reduced_modulus": 110e9},
    "lubricant": {"viscosity": 0.25, "viscosity_law": "roelands", "pressure_viscosity": 22e-9},
    "grid": {"nodes": 65, "x": [-3.0, 2.0], "y": [-2.5, 2.5]}, "solver": {"start": "film", "error": False},
    "surface": {"kind": "dent", "amplitude": 100e-9, "width": 60e-6, "body": "body_1", "x": -100e-6},
    "time": {"end": 2e-4, "tolerance": 1e-7},
}  # fmt: skip
"""Passes, solved to the last digits: a step may leave as much as its tolerance says, by other digits."""
SAME = {
    "unified": {
        "grid": papers_grid(65), "discretization": {"contact_model": "unified"}, "motion": {"speed": 1.0},
    },
    **{f"film at {a}": merged(WIDE, {"motion": {"speed": 1.0, "angle": a}}) for a in ANGLES},
    **{f"contact at {a}": merged(DRY, {"motion": {"speed": 5e-6, "angle": a}}) for a in ANGLES},
    **{f"dent at {a}": merged(DENT, {"motion": {"speed": 0.09, "angle": a}}) for a in (0.0, 25.0)},
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


@pytest.mark.parametrize("tables", SAME.values(), ids=SAME)
def test_fields_equal_the_serial_ones(tables):
    together, alone = both({"motion": {"speed": 3.0}}, tables)
    digits = {"P": 1e-6, "H": 1e-8} if "time" in tables else {}
    same_fields(together, alone, **digits)
    result, expected = together.result, alone.result
    assert len(together.rows) == len(alone.rows) > 3
    assert result.contact.x_nodes == expected.contact.x_nodes
    assert result.work.steps == expected.work.steps or "time" in tables


def test_bands_of_a_run_in_time_equal_the_serial_ones():
    wide = merged(DENT, {"solver": {"error": True}, "surface": {"width": 12e-5}, "time": {"end": 1e-4}})
    together, alone = both({"motion": {"speed": 0.09}}, wide)
    bands = [each.result.time.error.at_the_end for each in (together, alone)]
    assert bands[0] == pytest.approx(COMM.bcast(bands[1]), rel=1e-3) and bands[0]["mean_gap_nm"] > 0.0


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
        study = Study(directory, comm, StudyRecord("transition", (), comm.size, {}), speak=False)
        tables = merged(PAPER, {"grid": papers_grid(65)})
        ways = {"down": [1.0, 0.7], "up": [0.005, 0.007]}
        return [point for name, way in ways.items() for point in Branch(study, tables, name).walk(way)]


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
        solution = SimpleNamespace(fields=None, rows=None)
        if after is COMM or COMM.rank == 0:
            solution = solve_config(config, after, Watch(directory=directory))
        alone = solve_config(config, MPI.COMM_SELF)
        same_fields(solution, alone, P=1e-10, H=5e-11)
        assert COMM.bcast(solution.rows and len(solution.rows)) == len(alone.rows)

    def stopped(self, config, comm, directory):
        asked = iter(range(100))

        def stop():
            last = comm.rank == comm.size - 1
            return Stopped("enough", 143) if next(asked) == self.STEPS and last else None

        with pytest.raises(Stopped, match="enough"):
            solve_config(config, comm, Watch(directory=directory, save_every=1e9, stop=stop))
        assert (directory / "checkpoint" / "under-way.npz").exists()

    def test_a_damaged_one_is_refused_on_every_rank(self, tmp_path):
        directory = Path(COMM.bcast(str(tmp_path)))
        config = config_from_tables(self.FILM)
        self.stopped(config, COMM, directory)
        if COMM.rank == 0:
            (directory / "checkpoint" / "under-way.npz").write_bytes(b"PK")
        COMM.barrier()
        with pytest.raises(OutputError, match="is damaged"):
            solve_config(config, COMM, Watch(directory=directory))


@pytest.mark.parametrize("couette", ["1B", "2B"])
def test_bands_do_not_depend_on_the_ranks(couette):
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
        return COMM.bcast(tmp_path)

    def test_a_law_that_turns_nan_late_is_said_once_and_loses_nothing(self, directory, capsys):
        if COMM.rank == 0:
            (directory / "late.py").write_text(
                "import numpy as np\ncalls = 0\ndef law(at):\n    global calls\n    calls += 1\n"
                "    return (1.0 if calls < 18 else at.pressure * np.nan), 0.0\n"
            )
        COMM.barrier()
        keys = "grid.nodes=65", f"lubricant.density_law={directory}/late.py:law"
        words = [f"--set={each}" for each in (*keys, "motion.speed=0.5", "solver.start=film")]
        status = main(["run", *words, "--save-every=1e-9", "--quiet", "--out", str(directory / "here")])
        said = COMM.allgather(capsys.readouterr().err)
        assert COMM.allgather(status) == [2] * COMM.size
        assert [err.count("\n") for err in said] == [1] + [0] * (COMM.size - 1)
        assert said[0].startswith("mgehl: lubricant.density_law = ") and "returns nan at" in said[0]
        assert (directory / "here" / "checkpoint" / "under-way.npz").exists()

    def test_one_directory_for_all(self, directory, capsys):
        here = directory / "here"
        arguments = ["run", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--out", str(here)]
        status = main(arguments)
        out = capsys.readouterr().out
        assert COMM.allgather(status) == [0] * COMM.size
        spoke = COMM.allgather(bool(out))
        assert spoke == [True] + [False] * (COMM.size - 1)
        assert names_in(here) == RUN_FILES
        assert f"{COMM.size} ranks" in (out if COMM.rank == 0 else f"{COMM.size} ranks")
