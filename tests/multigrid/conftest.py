import pytest

from mgehl.multigrid.smoother_choice import smoother_of

OMEGA = 0.8


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
