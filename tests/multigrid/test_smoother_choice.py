"""Which smoother a grid has."""

from dataclasses import replace

import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.multigrid import smoother_choice
from mgehl.multigrid.crossed_lines import CliffSmoother, CrossedLineSmoother
from mgehl.multigrid.smoother import LineSmoother
from mgehl.multigrid.smoother_choice import smoother_of

NODES = 65


def test_a_single_line_is_not_crossed(line_film, make_jacobian):
    solution = line_film(65)
    assert smoother_of(make_jacobian(solution.problem, solution.outcome.state)) is LineSmoother


def test_contact_whose_fluid_is_solved_apart_is_not_crossed(rough_state, make_problem, make_jacobian):
    problem = make_problem(nodes=NODES)
    jacobian = make_jacobian(problem, rough_state(problem, contact=True))
    assert smoother_of(jacobian) is CrossedLineSmoother
    assert smoother_of(jacobian, apart=True) is LineSmoother


@pytest.mark.parametrize(
    "scheme, angle, finest, kind",
    [
        (Scheme("3B", face_mobility="linear-gap"), 0.0, True, CliffSmoother),
        (Scheme("3B", face_mobility="linear-gap"), 0.0, False, CrossedLineSmoother),
        (Scheme("3B", face_mobility="linear-gap"), 30.0, True, CrossedLineSmoother),
        (Scheme("3B"), 0.0, True, CrossedLineSmoother),
    ],
    ids=["vanishing mean", "a coarse grid", "at an angle", "arithmetic mean"],
)
def test_cliffs_are_asked_for_where_lines_that_cross_may_fail(
    make_problem, paper_contact, rough_state, make_jacobian, monkeypatch, scheme, angle, finest, kind
):
    monkeypatch.setattr(smoother_choice, "FINE", NODES)
    contact = paper_contact(angle=angle)
    problem = make_problem(contact, replace(scheme, motion=contact.motion), nodes=NODES)
    assert smoother_of(make_jacobian(problem, rough_state(problem)), finest=finest) is kind
