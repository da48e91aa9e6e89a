"""Film of an atom's height shut in by contact: full contact by the geometric mean on 257 nodes.

Node (101, 64) has contact to the east and behind, and 0.05 nm of film. What flows into it leaves
only through that film: no pressure drives it out of the gap as it is, any pressure opens it.
"""

from dataclasses import replace

import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.solver.continuation import Continuation
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import NestedSettings, NewtonSettings, SolverSettings

LINE, NODE = 63, 100


@pytest.fixture
def contact_start(paper_contact, make_hierarchy, usual_law):
    """Function: outcome, hierarchy, contact and settings of full contact at 0.005 mm/s."""

    def start(max_steps):
        contact = paper_contact(5e-6)
        scheme = Scheme(face_mobility="geometric", contact_law=usual_law(contact))
        nested, newton = NestedSettings(start="contact"), NewtonSettings(max_steps=max_steps)
        settings = SolverSettings(scheme=scheme, nested=nested, newton=newton)
        hierarchy = make_hierarchy(contact, 257)
        _, outcome = nested_iteration(hierarchy, contact, settings, lambda *each: None)
        return outcome, hierarchy, contact, settings

    return start


def test_a_node_that_its_flow_would_lift_is_not_solved_apart(contact_start):
    outcome, *_ = contact_start(15)
    assert outcome.converged and outcome.cycles[-1].step <= 9


def test_solved_apart_it_would_turn_for_ever(contact_start, monkeypatch):
    monkeypatch.setattr("mgehl.solver.cavitation.LIFTED", 1e9)
    outcome, *_ = contact_start(15)
    assert not outcome.converged and outcome.cycles[-1].residual > 1e-8


@pytest.mark.parametrize("own, converges", [(0.1, True), (0.0, False)])
def test_its_own_squeeze_opens_it_step_by_step(contact_start, monkeypatch, own, converges):
    """Coupled: with one rate for all nodes its pressure shoots over the fold, and its neighbours open."""
    monkeypatch.setattr("mgehl.solver.cavitation.LIFTED", 1e9)
    monkeypatch.setattr("mgehl.solver.squeeze.OF_NODES", {"geometric": own})
    outcome, hierarchy, contact, settings = contact_start(4)
    state = outcome.state
    assert state.status[LINE, NODE] == LUBRICATED
    assert 0.0 < state.H[LINE, NODE] * contact.film_scale < 0.1e-9
    settings = replace(settings, newton=replace(settings.newton, max_steps=10))
    _, coupled = Continuation(hierarchy, contact, settings).at(contact.speed, state)
    assert coupled.converged == converges
