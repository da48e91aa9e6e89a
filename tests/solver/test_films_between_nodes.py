from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.solver.films import at_centre, smallest

PLANE = Mesh(21, 17, (-1.9, 1.3), (-1.5, 1.4))
LINE = Mesh(21, 1, (-1.9, 1.3), (0.0, 0.0))


def on(mesh, function):
    Y = mesh.Y[:, None] if not mesh.is_line else np.zeros((1, 1))
    return function(mesh.X[None, :], Y) + 0.0 * Y


@pytest.mark.parametrize("mesh", [PLANE, LINE])
@pytest.mark.parametrize("moved", [0.0, 1.9, -1.3, -1.26])
def test_a_cubic_is_met_between_nodes_and_at_the_ends(mesh, moved):
    mesh = replace(mesh, x=(mesh.x[0] + moved, mesh.x[1] + moved))

    def cubic(X, Y):
        return 1.0 + X - 2.0 * X**2 + 0.5 * X**3 + 0.3 * Y**2

    assert at_centre(on(mesh, cubic), mesh) == pytest.approx(cubic(0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("X0", [0.0, 0.02, -0.06, 0.079])
@pytest.mark.parametrize("twist", [0.0, 0.7])
def test_bottom_of_a_paraboloid_wherever_it_lies_between_the_nodes(X0, twist):
    def bowl(X, Y):
        x, y = X - X0, Y - 0.03
        return 0.25 + x**2 + 2.0 * y**2 + twist * x * y

    assert smallest(on(PLANE, bowl)) == pytest.approx(0.25, abs=1e-12)


@pytest.mark.parametrize("where", [(0, 3), (2, 0), (2, 6)])
def test_on_the_boundary_the_lowest_node_is_the_answer(where):
    H = np.ones((5, 7))
    H[where] = 0.5
    assert smallest(H) == 0.5
