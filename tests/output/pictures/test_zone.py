"""The contact that is there, and what maps show of it."""

import numpy as np
import pytest

from mgehl.discretization.status import CONTACT
from mgehl.model.hertz import hertz_pressure
from mgehl.output.pictures.zone import hertz_zone, loaded_zone, millimetres, window


def pressed(solution, x, y, wide, high):
    """With a Hertz pressure about (x, y), in units of a and b, and of these semi-axes."""
    X, Y = (solution.mesh.X[None, :] - x) / wide, (solution.mesh.Y[:, None] - y) / high
    solution.fields.P[:] = hertz_pressure(X, Y)
    return solution


@pytest.mark.parametrize("x, y, wide, high", [(0.0, 0.0, 1.0, 1.0), (-0.3, 0.1, 1.4, 0.7)])
def test_it_is_that_of_the_pressure(make_solution, x, y, wide, high):
    keys = ["contact.radius_y=25.4 mm", "grid.x=[-2,2]", "grid.y=[-2,2]"]
    solution = pressed(make_solution(129, settings=keys), x, y, wide, high)
    a, b = 1e3 * solution.contact.x_scale, 1e3 * solution.contact.y_scale
    assert loaded_zone(solution) == pytest.approx((x * a, y * b, wide * a, high * b), abs=2e-3 * b)


def test_distance_is_one_on_its_edge(make_solution):
    zone = hertz_zone(make_solution(settings=["contact.radius_y=25.4 mm"]).contact)
    x, y = np.array([0.0, zone.half_x]), np.array([-zone.half_y, 0.0, 2.0 * zone.half_y])
    expected = [[1.0, np.sqrt(2.0)], [0.0, 1.0], [2.0, np.sqrt(5.0)]]
    np.testing.assert_allclose(zone.distance(x, y), expected)


@pytest.mark.parametrize("P", [0.0, np.nan, -1.0])
def test_without_a_pressure_it_is_that_of_hertz(make_solution, P):
    solution = make_solution()
    solution.fields.P[:] = P
    assert loaded_zone(solution) == hertz_zone(solution.contact)


def test_the_window_has_a_wide_contact_whole(make_solution):
    """That of a coated body ends beyond Hertz, and a patch of contact farther away still."""
    solution = pressed(make_solution(129, settings=["grid.x=[-5,5]", "grid.y=[-5,5]"]), 0.0, 0.0, 2.2, 2.2)
    i, j = window(solution, loaded_zone(solution))
    assert solution.mesh.X[i][0] < -2.2 and solution.mesh.X[i][-1] > 2.2
    assert -5.0 < solution.mesh.Y[j][0] < -2.2
    solution.fields.status[60, 125] = CONTACT
    i, j = window(solution, loaded_zone(solution))
    assert i.stop > 125 and solution.mesh.Y[j][-1] < 5.0


def test_a_window_without_a_node_has_those_beside_it(make_solution):
    solution = make_solution(settings=["grid.x=[-60,61]", "grid.y=[-60,61]"])
    i, j = window(solution, hertz_zone(solution.contact))
    x, y = millimetres(solution)
    assert x[i][0] < 0.0 < x[i][-1] and y[j][0] < 0.0 < y[j][-1]
