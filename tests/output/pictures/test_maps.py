"""Maps of film, pressure and status."""

import numpy as np
import pytest
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_rgba
from matplotlib.patches import Ellipse, FancyArrowPatch

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.output.pictures import maps, plane, style


@pytest.fixture
def drawn():
    """Function that draws a run with one of the functions of `maps`."""

    def draw(function, solution):
        with style.applied():
            return function(solution)

    return draw


def image_of(axes):
    """Values of the map, (ny, nx)."""
    images = [*axes.get_images(), *(each for each in axes.collections if isinstance(each, QuadMesh))]
    (image,) = images
    shape = image.get_coordinates().shape if isinstance(image, QuadMesh) else None
    values = np.asarray(image.get_array())
    return values.reshape(shape[0] - 1, shape[1] - 1) if shape else values


def parts_of(figure):
    """Axes of a map, and of its colour bar."""
    (axes,) = figure.axes
    (bar,) = axes.child_axes
    return axes, bar


def outline_of(axes, colour):
    """Points of the outlines in a colour, (n, 2), in mm."""
    own = [each for each in axes.collections if not isinstance(each, QuadMesh) and len(each.get_edgecolor())
           and tuple(each.get_edgecolor()[0]) == to_rgba(colour)]  # fmt: skip
    return np.concatenate([path.vertices for each in own for path in each.get_paths()])


def in_a(solution, points):
    """Points in mm as (X, Y)."""
    return points / (1e3 * solution.contact.x_scale, 1e3 * solution.contact.y_scale)


def labels_of(figure):
    """What the legend of a figure says."""
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_the_film_in_nm_and_grey_where_it_is_thicker_than_any_inside_the_contact(make_solution, drawn):
    solution = make_solution()
    figure = drawn(maps.film_map, solution)
    axes, bar = parts_of(figure)
    j, i = maps.view(solution)[1]
    inside = 1e9 * solution.film.min()
    film = 1e9 * solution.film[j, i]
    np.testing.assert_allclose(image_of(axes), np.clip(film, inside / 1.1, 1.1 * inside))
    assert bar.get_ylabel() == "film thickness, nm"
    faces = [(each, each.get_facecolor()) for each in axes.collections]
    hidden = [each for each, face in faces if len(face) and tuple(face[0]) == to_rgba(style.HIDDEN)]
    (patch,) = hidden
    (thick,) = [path.to_polygons() for path in patch.get_paths()]
    areas = [np.abs(np.trapz(polygon[:, 1], polygon[:, 0])) for polygon in thick]
    whole = np.ptp(axes.get_xlim()) * np.ptp(axes.get_ylim())
    hertz = np.pi * 1e6 * solution.contact.x_scale * solution.contact.y_scale
    assert max(areas) == pytest.approx(whole)  # all around, but for the disc
    assert min(areas) == pytest.approx(hertz, rel=0.1)
    assert f"thicker than {1.1 * inside:.3g} nm" in labels_of(figure)


def test_the_pressure_in_GPa(make_solution, drawn):
    solution = make_solution()
    axes, bar = parts_of(drawn(maps.pressure_map, solution))
    np.testing.assert_allclose(image_of(axes), 1e-9 * solution.pressure[maps.view(solution)[1]])
    assert bar.get_ylabel() == "pressure, GPa"


def test_the_status_and_where_the_bodies_overlap(make_solution, drawn):
    solution = make_solution(contact=0.4)
    solution.fields.H[3, 5] = -1e-4
    figure = drawn(maps.status_map, solution)
    expected = solution.status.copy()
    expected[3, 5] = plane.OVERLAP
    np.testing.assert_array_equal(image_of(figure.axes[0]), expected)
    assert labels_of(figure) == ["lubricated", "cavitated", "contact", "overlap"]


@pytest.mark.parametrize("function", [maps.film_map, maps.pressure_map, maps.status_map])
def test_an_ellipse_of_six_to_one_is_drawn_as_one(make_solution, drawn, function, check_texts):
    """True to scale, in mm; six times as high as wide."""
    solution = make_solution(settings=["contact.radius_y=190 mm"])
    contact = solution.contact
    assert contact.y_scale > 5.0 * contact.x_scale
    figure = drawn(function, solution)
    axes = figure.axes[0]
    assert axes.get_aspect() in (1.0, "equal")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x, mm", "y, mm")
    for ellipse in (each for each in axes.patches if isinstance(each, Ellipse)):
        assert ellipse.width == pytest.approx(2e3 * contact.x_scale)
        assert ellipse.height == pytest.approx(2e3 * contact.y_scale)
    check_texts(figure)


@pytest.mark.parametrize("coated, words", [(False, "Hertz: a = b = "), (True, "Hertz, uncoated: a = b = ")])
def test_the_dry_contact_is_named(make_solution, drawn, coated, words):
    keys = ["contact.deformation=coated", "coating.thickness=40 um", "coating.modulus=4 GPa"]
    solution = make_solution(settings=keys if coated else [])
    size = f"{1e3 * solution.contact.x_scale:.3g} mm"
    for function in (maps.film_map, maps.pressure_map):
        assert words + size in labels_of(drawn(function, solution))


@pytest.mark.parametrize("function", [maps.film_map, maps.pressure_map])
class TestOutlines:
    def test_of_the_contact(self, make_solution, drawn, function):
        """Half a cell about its disc of radius 0.4."""
        solution = make_solution(nodes=65, contact=0.4)
        points = in_a(solution, outline_of(drawn(function, solution).axes[0], style.CONTACT_COLOUR))
        assert len(points) > 20
        assert np.abs(np.hypot(*points.T) - 0.4).max() < solution.mesh.dX

    def test_of_a_single_node(self, make_solution, drawn, function):
        solution = make_solution()
        i, j = solution.mesh.nearest(0.2, -0.3)
        solution.fields.status[j, i] = CONTACT
        points = in_a(solution, outline_of(drawn(function, solution).axes[0], style.CONTACT_COLOUR))
        node = np.array([solution.mesh.X[i], solution.mesh.Y[j]])
        np.testing.assert_allclose(points.mean(axis=0), node, atol=0.3 * solution.mesh.dX)
        assert np.abs(points - node).max() < 0.6 * solution.mesh.dX

    def test_of_the_cavity_but_not_where_the_boundary_ends_it(self, make_solution, drawn, function):
        solution = make_solution()
        points = in_a(solution, outline_of(drawn(function, solution).axes[0], "black"))
        assert np.abs(points[:, 0] - 0.5).max() < solution.mesh.dX

    def test_none_of_what_there_is_none(self, make_solution, drawn, function):
        solution = make_solution()
        solution.fields.status[:] = LUBRICATED
        assert not {"contact", "cavitation"} & set(labels_of(drawn(function, solution)))


def test_lines_of_equal_film_are_numbered_in_nm(make_solution, drawn):
    """A film that falls to the sides: its lines are those of round numbers on the colour bar."""
    solution = make_solution(nodes=65)
    Y = solution.mesh.Y[:, None]
    solution.fields.H *= 1.0 - 0.5 * np.minimum(np.abs(Y), 1.0)
    axes, bar = parts_of(drawn(maps.film_map, solution))
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
        figure, "x, mm", "y, mm",
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
    def test_it_points_along_the_motion(self, make_solution, angle):
        """Of an ellipse, too: the map is true to scale."""
        contact = make_solution(settings=[f"motion.angle={angle}", "contact.radius_y=40 mm"]).contact
        tail, head = plane.arrow_ends(contact, (-2.0, 1.0), (-1.5, 1.5))
        x, y = head - tail
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
