"""What maps show of a run, and the scale of its film."""

import numpy as np
import pytest
from matplotlib.colors import LogNorm, Normalize

from mgehl.discretization.status import CONTACT
from mgehl.model.hertz import hertz_pressure
from mgehl.output.pictures.plane import DECADES, Plane, film_norm


def pressed(solution, x, y, wide):
    """With a Hertz pressure about (x, y) of that half-width, in units of a and b."""
    X, Y = (solution.mesh.X[None, :] - x) / wide, (solution.mesh.Y[:, None] - y) / wide
    solution.fields.P[:] = hertz_pressure(X, Y)
    return solution


def test_the_loaded_zone_whole_and_the_dry_contact_with_room(make_solution):
    """That of a coated body ends beyond Hertz, and a patch of contact farther away still."""
    solution = pressed(make_solution(129, settings=["grid.x=[-5,5]", "grid.y=[-5,5]"]), 0.3, 0.0, 2.2)
    blocks, a = Plane(solution).blocks, 1e3 * solution.contact.x_scale
    assert -5.0 < blocks.X[0] / a < -2.2 and 2.5 < blocks.X[-1] / a < 5.0
    solution.fields.status[60, 125] = CONTACT
    plane = Plane(solution)
    assert plane.blocks.X[-1] >= 1e3 * solution.x[125]
    assert (plane.status == CONTACT).any() and plane.status.shape == (
        len(plane.blocks.Y),
        len(plane.blocks.X),
    )


def test_distance_is_one_on_the_edge_of_what_carries_load(make_solution):
    solution = pressed(make_solution(129), -0.2, 0.1, 0.7)
    plane, (a, b) = Plane(solution), (1e3 * solution.contact.x_scale, 1e3 * solution.contact.y_scale)
    away = np.hypot(plane.blocks.X / a + 0.2, plane.blocks.Y[:, None] / b - 0.1) / 0.7
    np.testing.assert_allclose(plane.distance, away, rtol=0.06, atol=0.06)


@pytest.mark.parametrize("P", [0.0, np.nan, -1.0])
def test_without_a_pressure_it_is_the_dry_contact(make_solution, P):
    solution = make_solution()
    solution.fields.P[:] = P
    plane, a = Plane(solution), 1e3 * solution.contact.x_scale
    assert plane.distance.min() < 0.1 and -1.9 < plane.blocks.X[0] / a < -1.2


def test_a_window_without_a_node_has_those_beside_it(make_solution):
    blocks = Plane(make_solution(settings=["grid.x=[-60,61]", "grid.y=[-60,61]"])).blocks
    assert blocks.X[0] < 0.0 < blocks.X[-1] and blocks.Y[0] < 0.0 < blocks.Y[-1]


@pytest.fixture
def norm(make_solution):
    """Norm of films in nm inside the dry contact and outside of it; `seen` are single films, by place."""

    def make(inside, outside=1e5, contact=0.0, seen=()):
        solution = make_solution(65, contact=contact)
        X, Y, nm = solution.mesh.X[None, :], solution.mesh.Y[:, None], 1e9 * solution.contact.film_scale
        solution.fields.H[:] = np.where(np.hypot(X, Y) < 1.0, inside, outside) / nm
        for x, y, film in seen:
            i, j = solution.mesh.nearest(x, y)
            solution.fields.H[j, i] = film / nm
        return film_norm(Plane(solution))

    return make


def test_nothing_inside_is_beyond_the_scale(norm):
    """A side lobe of half the film, and an inlet of twice: no film inside is cut off, all outside is."""
    scale = norm(100.0, seen=[(0.0, 0.7, 50.0), (-0.7, 0.0, 200.0)])
    assert type(scale) is Normalize and (scale.vmin, scale.vmax) == pytest.approx((50.0, 200.0))


def test_a_thinnest_film_outside_of_the_zone_is_on_it(norm):
    assert norm(100.0, seen=[(-1.2, 0.0, 40.0)]).vmin == pytest.approx(40.0)


def test_logarithmic_where_films_differ_much(norm):
    assert type(norm(100.0, seen=[(0.0, 0.0, 12.6)])) is Normalize
    assert isinstance(norm(100.0, seen=[(0.0, 0.0, 12.4)]), LogNorm)
    scale = norm(100.0, seen=[(0.0, 0.0, 1e-9)])
    assert scale.vmax == pytest.approx(DECADES * scale.vmin)


def test_of_one_film_has_room_about_it(norm):
    assert norm(100.0).vmin < 95.0 and 105.0 < norm(100.0).vmax


def test_without_any_film(norm):
    assert norm(0.0, outside=0.0).vmax == 10.0


def test_about_the_contact_where_it_is_full(norm):
    assert norm(0.0, outside=250.0, contact=1.01).vmax == pytest.approx(275.0)
