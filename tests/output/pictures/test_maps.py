"""Maps of film, pressure and status."""

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm, to_rgba
from matplotlib.patches import FancyArrowPatch

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.output.pictures import maps, style
from mgehl.output.pictures.blocks import Blocks


@pytest.fixture
def drawn():
    """Function that draws a run with one of the functions of `maps`."""

    def draw(function, solution):
        with style.applied():
            return function(solution)

    return draw


def image_of(axes):
    """Values of the map, (ny, nx)."""
    (mesh,) = [each for each in axes.collections if isinstance(each, QuadMesh)]
    ny, nx, _ = mesh.get_coordinates().shape
    return np.asarray(mesh.get_array()).reshape(ny - 1, nx - 1)


def outline_of(axes, colour):
    """Points of the outlines in a colour, (n, 2)."""
    own = [each for each in axes.collections if not isinstance(each, QuadMesh) and len(each.get_edgecolor())
           and tuple(each.get_edgecolor()[0]) == to_rgba(colour)]  # fmt: skip
    return np.concatenate([path.vertices for each in own for path in each.get_paths()])


def test_the_film_about_the_dry_contact_in_nm(make_solution, drawn):
    solution = make_solution()
    axes, bar = drawn(maps.film_map, solution).axes
    X, Y = solution.mesh.X, solution.mesh.Y
    shown = 1e9 * solution.film[np.abs(Y) <= maps.WINDOW][:, np.abs(X) <= maps.WINDOW]
    np.testing.assert_allclose(image_of(axes), shown)
    assert bar.get_ylabel() == "film thickness, nm"


def test_the_pressure_in_GPa(make_solution, drawn):
    solution = make_solution()
    axes, bar = drawn(maps.pressure_map, solution).axes
    np.testing.assert_allclose(image_of(axes), 1e-9 * solution.pressure)
    assert bar.get_ylabel() == "pressure, GPa"


def test_the_status_and_where_the_bodies_overlap(make_solution, drawn):
    solution = make_solution(contact=0.4)
    solution.fields.H[3, 5] = -1e-4
    (axes,) = drawn(maps.status_map, solution).axes
    expected = solution.status.copy()
    expected[3, 5] = maps.OVERLAP
    np.testing.assert_array_equal(image_of(axes), expected)
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["lubricated", "cavitated", "contact", "overlap"]


@pytest.mark.parametrize("function", [maps.film_map, maps.pressure_map])
class TestOutlines:
    def test_of_the_contact(self, make_solution, drawn, function):
        """Half a cell about its disc of radius 0.4."""
        solution = make_solution(nodes=65, contact=0.4)
        points = outline_of(drawn(function, solution).axes[0], style.CONTACT_EDGE)
        assert len(points) > 20
        assert np.abs(np.hypot(*points.T) - 0.4).max() < solution.mesh.dX

    def test_of_a_single_node(self, make_solution, drawn, function):
        solution = make_solution()
        i, j = solution.mesh.nearest(0.2, -0.3)
        solution.fields.status[j, i] = CONTACT
        points = outline_of(drawn(function, solution).axes[0], style.CONTACT_EDGE)
        node = np.array([solution.mesh.X[i], solution.mesh.Y[j]])
        np.testing.assert_allclose(points.mean(axis=0), node, atol=0.3 * solution.mesh.dX)
        assert np.abs(points - node).max() < 0.6 * solution.mesh.dX

    def test_of_the_cavity_but_not_where_the_boundary_ends_it(self, make_solution, drawn, function):
        solution = make_solution()
        points = outline_of(drawn(function, solution).axes[0], "black")
        assert np.abs(points[:, 0] - 0.5).max() < solution.mesh.dX

    def test_none_of_what_there_is_none(self, make_solution, drawn, function):
        solution = make_solution()
        solution.fields.status[:] = LUBRICATED
        assert drawn(function, solution).axes[0].get_legend() is None


class TestScale:
    def scale(self, solution):
        blocks = Blocks(solution.mesh.X, solution.mesh.Y)
        return maps.film_scale(blocks, 1e9 * solution.film, solution.status)

    def test_of_the_film_inside_the_dry_contact(self, make_solution):
        """Its least film is the end of the scale, so that constrictions are read off it."""
        solution = make_solution()
        X, Y = solution.mesh.X[None, :], solution.mesh.Y[:, None]
        solution.fields.H *= np.where(np.hypot(X, Y - 0.8) < 0.1, 0.5, 1.0)
        norm = self.scale(solution)
        inside = 1e9 * solution.film[np.hypot(X, Y) < 1.0]
        assert norm.vmin == pytest.approx(inside.min()) and norm.vmax == pytest.approx(2 * inside.min())
        assert not isinstance(norm, LogNorm)

    def test_logarithmic_where_films_differ_much_and_over_three_decades_at_most(self, make_solution):
        solution = make_solution()
        solution.fields.H[16, 15] *= 1e-6
        norm = self.scale(solution)
        assert isinstance(norm, LogNorm)
        assert norm.vmax == pytest.approx(1e3 * norm.vmin)

    def test_of_one_film_has_room_about_it(self, make_solution):
        solution = make_solution()
        film = 1e9 * solution.film.min()
        norm = self.scale(solution)
        assert norm.vmin < 0.95 * film < 1.05 * film < norm.vmax

    def test_without_any_film(self, make_solution):
        solution = make_solution()
        solution.fields.H[:] = 0.0
        assert self.scale(solution).vmax == 10.0

    def test_about_the_contact_where_it_is_full(self, make_solution):
        solution = make_solution(contact=1.05)
        norm = self.scale(solution)
        assert 0.0 < norm.vmin < norm.vmax
        assert norm.vmax > 1e9 * solution.contact.film_scale * 0.5


