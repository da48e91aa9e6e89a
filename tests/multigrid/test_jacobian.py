import numpy as np
import pytest

from mgehl.discretization.residual import residual
from mgehl.discretization.rows import FLOW
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.discretization.storage import Storage
from mgehl.multigrid.coarse import CoarseSolve
from mgehl.solver.beyond import Beyond
from mgehl.solver.problem import State

STEP = 1e-6


def direction(problem):
    """A random change of P, zero on the boundary where none is allowed, and of H0."""
    dP = np.random.default_rng(6).standard_normal(problem.grid.shape)
    return np.where(problem.boundary, 0.0, dP), 0.7


def unknown(problem, state, dP):
    """The same direction without cavities that feed nothing: they have no unknown."""
    marched = (state.status == CAVITATED) & ~problem.feeding(state.status)
    return np.where(marched, 0.0, dP)


def rows(problem, state, dP, dH0, step):
    """Residual and load deficit a step along a direction, the partition unchanged: in cavities that feed a
    film it is the filling that moves."""
    cavity = state.status == CAVITATED
    P, H0 = state.P + step * np.where(cavity, 0.0, dP), state.H0 + step * dH0
    filling = state.filling + step * np.where(cavity, dP, 0.0)
    moved = State(P, H0, problem.gap(P, H0), state.status, filling=filling)
    return problem.residual(problem.evaluate(moved), moved.status), problem.load_deficit(P, H0)


def differences(problem, state, dP, dH0):
    ahead, load_ahead = rows(problem, state, dP, dH0, STEP)
    behind, load_behind = rows(problem, state, dP, dH0, -STEP)
    return (ahead - behind) / (2 * STEP), (load_ahead - load_behind) / (2 * STEP)


def apply(jacobian, make_vec, dP, dH0):
    x, y = make_vec(jacobian.space, dP, dH0), make_vec(jacobian.space)
    jacobian.mat.mult(x, y)
    r, border = jacobian.space.read(y)
    return r.copy(), border


def assert_close(result, expected):
    """To 1e-6 of the largest row of the kind that is compared."""
    assert np.max(np.abs(expected)) > 0.0
    assert np.max(np.abs(result - expected)) < 1e-6 * np.max(np.abs(expected))


ALONG = [(name, (1.0, 0.0), contact) for name in ("1B", "2B", "2C", "S1B", "S2C") for contact in (0, 1)]


@pytest.mark.parametrize(
    "couette, motion, contact", [*ALONG, *((c, (0.6, 0.8), 1) for c in ("1B", "2B", "S2B-v"))]
)
def test_schemes(make_problem, rough_state, make_jacobian, make_vec, couette, motion, contact):
    problem = make_problem(nodes=33, scheme=Scheme(couette, motion=motion))
    assert_consistent(problem, rough_state(problem, bool(contact)), make_jacobian, make_vec)


def assert_consistent(problem, state, make_jacobian, make_vec):
    dP, dH0 = direction(problem)
    dP = unknown(problem, state, dP)
    jacobian = make_jacobian(problem, state)
    r, border = apply(jacobian, make_vec, dP, dH0)
    expected, load = differences(problem, state, dP, dH0)
    given = problem.boundary | (state.status == CAVITATED) & ~problem.feeding(state.status)
    in_contact = state.status == CONTACT
    for kind in (~given & ~in_contact, in_contact, given):
        if np.any(expected[kind]):
            assert_close(r[kind], expected[kind])
    assert border == pytest.approx(load * jacobian.load_scale, rel=1e-6)
    moved = np.where(state.status == CAVITATED, 0.0, dP)
    assert border == pytest.approx(jacobian.load_weight * moved.sum(), rel=1e-12)


@pytest.mark.parametrize("rate", [20.0, "each its own"])
def test_a_time_step_stores_what_flows_in(make_problem, rough_state, make_jacobian, make_vec, rate):
    """Against differences of the residual of the step."""
    problem = make_problem(nodes=33)
    state, (dP, dH0) = rough_state(problem, contact=True), direction(problem)
    dP = unknown(problem, state, dP)
    rate = np.abs(dP) + 1.0 if rate == "each its own" else rate
    rows, now = problem.rows(state.status), problem.evaluate(state)
    jacobian, storage = make_jacobian(problem, state), Storage.begun(now.fluid, rate)
    jacobian.linearise(now, rows, rate)
    r, _ = apply(jacobian, make_vec, dP, dH0)
    problem.storage = storage
    moved = (problem.state(state.P + s * dP, state.H0 + s * dH0, state.status) for s in (STEP, -STEP))
    ahead, behind = (residual(problem.evaluate(each), rows) for each in moved)
    film = rows == FLOW
    assert_close(r[film], ((ahead - behind) / (2.0 * STEP))[film])


def test_oil_squeezed_out_beyond_the_domain_carries(make_problem, rough_state, make_jacobian, make_vec):
    """The load answers to H0 by itself: product and inverse, the coarsest grid's."""
    problem = make_problem(nodes=17, coarsest=17)
    state, (dP, dH0) = rough_state(problem, contact=False), direction(problem)
    Beyond(problem).resist(state, 1e-3, 1.0)
    problem.H0_before += 0.1
    jacobian = make_jacobian(problem, state)
    jacobian.resistance = problem.resistance
    r, border = apply(jacobian, make_vec, dP, dH0)
    _, load = differences(problem, state, dP, dH0)
    assert border == pytest.approx(load * jacobian.load_scale, rel=1e-6)
    own = problem.resistance * dH0 * jacobian.load_scale
    assert own > 0.1 * abs(border + own) and border + own == pytest.approx(jacobian.load_weight * dP.sum())
    coarse = CoarseSolve(jacobian)
    coarse.gather()
    coarse.factor()
    found, found_H0 = coarse.solve(r, border)
    assert found_H0 == pytest.approx(dH0) and found == pytest.approx(dP, abs=1e-6)


@pytest.mark.parametrize("couette", ["1B", "3B"])
def test_what_a_cavity_holds_is_an_unknown_where_it_feeds_a_film(
    make_problem, rough_state, make_jacobian, make_vec, couette
):
    problem = make_problem(nodes=33, scheme=Scheme(couette))
    state = rough_state(problem)
    holes = np.random.default_rng(8).random(problem.grid.shape) < 0.2
    holes &= ~problem.boundary & (problem.grid.X < 0.5)
    state.P[holes] = state.p[holes] = 0.0
    state.status[holes], state.filling[holes] = CAVITATED, 0.4
    state.H = problem.gap(state.P, state.H0)
    assert problem.feeding(state.status).any()
    assert_consistent(problem, state, make_jacobian, make_vec)


def test_a_cavity_without_a_gap_has_a_column_of_its_own(make_problem, rough_state, make_jacobian):
    """Contact that was torn open where bodies still overlap, before a film: else the system is singular."""
    problem = make_problem(nodes=33)
    state = rough_state(problem)
    j, i = problem.grid.mesh.centre[::-1]
    state.P[j, i] = state.p[j, i] = 0.0
    state.status[j, i], state.filling[j, i], state.H[j, i] = CAVITATED, 0.0, -1e-3
    lin = make_jacobian(problem, state).linearisation
    assert lin.carried[0, 0][j, i] != 0.0
    columns = sum(np.abs(each) for each in lin.carried.values())
    assert np.count_nonzero(columns) == 2  # in its own row and in the next node's
