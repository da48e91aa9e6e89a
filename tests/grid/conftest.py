import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant


@pytest.fixture
def line_contact():
    """A cylinder on a flat under the paper ball's pressure."""
    return LineContact(1.86e6, 12.7e-3, 219.78e9, 1.0, Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson()))


@pytest.fixture
def make_line(line_contact, make_hierarchy):
    return lambda nodes, coarsest=33: make_hierarchy(
        line_contact, nodes, coarsest, x=(-4.0, 2.0), y=(0.0, 0.0), ny=1
    )
