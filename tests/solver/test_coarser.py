"""The same contact on coarser grids."""

import numpy as np
import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.solver.coarser import MAX_STEPS, CoarserGrids
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import SolverSettings

SETTINGS = SolverSettings(scheme=Scheme(couette="2B"))


@pytest.fixture
def film(paper_contact, make_hierarchy):
    """Function: films of the grids of a film at a speed, with what the monitor was told."""

    def make(speed, nodes=129, scheme=None):
        contact = paper_contact(speed)
        hierarchy = make_hierarchy(contact, nodes)
        problem, outcome = nested_iteration(hierarchy, contact, SETTINGS, lambda level, cycle: None)
        assert outcome.converged
        told = []
        before = outcome.state.copy()
        tell = lambda level, cycle: told.append((level, cycle))  # noqa: E731
        coarser = CoarserGrids(hierarchy, problem, outcome.state, SETTINGS, tell)
        grids = coarser.films(scheme or SETTINGS.scheme)
        for name in ("P", "H", "status"):
            np.testing.assert_array_equal(getattr(outcome.state, name), getattr(before, name))
        return grids, told

    return make


def test_each_has_the_film_of_its_own_run(film, solve, paper_contact):
    """To what the looser tolerance leaves; the centre is a node of all these grids."""
    (finest, coarser, coarsest), told = film(3.0)
    assert [each.nodes for each in (finest, coarser, coarsest)] == [129, 65, 33]
    own = solve(paper_contact(3.0), 65, couette="2B")
    assert coarser.central_nm == pytest.approx(own.films[0], rel=1e-4)
    assert {(level.nodes, level.speed, level.finest) for level, _ in told} == {
        (65, 3.0, False),
        (33, 3.0, False),
    }


def test_after_a_grid_with_contact_or_without_an_answer_there_is_no_other(film):
    """0.4 m/s: on 65 nodes the inlet has 1.2 cells, and the film is lost."""
    grids, told = film(0.4)
    assert len(grids) == 2 and not grids[1].is_film
    assert {level.nodes for level, _ in told} == {65}
    assert max(cycle.step for _, cycle in told) <= MAX_STEPS
