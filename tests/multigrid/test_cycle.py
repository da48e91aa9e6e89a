"""The cycle as a solver and as the preconditioner of flexible GMRES."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

import mgehl
from mgehl.discretization.rows import rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.multigrid.coarse import dense_influence
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.multigrid.stencil_matrix import stencil_rows
from mgehl.solver.problem import ContactProblem

SIZES = (65, 129)


@pytest.fixture
def make_ksp():
    """Factory of KSPs that use a `MultigridSolver`; destroyed after the test."""
    made = []

    def make(multigrid, rtol=1e-2):
        ksp = PETSc.KSP().create(MPI.COMM_SELF)
        made.append(ksp)
        ksp.setOptionsPrefix("test_")
        multigrid.configure(ksp, rtol)
        return ksp

    yield make
    for ksp in made:
        ksp.destroy()


@pytest.fixture
def film(solve, paper_contact, make_multigrid):
    """Function: the film problem at 1 m/s linearised about its solution, on n nodes."""

    def make(nodes, **settings):
        solution = solve(paper_contact(), nodes)
        state = solution.outcome.state
        return make_multigrid(solution.hierarchy, solution.problem, state, **settings), state

    return make


def right_hand_side(kind, multigrid, state, where=None):
    """Residuals of the film nodes: white noise, or one long bulge; and a load error."""
    where = state.status == LUBRICATED if where is None else where
    grid = multigrid.space.grid
    if kind == "noise":
        r = np.random.default_rng(11).standard_normal(grid.shape)
    else:
        r = np.exp(-(grid.X**2) - grid.Y**2)
    return np.where(where, r, 0.0), 0.3


def richardson(multigrid, ksp, make_vec, b, cycles):
    """Residual norms of x += (cycle) (b - J x) from x = 0."""
    x, r, correction = (make_vec(multigrid.space) for _ in range(3))
    mat = multigrid.jacobian.mat
    norms = []
    for _ in range(cycles):
        mat.mult(x, r)
        r.aypx(-1.0, b)
        norms.append(r.norm())
        # One cycle: the preconditioner alone.
        ksp.getPC().apply(r, correction)
        x.axpy(1.0, correction)
    return np.array(norms)


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_stationary_convergence(film, make_ksp, make_vec, nodes, kind):
    """A cycle with two relaxations by itself takes at least half of the residual away."""
    multigrid, state = film(nodes, sweeps=2)
    ksp = make_ksp(multigrid)
    ksp.setUp()
    b = make_vec(multigrid.space, *right_hand_side(kind, multigrid, state))
    norms = richardson(multigrid, ksp, make_vec, b, 13)
    factor = (norms[-1] / norms[4]) ** (1 / 8)
    assert factor < 0.5


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_gmres_iterations(film, make_ksp, make_vec, nodes, kind):
    multigrid, state = film(nodes)
    ksp = make_ksp(multigrid)
    b, x, r = (make_vec(multigrid.space) for _ in range(3))
    multigrid.space.write(b, *right_hand_side(kind, multigrid, state))
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() <= 6
    # GMRES says so; the true residual must too.
    multigrid.jacobian.mat.mult(x, r)
    r.aypx(-1.0, b)
    assert r.norm() <= 1.01e-2 * b.norm()


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize(
    "mean, coarse, most",
    [
        ("logarithmic", "arithmetic", 7),
        ("linear-gap", "arithmetic", 8),
        ("geometric", "arithmetic", 8),
        ("harmonic", "arithmetic", 72),
    ],
)
def test_gmres_iterations_by_other_means(
    solve, paper_contact, make_ksp, make_vec, kind, mean, coarse, most
):
    """Coarse grids take no folding mean: by their own, 8 and 34 iterations for the noise."""
    contact = paper_contact(1.0)
    solution = solve(contact, 129)
    hierarchy, state = solution.hierarchy, solution.outcome.state
    multigrid = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, Scheme(face_mobility=mean))
    ksp = make_ksp(multigrid)
    problem = ContactProblem(
        hierarchy.grids[-1], hierarchy.deflections[-1], contact, multigrid.jacobian.scheme
    )
    multigrid.linearise(problem.evaluate(state), problem.rows(state.status))
    assert [jacobian.scheme.face_mobility for jacobian in multigrid.jacobians[:-1]] == [coarse] * 2
    b, x = make_vec(multigrid.space, *right_hand_side(kind, multigrid, state)), make_vec(multigrid.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() <= most


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_gmres_iterations_in_contact(solve, paper_contact, make_multigrid, make_ksp, make_vec, nodes, kind):
    """Full contact at 0.005 mm/s; the fluid around it is solved apart and given here."""
    solution = solve(paper_contact(5e-6), nodes, start="contact")
    state = solution.outcome.state
    contact = state.status == CONTACT
    assert contact.sum() > 1000
    frozen = rows_of(state.status, frozen=state.status == LUBRICATED)
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state, rows=frozen)
    ksp = make_ksp(multigrid)
    r, load = right_hand_side(kind, multigrid, state, contact)
    b, x = make_vec(multigrid.space, r, load), make_vec(multigrid.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() <= 6


def test_rigid_gap_makes_no_convolution(solve, make_multigrid, paper_contact, make_ksp, make_vec):
    solution = solve(paper_contact(), 65)
    state = solution.outcome.state
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state, rigid=True)
    ksp = make_ksp(multigrid)
    before = solution.hierarchy.convolutions
    b, x = make_vec(multigrid.space), make_vec(multigrid.space)
    multigrid.space.write(b, *right_hand_side("bulge", multigrid, state))
    ksp.solve(b, x)
    assert solution.hierarchy.convolutions == before
    assert ksp.getConvergedReason() > 0


def test_an_iteration_convolves_once_on_every_grid(film, make_ksp, make_vec):
    """The product of GMRES on the finest; on a coarser one, what its correction deflects."""
    multigrid, state = film(129)
    ksp = make_ksp(multigrid, rtol=1e-6)
    before = [jacobian.deflection.count for jacobian in multigrid.jacobians]
    iterations = solve_linear(multigrid, ksp, make_vec, "bulge", state)
    counted = [j.deflection.count - b for j, b in zip(multigrid.jacobians, before, strict=True)]
    assert counted == [iterations] * (len(counted) - 1) + [iterations + 1]  # one by the test itself


def test_grids_that_hold_the_film_are_visited_twice(
    solve, paper_contact, make_multigrid, make_ksp, make_vec
):
    """Of 257 nodes: 129 and 65 have 4 cells and more in the inlet, 33 have not. Again is by a V-cycle."""
    contact = paper_contact(8.0)
    solution = solve(contact, 257, coarsest=17)
    cells = [contact.inlet_cells(grid.mesh) for grid in solution.hierarchy.grids]
    assert cells[1] < 4.0 < cells[2]
    state = solution.outcome.state
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state)
    ksp = make_ksp(multigrid)
    before = [jacobian.deflection.count for jacobian in multigrid.jacobians]
    iterations = solve_linear(multigrid, ksp, make_vec, "bulge", state)
    counted = [j.deflection.count - b for j, b in zip(multigrid.jacobians, before, strict=True)]
    each_cycle = [3, 3, 3, 2]
    assert counted == [iterations * visits for visits in each_cycle] + [iterations + 1]


def test_given_pressures_stay(film, make_ksp, make_vec):
    multigrid, state = film(65)
    ksp = make_ksp(multigrid)
    b, x = make_vec(multigrid.space, *right_hand_side("noise", multigrid, state)), make_vec(multigrid.space)
    ksp.solve(b, x)
    correction, _ = multigrid.space.read(x)
    given = (state.status == CAVITATED) | multigrid.space.grid.boundary()
    assert given.sum() > 100
    np.testing.assert_array_equal(correction[given], 0.0)


def test_one_grid_is_solved_directly(solve, paper_contact, make_multigrid, make_ksp, make_vec):
    solution = solve(paper_contact(3.0), 33)
    state = solution.outcome.state
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state)
    ksp = make_ksp(multigrid, rtol=1e-9)
    b, x = make_vec(multigrid.space, *right_hand_side("noise", multigrid, state)), make_vec(multigrid.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() == 1


def test_petsc_options_change_the_solver(film, make_ksp, petsc_options):
    multigrid, _ = film(65)
    petsc_options["test_ksp_max_it"] = 3
    petsc_options["test_ksp_type"] = "gmres"
    ksp = make_ksp(multigrid)
    assert ksp.getTolerances()[3] == 3
    assert ksp.getType() == "gmres"
    assert ksp.getPC().getType() == "python"


def solve_linear(multigrid, ksp, make_vec, kind, state):
    """Iterations to the KSP's tolerance, which the true residual must meet, too."""
    b, x, r = (make_vec(multigrid.space) for _ in range(3))
    multigrid.space.write(b, *right_hand_side(kind, multigrid, state))
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    multigrid.jacobian.mat.mult(x, r)
    r.aypx(-1.0, b)
    assert r.norm() <= 1.01 * ksp.getTolerances()[0] * b.norm()
    return ksp.getIterationNumber()


