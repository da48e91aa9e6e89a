"""Which smoother a grid has."""

import pytest

from mgehl.discretization.scheme import Scheme
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


def test_coarse_grids_that_hold_the_film_look_for_cliffs(
    make_problem, paper_contact, rough_state, make_jacobian
):
    for speed, kind in (1.0, CrossedLineSmoother), (8.0, CliffSmoother):
        contact = paper_contact(speed)
        problem = make_problem(contact, nodes=NODES)
        assert (contact.inlet_cells(problem.grid.mesh) >= 4.0) == (kind is CliffSmoother)
        assert smoother_of(make_jacobian(problem, rough_state(problem))) is kind


@pytest.mark.parametrize("angle", [0.0, 30.0])
def test_the_finest_grid_looks_for_cliffs(make_problem, paper_contact, rough_state, make_jacobian, angle):
    contact = paper_contact(angle=angle)
    problem = make_problem(contact, Scheme("3B", motion=contact.motion), nodes=NODES)
    jacobian = make_jacobian(problem, rough_state(problem))
    assert smoother_of(jacobian, finest=True) is CliffSmoother
    assert smoother_of(jacobian) is CrossedLineSmoother
