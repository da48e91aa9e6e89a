"""Film of an atom's height shut in by contact: full contact by the geometric mean on 257 nodes.

Node (101, 64) has contact to the east and behind, and 0.05 nm of film. What flows into it leaves
only through that film: no pressure drives it out of the gap as it is, any pressure opens it.
"""

import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import NestedSettings, NewtonSettings, SolverSettings


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
