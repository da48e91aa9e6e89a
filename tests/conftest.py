"""Fixtures that tests share: the paper's contact, grids that are destroyed, clean PETSc options.

PETSc and MPI are imported inside the fixtures that need them, so that the tests of the lower
layers run without.
"""

import os
import signal
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass

import pytest
from told import status_of

from mgehl.discretization.mesh import Mesh
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.model.point import PointContact

BODY = {"radius_x": 12.7e-3, "radius_y": 12.7e-3, "reduced_modulus": 219.78e9}
DOMAIN = {"x": (-1.9, 1.3), "y": (-1.5, 1.5)}
VISCOSITY = Barus(0.096, 18.2e-9)

LONGEST = (
    "test_time.py", "test_resume.py", "test_readme.py", "test_help.py", "test_sweep.py",
    "test_many_ranks.py", "test_hypothesis.py", "test_branch.py", "test_stored.py", "test_cli.py",
    "test_bands_of_studies.py", "test_rough_machines.py", "test_run_command.py", "test_checkpoint.py",
)  # fmt: skip
"""Files that take longest. They begin first: else one process would be left alone with one at the end."""


def pytest_configure(config):
    """Ctrl-C is heard, also where a shell that started the tests in the background ignores it. MPI's files
    have a directory for each process that tests.

    Open MPI's jobs share one directory, and a job that ends may remove it under another that begins. Newer
    pytest-xdist would begin with the files of most tests, not with the `LONGEST`.
    """
    config.option.loadscopereorder = False
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    files = tempfile.TemporaryDirectory(prefix="mpi-")
    os.environ["OMPI_MCA_orte_tmpdir_base"] = files.name
    config.add_cleanup(files.cleanup)


def pytest_collection_modifyitems(items):
    """The longest files first, all others in their order."""
    place = {name: number for number, name in enumerate(LONGEST)}
    items.sort(key=lambda item: place.get(item.path.name, len(LONGEST)))


@pytest.fixture
def paper_contact():
    def make(speed=1.0, **changes):
        parameters = {"load": 800.0, **BODY, "lubricant": Lubricant(VISCOSITY, DowsonHigginson())}
        return PointContact(speed=speed, **(parameters | changes))

    return make


@pytest.fixture
def in_the_end():
    """Function (end, made): calls `end(made)` after the test, for the last one first; returns `made`."""
    with ExitStack() as stack:

        def kept(end, made):
            stack.callback(end, made)
            return made

        yield kept


@pytest.fixture
def make_grid(in_the_end):
    """Factory of the grid of a mesh; destroyed after the test."""
    from mpi4py import MPI

    from mgehl.grid.grid import Grid, single_grid

    return lambda mesh, comm=MPI.COMM_SELF: in_the_end(Grid.destroy, single_grid(mesh, comm))


@pytest.fixture
def make_hierarchy(in_the_end):
    """Factory of grid hierarchies; all of them are destroyed after the test.

    The communicator is COMM_SELF unless another is given: every rank has a grid of its own.
    """
    from mpi4py import MPI

    from mgehl.grid.hierarchy import Hierarchy

    def make(contact, nodes=65, coarsest=33, comm=MPI.COMM_SELF, x=DOMAIN["x"], y=DOMAIN["y"], ny=None):
        mesh = Mesh(nodes, ny or nodes, x, y, contact.k_e)
        return in_the_end(Hierarchy.destroy, Hierarchy(mesh, coarsest, contact.kernel, comm))

    return make


@pytest.fixture
def make_problem(paper_contact, make_hierarchy):
    from mgehl.discretization.scheme import Scheme
    from mgehl.solver.problem import ContactProblem

    def make(contact=None, scheme=None, **grid):
        contact = contact or paper_contact()
        hierarchy = make_hierarchy(contact, **grid)
        scheme = scheme or Scheme()
        return ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)

    return make


@pytest.fixture
def tiny_problem(make_problem):
    """The paper's contact at 1 m/s on 9 x 9 nodes: small enough for states made by hand."""
    return make_problem(nodes=9)


@pytest.fixture
def usual_law():
    """Function: a contact's interface conditions with the configuration's default H_th, 0.02 nm."""
    from mgehl.discretization.contact_law import InterfaceConditions

    return lambda contact: InterfaceConditions(0.02e-9 / contact.film_scale)


