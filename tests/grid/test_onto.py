import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.grid.onto import onto, smoothly_onto

OLD, NEW = Mesh(9, 11, (-2.0, 2.0), (-1.0, 1.5)), Mesh(14, 8, (-2.5, 1.5), (-0.9, 1.6))
LINE, OTHER = Mesh(9, 1, (-2.0, 2.0), (0.0, 0.0)), Mesh(14, 1, (-2.5, 1.5), (0.0, 0.0))


def on(mesh, function):
    return function(*np.meshgrid(mesh.X, mesh.Y if mesh.ny > 1 else [0.0]))


@pytest.mark.parametrize("old, new", [(OLD, NEW), (LINE, OTHER)])
def test_polynomials_are_laid_exactly_within_the_old_mesh(old, new):
    def plane(x, y):
        return 1.0 + 2.0 * x - 3.0 * y

    def cubic(x, y):
        return x**3 - 2.0 * x * y**2 + y**3 + 0.5

    inside = on(new, lambda x, y: (abs(x) <= 2.0) & (y <= 1.5))
    np.testing.assert_allclose(onto(new, old, on(old, plane), 7.0), np.where(inside, on(new, plane), 7.0))
    found = smoothly_onto(new, old, on(old, cubic))
    np.testing.assert_allclose(found, np.where(inside, on(new, cubic), np.nan), rtol=0.0, atol=1e-12)
