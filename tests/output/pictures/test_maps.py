import numpy as np
import pytest
from matplotlib.colors import to_rgba
from matplotlib.image import imread
from matplotlib.patches import Ellipse
from matplotlib.quiver import Quiver

from mgehl.commands.plot import KINDS
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT
from mgehl.output.pictures import maps, plane, style
from mgehl.output.pictures.figures import drawn_by
from mgehl.output.pictures.lines import line_of

ALL = [maps.film_map, maps.pressure_map, maps.status_map]


@pytest.fixture
def under_a_course(make_solution, tmp_path):
    """A solution of a run in time that ends under eight times its first load."""
    (tmp_path / "load.csv").write_text("0,10\n1,80\n")
    settings = [f"contact.load={tmp_path / 'load.csv'}", "time.end=1", "grid.x=[-3, 3]"]
    rows = [{"time_s": t, "speed_mm_s": 1.0, "load_share": share} for t, share in ((0.0, 1.0), (1.0, 8.0))]
    return make_solution(settings=settings, rows=rows)


def test_the_dry_contact_is_that_of_the_load_at_the_end(under_a_course, drawn):
    """Its axes are twice those of the first load, its pressure, too."""
    a = 1e3 * under_a_course.contact.hertz.a
    axes = drawn(maps.film_map, under_a_course).axes[0]
    (ellipse,) = [each for each in axes.patches if isinstance(each, Ellipse)]
    assert ellipse.width == pytest.approx(4.0 * a)
    assert f"Hertz: a = b = {2.0 * a:.3g} mm" in [text.get_text() for text in axes.get_legend().get_texts()]
    line, first = line_of(under_a_course, across=False), under_a_course.contact
    assert line.hertz.max() == pytest.approx(2e-9 * first.hertz.p_h)
    assert np.abs(line.fine[line.hertz > 0.0]).max() == pytest.approx(2.0, abs=0.02)
    assert line.dry[np.abs(line.fine) < 1.99] == pytest.approx(0.0, abs=1e-9)


def of_window(solution, values):
    return values[plane.Plane(solution).part]


@pytest.mark.parametrize("function", ALL)
def test_a_cavity_is_drawn_by_its_filling(make_solution, drawn, function):
    """From 0 to 1, of cavities alone."""
    solution = make_solution()
    filling = np.linspace(0.0, 1.0, solution.status.size).reshape(solution.status.shape)
    solution.fields.filling = filling
    axes = drawn(function, solution).axes[0]
    (image,) = [each for each in axes.get_images() if each.cmap is style.FILLING_MAP]
    status = solution.status if function is maps.status_map else of_window(solution, solution.status)
    filling = filling if function is maps.status_map else of_window(solution, filling)
    np.testing.assert_array_equal(~np.ma.getmaskarray(image.get_array()), status == CAVITATED)
    np.testing.assert_array_equal(image.get_array().compressed(), filling[status == CAVITATED])
    assert (image.norm.vmin, image.norm.vmax) == (0.0, 1.0)
    assert "cavity:\npart filled" in [bar.get_ylabel() for bar in axes.child_axes]
    assert "edge of a cavity" in [text.get_text() for text in axes.get_legend().get_texts()]


@pytest.mark.parametrize("function", [maps.film_map, maps.status_map])
def test_a_single_node_in_contact_is_seen_on_the_map_of_a_large_grid(make_solution, function, tmp_path):
    """1025 nodes a side: its colour is in the picture itself."""
    solution = make_solution(nodes=1025)
    solution.fields.status[511, 600] = CONTACT
    with style.applied():
        style.save(function(solution), tmp_path / "map.png")
    pixels = imread(tmp_path / "map.png")
    wide = pixels[: int(0.85 * len(pixels))]  # without the legend
    assert (np.abs(wide - to_rgba(style.CONTACT_COLOUR)).max(axis=-1) < 0.01).any()


def test_flash_temperatures_are_drawn_where_they_were_found(make_solution, drawn):
    """Of each body a map, which no cavity hides, as `mgehl plot` and reports know it."""
    solution = make_solution()
    assert not {"flash_1", "flash_2"} & drawn_by(solution).keys()
    solution.fields.flash_2 = np.linspace(0.0, 3.0, solution.status.size).reshape(solution.status.shape)
    pictures = drawn_by(solution)
    assert {"flash_2"} == {"flash_1", "flash_2"} & pictures.keys() and "flash_2" in KINDS
    (image,) = drawn(pictures["flash_2"][1], solution).axes[0].get_images()
    np.testing.assert_array_equal(image.get_array(), of_window(solution, solution.fields.flash_2))


def test_maps_end_within_the_boundary_but_those_of_the_whole_grid(make_solution):
    solution = make_solution(settings=["grid.x=[-1.2, 1.2]", "grid.y=[-1.2, 1.2]"])
    solution.fields.status[[0, -1]] = solution.fields.status[:, [0, -1]] = BOUNDARY
    assert not (plane.Plane(solution).status == BOUNDARY).any()
    assert (plane.Plane(solution, whole=True).status == BOUNDARY).any()


@pytest.mark.parametrize("function", ALL)
@pytest.mark.parametrize("angle", [0, 30, 90, 200])
def test_an_arrow_on_every_map_shows_where_the_surfaces_move_to(make_solution, drawn, function, angle):
    solution = make_solution(settings=[f"motion.angle={angle}", "contact.radius_y=40 mm"])
    axes = drawn(function, solution).axes[0]
    (arrow,) = [each for each in axes.collections if isinstance(each, Quiver)]
    assert np.cos(np.arctan2(*arrow.V, *arrow.U) - np.radians(angle)) == pytest.approx(1.0)
    assert arrow.angles == "xy"  # as on the map, which may be stretched
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    assert left < arrow.X[0] < right and bottom < arrow.Y[0] < top