@pytest.fixture
def empty_directory(tmp_path, monkeypatch):
    """The working directory of a test."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def refused(capsys):
    """Function: the one line with which a command line is refused, and nothing else is said."""

    def line(*words):
        status, (out, err) = status_of(*words), capsys.readouterr()
        assert (status, out, err.count("\n")) == (2, "", 1) and err.startswith("mgehl: "), err
        assert err[:-1].isprintable()
        return err[:-1]

    return line


@dataclass
class Solution:
    """A nested iteration that was run, with what it told its monitor."""

    hierarchy: object
    problem: object
    outcome: object
    told: list

    @property
    def films(self):
        nm = 1e9 * self.problem.contact.film_scale
        return tuple(film * nm for film in self.problem.films(self.outcome.state))

    @property
    def finest_steps(self):
        return self.outcome.cycles[-1].step


@pytest.fixture
def solve(make_hierarchy, usual_law):
    from mgehl.discretization.scheme import Scheme
    from mgehl.solver.nested import nested_iteration
    from mgehl.solver.settings import NewtonSettings, SolverSettings
    from mgehl.solver.task import Task

    def run(contact, nodes, start="film", couette="1B", newton=None, mean="arithmetic", **grid):
        settings = SolverSettings(
            scheme=Scheme(couette, mean, contact_law=usual_law(contact)),
            start=start,
            newton=NewtonSettings(**(newton or {})),
        )
        hierarchy, told = make_hierarchy(contact, nodes, **grid), []
        task = Task(hierarchy, contact, settings, lambda *each: told.append(each))
        problem, outcome = nested_iteration(task)
        return Solution(hierarchy, problem, outcome, told)

    return run


@pytest.fixture(autouse=True)
def clean_petsc_options():
    """No PETSc option outlives the test that set it."""
    before = _all_options()
    yield
    after = _all_options()
    for name in after.keys() - before.keys():
        _database().delValue(name)
    for name, value in before.items():
        if after.get(name) != value:
            _database().setValue(name, value)


def _all_options():
    return dict(_database().getAll()) if "petsc4py.PETSc" in sys.modules else {}


def _database():
    return sys.modules["petsc4py.PETSc"].Options()


@pytest.fixture
def rough_state():
    """Function that makes a state of a problem far from any solution, with a gap everywhere.

    Random pressures on a parabola; with `contact` a disc of contact and a cavity behind it.
    """
    import numpy as np

    from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED

    def make(problem, contact=False):
        grid = problem.grid
        status = np.full(grid.shape, LUBRICATED)
        if contact:
            status = np.where(grid.X**2 + grid.Y**2 < 0.25, CONTACT, status)
            status = np.where(grid.X + 0.2 * grid.Y**2 > 0.9, CAVITATED, status)
        dome = np.maximum(0.7 - 0.3 * (grid.X**2 + grid.Y**2), 0.0)
        P = dome + 0.02 * np.random.default_rng(5).random(grid.shape)
        P = np.where(problem.boundary | (status == CAVITATED), 0.0, P)
        H0 = 0.02 - float(problem.gap(P, 0.0).min())
        return problem.state(P, H0, status)

    return make


@pytest.fixture
def make_multigrid(in_the_end):
    """Factory of `MultigridSolver`s linearised about a state, by its rows or others; freed in the end."""
    from mgehl.multigrid.cycle import CycleSettings, MultigridSolver

    def make(hierarchy, problem, state, rows=None, **settings):
        level = hierarchy.grids.index(problem.grid)
        how = problem.contact, problem.scheme, CycleSettings(**settings)
        multigrid = in_the_end(MultigridSolver.free, MultigridSolver(hierarchy, level, *how))
        rows = problem.rows(state.status) if rows is None else rows
        multigrid.linearise(problem.evaluate(state), rows)
        return multigrid

    return make


@pytest.fixture
def make_jacobian(in_the_end):
    """Factory of the `Jacobian` of a problem about a state; its Mat is destroyed after the test."""
    from mgehl.multigrid.jacobian import Jacobian

    def make(problem, state):
        jacobian = Jacobian(problem.grid, problem.deflection, problem.contact, problem.scheme)
        in_the_end(lambda each: each.mat.destroy(), jacobian)
        jacobian.linearise(problem.evaluate(state), problem.rows(state.status))
        return jacobian

    return make


@pytest.fixture
def make_vec(in_the_end):
    """Factory of vectors of a `BorderedSpace`, filled if values are given; destroyed after the test."""

    def make(space, P=None, border=0.0):
        vec = in_the_end(lambda each: each.destroy(), space.create_vec())
        vec.set(0.0)
        if P is not None:
            space.write(vec, P, border)
        return vec

    return make
