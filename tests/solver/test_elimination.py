import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.rows import PRESSURE
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.elimination import FEW, WHOLE, windows_of
from mgehl.solver.problem import State
from mgehl.solver.window import Window


def moved(window, state, name, node, by):
    """A state whose unknown of a node is another, with the gap that follows."""
    state = state.copy()
    getattr(state, name)[node] += by
    if name == "P":
        P = np.zeros(state.P.shape)
        P[node] = by
        state.H = state.H + window._deflection(P)
        state.p = np.where(state.status == CONTACT, state.p, state.P)
    return state


@pytest.mark.parametrize("couette", ["1B", "3L"])
def test_the_jacobian_of_a_window_is_the_derivative_of_its_rows(make_problem, rough_state, couette):
    scheme = Scheme(couette, "linear-gap", contact_law=BoundaryFilm(0.05), motion=(0.8, 0.6))
    problem = make_problem(nodes=33, scheme=scheme)
    state, X = rough_state(problem, contact=True), problem.grid.X
    between = (X > 0.6) & (X < 0.9) & (state.status != CONTACT)
    status = np.where(between, CAVITATED, np.where(state.status == CAVITATED, LUBRICATED, state.status))
    state = problem.state(np.where(between, 0.0, state.P + 0.01), state.H0, status, 0.4 * state.P)
    state.filling = np.where(between, 0.5, 1.0)
    box, free = (slice(8, 28), slice(14, 32)), np.zeros((20, 18), dtype=bool)
    free[3:-3, 3:-3] = True
    K = influence_coefficients(problem.grid.mesh, problem.contact.kernel)
    window = Window(problem, K, free, problem.feeding(state.status)[box])
    part = State(H0=state.H0, **{name: getattr(state, name)[box] for name in WHOLE})
    at = window.measured(part)
    unknown, feeds = free & (at.rows != PRESSURE), window.feeding(part.status)
    contact = unknown & (part.status == CONTACT)
    assert min(each.sum() for each in (contact, unknown & feeds, unknown & ~feeds & ~contact)) > 4

    def left(state):
        evaluation = window.evaluate(state)
        F = window.residual(evaluation, state.status)
        return np.concatenate([F[unknown], evaluation.inflow[contact]])

    found = []
    columns = [("filling" if feeds[node] else "P", node) for node in map(tuple, np.argwhere(unknown))]
    for name, node in columns + [("p", node) for node in map(tuple, np.argwhere(contact))]:
        ends = (left(moved(window, part, name, node, by)) for by in (1e-6, -1e-6))
        found.append(np.subtract(*ends) / 2e-6)
    expected = window._jacobian(at, unknown, contact, 0.0)
    assert np.transpose(found) == pytest.approx(expected, rel=1e-5, abs=1e-6 * np.abs(expected).max())


def test_windows_are_around_few_nodes_alone():
    left = np.full((40, 60), 1e-3)
    left[5, 7], left[20, 58] = 1.0, 2.0
    (near, free), (edge, _) = windows_of(left)
    assert near == (slice(0, 15), slice(0, 17)) and free.sum() == 12 * 13 and not free[-3:].any()
    assert left[edge].shape == (19, 11)
    left.ravel()[: 2 * FEW] = 1.0
    assert windows_of(left) == []
