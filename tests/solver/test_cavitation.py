"""The cavities at a gap that is held fixed."""

import numpy as np
import pytest

from mgehl.discretization.axes import HALO
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver import cavitation as module
from mgehl.solver.cavitation import (
    LOW,
    SHIFTED,
    WEAKLY_COUPLED,
    cavities_rest,
    overflows,
    relax_cavitation_set,
    weakly_coupled,
)


@pytest.fixture
def film(solve, paper_contact):
    """The solved full film at 1 m/s on 65 nodes."""
    return solve(paper_contact(), 65)


def movable(problem, state):
    low = state.P <= LOW * state.P.max()
    return low & weakly_coupled(problem, problem.evaluate_full(state), state.status, WEAKLY_COUPLED)


def relax(problem, state):
    """How many nodes changed; what is no cavity is full, and the fluid's pressure is that of the state."""
    before, nodes = state.copy(), movable(problem, state)
    moved = relax_cavitation_set(problem, state)
    cavity, in_contact = state.status == CAVITATED, state.status == CONTACT
    np.testing.assert_array_equal(state.filling[~nodes], before.filling[~nodes])
    if moved:
        assert (state.filling[nodes & ~cavity] == 1.0).all() and (
            state.filling[nodes & cavity] <= 1.0
        ).all()
    np.testing.assert_array_equal(state.p, np.where(in_contact, before.p, state.P) if moved else before.p)
    return moved


def test_a_solved_problem_is_left_alone(film):
    state = film.outcome.state.copy()
    assert relax(film.problem, state) == 0
    np.testing.assert_array_equal(state.P, film.outcome.state.P)
    np.testing.assert_array_equal(state.status, film.outcome.state.status)


def test_weakly_coupled_nodes_are_fluid_under_low_pressure(film):
    problem, state = film.problem, film.outcome.state
    nodes = movable(problem, state)
    assert nodes.any() and not nodes.all()
    assert set(np.unique(state.status[nodes])) == {LUBRICATED, CAVITATED}
    assert state.P[nodes].max() < 0.5 * state.P.max()
    in_contact = np.full_like(state.status, CONTACT)
    assert not weakly_coupled(problem, problem.evaluate_full(state), in_contact, 0.0).any()


def dry_cavity(film, state):
    """Every weakly coupled cavity is taken for film."""
    state.status[movable(film.problem, state) & (state.status == CAVITATED)] = LUBRICATED


def torn_rim(film, state):
    """Film beside the cavities is taken for cavity, three nodes deep."""
    grid, cavity = film.problem.grid, state.status == CAVITATED
    for _ in range(3):
        ghosted = grid.halo(cavity)
        cavity[:, 1:-1] |= cavity[:, 2:] | cavity[:, :-2]
        cavity |= ghosted[HALO - 1 : -HALO - 1] | ghosted[HALO + 1 : len(ghosted) - HALO + 1]
    torn = cavity & movable(film.problem, state) & (state.status == LUBRICATED)
    state.P[torn], state.status[torn] = 0.0, CAVITATED


@pytest.mark.parametrize("spoil", [dry_cavity, torn_rim])
def test_a_spoiled_set_is_restored(film, spoil):
    problem, solved = film.problem, film.outcome.state
    state = solved.copy()
    spoil(film, state)
    spoiled = np.count_nonzero(state.status != solved.status)
    assert spoiled > 50
    for _ in range(10):  # mobilities follow the pressures from one call to the next
        if relax(problem, state) == 0:
            break
    # Nodes whose pressure is all but zero may settle either way until Newton has the last word.
    differ = state.status != solved.status
    assert np.count_nonzero(differ) < 0.1 * spoiled
    assert max(state.P[differ].max(initial=0.0), solved.P[differ].max(initial=0.0)) < 1e-5
    np.testing.assert_allclose(state.P, solved.P, rtol=0.0, atol=1e-4)


def carrying(part, monkeypatch):
    """Have the relaxation leave the gap's fluid with this part of the load, one node of it torn."""

    def relax(_first, w, film, *_):
        w[w > 0.0] *= part**0.5  # for each of the two colours of the last sweep
        changed = film[2, 2]
        film[2, 2], w[2 + HALO, 2] = False, 0.0
        return int(changed)

    monkeypatch.setattr(module, "relax_cavitation", relax)
    monkeypatch.setattr(module, "SWEEPS", 1)
    monkeypatch.setattr(module, "_relaxable", lambda *_: np.ones((65, 65), dtype=bool))


def moves(problem, state, part, monkeypatch):
    """Whether a relaxation that leaves this part of the load is taken, and changes what it should."""
    carrying(part, monkeypatch)
    before, load = state.copy(), state.P.sum()
    taken = relax(problem, state) > 0
    assert state.P.sum() == pytest.approx((part if taken else 1.0) * load)
    assert np.array_equal(state.status, before.status) is not taken
    return taken


