import numpy as np
import pytest
from contacts import solved

from mgehl.studies.study import PAPER, papers_grid

EXACT = 1e-10
ON_A_SQUARE = {"x": [-1.9, 1.9], "y": [-1.9, 1.9]}
FILM = {"motion": {"speed": 1.0}, "grid": {"nodes": 65} | ON_A_SQUARE}
CONTACT_CASE = PAPER | {"motion": {"speed": 5e-6}, "grid": papers_grid(129), "solver": {"start": "contact"}}


def at(angle):
    return {"motion": {"angle": angle}}


def assert_same(found, expected, back=lambda array: array):
    """Films in m, pressures and statuses are the same where `back` brings the first ones to the second."""
    assert found.result.converged and expected.result.converged
    np.testing.assert_array_equal(back(found.status), expected.status)
    for name in ("film", "pressure"):
        values = getattr(expected, name)
        bound = EXACT * np.abs(values).max()
        np.testing.assert_allclose(back(getattr(found, name)), values, rtol=0.0, atol=bound)
    for name in ("central_film_nm", "minimum_film_nm", "max_pressure_GPa"):
        assert getattr(found.result, name) == pytest.approx(getattr(expected.result, name), rel=EXACT)
    assert found.result.work == expected.result.work


class TestAlongTheOtherAxis:
    @pytest.mark.parametrize("couette", ["1B", "2B"])
    def test_a_ball_has_the_transpose(self, couette):
        """On a domain that is none of a square, turned with the motion."""
        scheme = {"discretization": {"couette": couette}}
        along = {"grid": {"nodes": 65, "x": [-1.9, 1.3], "y": [-1.5, 1.6]}}
        turned = {"grid": {"nodes": 65, "x": [-1.5, 1.6], "y": [-1.9, 1.3]}}
        expected = solved(FILM, along, scheme)
        assert_same(solved(FILM, turned, scheme, at(90)), expected, np.transpose)
        opposite = {"grid": {"nodes": 65, "x": [-1.5, 1.6], "y": [-1.3, 1.9]}}
        assert_same(solved(FILM, opposite, scheme, at(-90)), expected, lambda a: a[::-1].T)

    def test_an_ellipse_has_its_axes_exchanged(self):
        wide, long = {"radius_x": 10e-3, "radius_y": 30e-3}, {"radius_x": 30e-3, "radius_y": 10e-3}
        expected = solved(FILM, {"contact": wide})
        found = solved(FILM, {"contact": long}, at("90 deg"))
        assert_same(found, expected, np.transpose)
        assert found.result.groups == expected.result.groups
        assert found.result.formulas == expected.result.formulas
        resolution = found.result.resolution
        assert resolution.inlet_cells == pytest.approx(expected.result.resolution.inlet_cells, rel=1e-12)

    def test_full_contact_is_counted_along_the_users_axes(self):
        uneven = {"grid": {"nodes": 129, "x": [-1.9, 1.3], "y": [-1.5, 1.6]}}
        turned = {"grid": {"nodes": 129, "x": [-1.5, 1.6], "y": [-1.9, 1.3]}}
        expected, found = solved(CONTACT_CASE, uneven), solved(CONTACT_CASE, turned, at(90))
        assert_same(found, expected, np.transpose)
        contact, other = expected.result.contact, found.result.contact
        assert (other.x_nodes, other.y_nodes) == (contact.y_nodes, contact.x_nodes)
        assert contact.x_nodes != contact.y_nodes


class TestMirrored:
    @pytest.mark.parametrize("angle, axis", [(-30, 0), (150, 1)], ids=["about x", "about y"])
    def test_about_an_axis(self, angle, axis):
        ellipse = {"contact": {"radius_y": 25.4e-3}}
        found, expected = (solved(FILM, ellipse, at(each)) for each in (angle, 30))
        assert_same(found, expected, lambda array: np.flip(array, axis))

    def test_about_the_diagonal(self):
        assert_same(solved(FILM, at(60)), solved(FILM, at(30)), np.transpose)


SURFACE = """
import numpy as np

def bump(x, y):
    "Higher towards +x than towards +y, and neither even nor odd."
    return 2e-7 * np.exp(-((x - 1e-4) ** 2 + (y + 2e-4) ** 2) / 1e-8) - 1e-3 * x - 2e-3 * y

def turned(x, y):
    "The same about the other diagonal."
    return bump(y, x)

def opposite(x, y):
    return bump(-x, -y)
"""


class TestOwnSurface:
    @pytest.fixture
    def surface(self, tmp_path):
        (tmp_path / "mine.py").write_text(SURFACE)
        return lambda name: {"contact": {"surface": f"{tmp_path}/mine.py:{name}"}}

    @pytest.fixture
    def expected(self, surface):
        found = solved(FILM, surface("bump"))
        plain = solved(FILM)
        # Of no symmetry, or turning it would show nothing.
        assert np.abs(found.film - found.film[::-1]).max() > 0.1 * plain.film.min()
        return found

    @pytest.mark.parametrize(
        "name, angle, back",
        [("turned", 90, np.transpose), ("opposite", 180, lambda array: array[::-1, ::-1])],
    )
    def test_it_is_turned_with_the_motion(self, surface, expected, name, angle, back):
        assert_same(solved(FILM, surface(name), at(angle)), expected, back)
