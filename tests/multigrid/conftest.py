import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant


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