@pytest.mark.parametrize("rough", [False, True], ids=["smooth", "rough"])
@pytest.mark.parametrize("shift, taken", [(0.9, True), (1.1, False), (-0.9, True), (-1.1, False)])
def test_what_would_shift_the_load_is_left_alone(film, monkeypatch, shift, taken, rough):
    """In parts of what may be shifted."""
    monkeypatch.setattr(type(film.problem.contact), "roughness", 1e-8 if rough else 0.0)
    part = 1.0 + shift * SHIFTED[rough]
    assert moves(film.problem, film.outcome.state.copy(), part, monkeypatch) is taken


@pytest.mark.parametrize("spoil", [dry_cavity, torn_rim])
def test_a_set_at_rest_is_told_from_a_spoiled_one(film, spoil):
    """As soon as the cavities hold what flows into them."""
    problem, state = film.problem, film.outcome.state.copy()
    problem.march_contents(state, problem.evaluate(state))
    assert cavities_rest(problem, state) and not overflows(state).any()
    spoil(film, state)
    state.p = state.P.copy()
    problem.march_contents(state, problem.evaluate(state))
    assert not cavities_rest(problem, state)
    assert overflows(state).any() == (spoil is torn_rim)


@pytest.mark.parametrize("status", [CAVITATED, LUBRICATED, CONTACT])
@pytest.mark.parametrize("filling", [0.0, 1.0, 1.01])
def test_only_a_cavity_that_holds_more_than_its_gap_overflows(film, status, filling):
    problem, state = film.problem, film.outcome.state.copy()
    state.status[32, 32], state.filling[:], state.filling[32, 32] = status, 1.0, filling
    found = overflows(state)
    assert found[32, 32] == (status == CAVITATED and filling > 1.0) and np.count_nonzero(found) <= 1
    assert cavities_rest(problem, state) is not bool(found[32, 32])


def test_cavities_that_feed_a_film_hold_what_flows_in(film):
    """Film is torn in the inlet, where the flow fills it again, and nothing is left of what was taken."""
    problem, solved = film.problem, film.outcome.state
    state = solved.copy()
    torn = np.zeros(state.P.shape, dtype=bool)
    torn[30:35, 4:8] = True
    assert (movable(problem, state) & torn).sum() == torn.sum()
    state.P[torn], state.status[torn], state.filling[torn] = 0.0, CAVITATED, 0.5
    state.p = state.P.copy()
    assert problem.feeding(state.status)[torn].all()
    assert relax(problem, state) >= torn.sum()
    assert (state.status[torn] == LUBRICATED).all()
    np.testing.assert_allclose(state.P[torn], solved.P[torn], rtol=0.0, atol=1e-4)


def test_a_cavity_that_feeds_a_film_is_balanced_by_its_filling(film):
    """Behind a line that is held empty: film begins further on, and each cavity passes on what it gets."""
    problem, state = film.problem, film.outcome.state.copy()
    empty = np.zeros(state.P.shape, dtype=bool)
    empty[20:45, 2] = True
    state.P[empty], state.status[empty], state.filling[empty] = 0.0, CAVITATED, 0.0
    state.p = state.P.copy()
    held = movable(problem, state) & ~empty
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_relaxable", lambda *_: held)
        assert relax_cavitation_set(problem, state) > 0
        while relax_cavitation_set(problem, state):
            pass  # mobilities follow the pressures from one call to the next
    cavities = held & (state.status == CAVITATED) & problem.feeding(state.status)
    assert cavities.sum() > 20 and state.filling[cavities].min() < 0.5
    inflow, couette = problem.evaluate(state).inflow, 1.0 / problem.grid.mesh.dX
    assert np.abs(inflow[cavities]).max() < 1e-3 * couette


@pytest.mark.parametrize("spoil", [dry_cavity, torn_rim])
def test_complementarity_holds_where_it_relaxes(film, spoil):
    problem = film.problem
    state = film.outcome.state.copy()
    spoil(film, state)
    before, nodes = state.copy(), movable(problem, state)
    moved = relax(problem, state)
    assert moved > 50
    assert moved == np.count_nonzero(state.status != before.status)
    inflow = problem.evaluate_full(state).inflow
    cavity = nodes & (state.status == CAVITATED)
    assert np.all(state.P[nodes] >= 0.0)
    np.testing.assert_array_equal(state.P[cavity], 0.0)
    # Mobilities were frozen: what is left is of the second order in the change of P.
    couette = 1.0 / problem.grid.mesh.dX
    assert inflow[cavity].max() < 1e-3 * couette
    np.testing.assert_array_equal(state.P[~nodes], before.P[~nodes])
    np.testing.assert_array_equal(state.status[~nodes], before.status[~nodes])