def dense_jacobian(jacobian):
    """The bordered matrix, from the dense influence of all nodes on all nodes."""
    mesh, linear = jacobian.grid.mesh, jacobian.linearisation
    A, B = (stencil_rows(linear.offsets, each, 0, mesh.nodes).toarray() for each in (linear.A, linear.B))
    J = A + B @ dense_influence(mesh, jacobian.contact.kernel)
    load = np.full((1, mesh.nodes), jacobian.load_weight)
    return np.block([[J, B.sum(axis=1, keepdims=True)], [load, np.zeros((1, 1))]])


class TestCycleOfAnotherScheme:
    """2B is solved, by cycles whose operators are those of 1B."""

    @pytest.fixture
    def linearised(self, make_hierarchy, paper_contact, rough_state, make_multigrid):
        """Function: solver of a problem by `couette` with cycles by `cycle`, all about one state."""
        contact = paper_contact()
        hierarchy = make_hierarchy(contact, 33, coarsest=17)

        def make(couette, cycle):
            grid, deflection = hierarchy.grids[-1], hierarchy.deflections[-1]
            problem = ContactProblem(grid, deflection, contact, Scheme(couette))
            return make_multigrid(hierarchy, problem, rough_state(problem, contact=True), couette=cycle)

        return make

    def test_outer_operator_is_that_of_the_problem(self, linearised, make_vec):
        multigrid = linearised("2B", "1B")
        assert multigrid.jacobian.scheme.couette == "2B"
        space = multigrid.space
        P = np.random.default_rng(9).standard_normal(space.grid.shape)
        P[space.grid.boundary()] = 0.0  # as the convolution has it
        x, y = make_vec(space, P, 0.7), make_vec(space)
        multigrid.jacobian.mat.mult(x, y)
        expected = dense_jacobian(linearised("2B", "same").jacobian) @ np.append(P, 0.7)
        np.testing.assert_allclose(y.getArray(), expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())

    def test_operators_of_the_cycle_are_those_of_its_scheme(self, linearised):
        multigrid, plain = linearised("2B", "1B"), linearised("1B", "same")
        for mine, theirs in zip(multigrid.jacobians, plain.jacobians, strict=True):
            np.testing.assert_array_equal(mine.linearisation.A, theirs.linearisation.A)
            np.testing.assert_array_equal(mine.linearisation.B, theirs.linearisation.B)
        outer, cycle = multigrid.jacobian.linearisation, multigrid.jacobians[-1].linearisation
        assert len(outer.offsets) == len(cycle.offsets) + 1  # 2B looks one node further

    @pytest.mark.parametrize("cycle", ["same", "2B"])
    def test_the_problem_s_own_scheme_needs_no_second_operator(self, linearised, cycle):
        multigrid = linearised("2B", cycle)
        assert multigrid.jacobian is multigrid.jacobians[-1]

    @pytest.mark.parametrize("kind", ["noise", "bulge"])
    @pytest.mark.parametrize("nodes", SIZES)
    def test_gmres_converges(self, solve, paper_contact, make_multigrid, make_ksp, make_vec, nodes, kind):
        solution = solve(paper_contact(), nodes, couette="2B")
        state = solution.outcome.state
        multigrid = make_multigrid(solution.hierarchy, solution.problem, state, couette="1B")
        assert solve_linear(multigrid, make_ksp(multigrid), make_vec, kind, state) <= 12

    @pytest.mark.parametrize("nodes", [257, 1025])
    def test_gmres_converges_on_one_line(self, line_film, make_multigrid, make_ksp, make_vec, nodes):
        solution = line_film(nodes, "2B")
        state = solution.outcome.state
        multigrid = make_multigrid(solution.hierarchy, solution.problem, state, couette="1B")
        assert solve_linear(multigrid, make_ksp(multigrid, 1e-6), make_vec, "noise", state) <= 13


@pytest.mark.parametrize("couette", ["1B", "2B"])
@pytest.mark.parametrize("kind", ["noise", "bulge"])
def test_gmres_iterations_on_one_line(line_film, make_multigrid, make_ksp, make_vec, kind, couette):
    """A line contact: few iterations to 1e-6, and hardly more on sixteen times the nodes."""
    iterations = []
    for nodes in (257, 1025, 4097):
        solution = line_film(nodes, couette)
        state = solution.outcome.state
        assert (state.status == LUBRICATED).sum() > nodes / 2
        multigrid = make_multigrid(solution.hierarchy, solution.problem, state)
        iterations.append(solve_linear(multigrid, make_ksp(multigrid, 1e-6), make_vec, kind, state))
    assert max(iterations) <= 9
    assert max(iterations) <= min(iterations) + 2


def test_the_residual_of_gmres_is_the_true_one_where_a_film_ends():
    """A film that 65 nodes cannot hold: orthogonalised once it takes 100 iterations, and is not solved."""
    settings = {"grid.nodes": 65, "motion.speed": 0.008, "solver.start": "film", "solver.max_steps": 1}
    rows = mgehl.solve(mgehl.load(None, settings), speak=False).rows
    assert rows[-1]["linear_iterations"] < 70