def test_lines_of_equal_film_are_numbered_in_nm(make_solution, drawn):
    """A film that falls to the sides: its lines are those of round numbers on the colour bar."""
    solution = make_solution(nodes=65)
    Y = solution.mesh.Y[:, None]
    solution.fields.H *= 1.0 - 0.5 * np.minimum(np.abs(Y), 1.0)
    axes, bar = drawn(maps.film_map, solution).axes
    numbers = {float(text.get_text()) for text in axes.texts}
    assert len(numbers) >= 3
    assert numbers <= {float(label.get_text()) for label in bar.get_yticklabels()}


@pytest.mark.parametrize(
    "function, contact",
    [(maps.film_map, 0.4), (maps.film_map, 1.05), (maps.pressure_map, 1.05), (maps.status_map, 0.0)],
)
def test_texts(make_solution, drawn, check_texts, function, contact):
    figure = drawn(function, make_solution(contact=contact, converged=contact < 1.0))
    what = {"film_map": "film thickness", "pressure_map": "pressure", "status_map": "status of the nodes"}
    verdict = "converged" if contact < 1.0 else "NOT converged"
    check_texts(
        figure, "X = x/a, a = 0.4108 mm", "Y = y/b, b = 0.4108 mm",
        f"{what[function.__name__]}, 0.005 mm/s, 800 N, 33 x 33 nodes: {verdict}",
    )  # fmt: skip


def test_a_single_node_in_contact_stays_on_the_map_of_a_large_grid(make_solution, drawn, tmp_path):
    """1025 nodes a side: its colour is in the picture itself."""
    from matplotlib.image import imread

    solution = make_solution(nodes=1025)
    solution.fields.status[511, 300] = CONTACT
    with style.applied():
        style.save(maps.status_map(solution), tmp_path / "status.png")
    pixels = imread(tmp_path / "status.png")
    wide = pixels[: int(0.85 * len(pixels))]  # without the legend
    dark = np.abs(wide - to_rgba(style.STATUS_COLOURS[CONTACT])).max(axis=-1) < 0.01
    assert dark.any()


def arrows_of(axes):
    return [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]


class TestMotion:
    """An arrow shows where the surfaces move to."""

    @pytest.mark.parametrize("function", [maps.film_map, maps.pressure_map, maps.status_map])
    def test_every_map_has_one(self, make_solution, drawn, function):
        assert len(arrows_of(drawn(function, make_solution(settings=["motion.angle=30"])).axes[0])) == 1

    @pytest.mark.parametrize("angle", [0, 30, 90, 200])
    def test_it_points_along_the_motion_in_units_of_a_and_b(self, make_solution, angle):
        contact = make_solution(settings=[f"motion.angle={angle}", "contact.radius_y=40 mm"]).contact
        tail, head = maps.arrow_ends(contact, (-2.0, 1.0), (-1.5, 1.5))
        x, y = (head - tail) * (contact.hertz.a, contact.hertz.b)
        assert np.cos(np.arctan2(y, x) - np.radians(angle)) == pytest.approx(1.0, abs=1e-12)
        for X, Y in (tail, head):
            assert -2.0 < X < 1.0 and -1.5 < Y < 1.5

    def test_a_wedge_has_none(self, make_wedge, drawn):
        axes = drawn(maps.status_map, make_wedge()).axes[0]
        assert arrows_of(axes) == []

    def test_the_title_has_its_angle(self, make_solution, drawn, check_texts):
        figure = drawn(maps.pressure_map, make_solution(settings=["motion.angle=30"]))
        check_texts(figure, "pressure, 0.005 mm/s at 30°, 800 N, 33 x 33 nodes: converged")


@pytest.mark.parametrize("reach", [1.35, 30.0, 500.0])
def test_a_grid_of_few_nodes_in_the_window_is_drawn(make_solution, reach):
    """One line of nodes, or none, has no contours."""
    solution = make_solution(contact=0.9, settings=[f"grid.x=[-{2 * reach},{2 * reach}]"])
    maps.film_map(solution)
