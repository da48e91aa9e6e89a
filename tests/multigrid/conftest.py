import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.multigrid.smoother_choice import smoother_of

OMEGA = 0.8


@pytest.fixture
def line_film(solve):
    """Function: the full film of a cylinder under the paper ball's pressure at 1 m/s, on n nodes."""
    lubricant = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())
    contact = LineContact(1.86e6, 12.7e-3, 219.78e9, 1.0, lubricant)

    def run(nodes, couette="1B"):
        solution = solve(contact, nodes, couette=couette, x=(-4.0, 2.0), y=(0.0, 0.0), ny=1)
        assert solution.outcome.converged
        return solution

    return run


@pytest.fixture
def make_smoother():
    """Factory of factored smoothers of a linearised `Jacobian` with these rows; freed after the test."""
    made = []

    def make(jacobian, rows, kind=None):
        made.append((kind or smoother_of(jacobian))(jacobian, OMEGA))
        made[-1].partition(rows)
        made[-1].factor()
        made[-1].factor_alone()
        return made[-1]

    yield make
    for smoother in made:
        smoother.free()
