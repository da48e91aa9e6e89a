"""Centre lines of a run."""

import numpy as np
import pytest

from mgehl.output.pictures import style
from mgehl.output.pictures.lines import SMALLEST_FILM_RANGE, centre_lines, film_range


@pytest.fixture
def drawn():
    """Function that draws a run's centre lines."""

    def draw(solution):
        with style.applied():
            return centre_lines(solution)

    return draw


def lines_of(axes):
    """Each line of an axes, by label and without those that have none."""
    return {line.get_label(): line for line in axes.get_lines()}


def panels_of(figure):
    """Pressure axes and their twins of the film, in order."""
    pressures = [axes for axes in figure.axes if axes.get_ylabel() == "pressure, GPa"]
    films = [axes for axes in figure.axes if axes.get_ylabel() == "film thickness, nm"]
    assert len(pressures) + len(films) == len(figure.axes)
    return list(zip(pressures, films, strict=True))


def test_both_axes_show_the_fields_in_GPa_and_nm(make_solution, drawn):
    solution = make_solution()
    i, j = solution.mesh.nearest(0.0, 0.0)
    along, across = panels_of(drawn(solution))
    GPa, nm = 1e-9 * solution.pressure, 1e9 * solution.film
    for (pressure, film), line, position in (
        (along, (j, slice(None)), solution.mesh.X),
        (across, (slice(None), i), solution.mesh.Y),
    ):
        np.testing.assert_allclose(lines_of(pressure)["pressure"].get_xydata().T, [position, GPa[line]])
        np.testing.assert_allclose(lines_of(film)["film"].get_xydata().T, [position, nm[line]])


def test_against_the_pressure_and_the_gap_of_the_dry_contact(make_solution, drawn):
    solution = make_solution(nodes=129)
    pressure, film = panels_of(drawn(solution))[0]
    X, contact = solution.mesh.X, solution.contact
    hertz = pressure.get_lines()[1].get_ydata()
    np.testing.assert_allclose(hertz, 1e-9 * contact.hertz.p_h * np.sqrt(np.maximum(1 - X**2, 0)))
    gap = lines_of(film)["dry contact (Hertz)"].get_ydata()
    assert (gap[np.abs(X) <= 1.0] == 0.0).all()
    np.testing.assert_allclose(gap, 1e9 * contact.film_scale * contact.dry_gap(X, 0.0 * X))


def test_texts(make_solution, make_line, drawn, check_texts):
    check_texts(
        drawn(make_solution(settings=["motion.speed=0.5 m/s"])), "pressure, GPa", "film thickness, nm",
        "x, mm", "y, mm", "X = x/a, a = 0.4108 mm", "Y = y/b, b = 0.4108 mm", "pressure", "film",
        "dry contact (Hertz)", "centre lines, 500 mm/s, 800 N, 33 x 33 nodes: converged",
    )  # fmt: skip
    settings = ["contact.load_per_length=1859 N/mm", "motion.speed=100 mm/s"]
    check_texts(drawn(make_line(settings=settings)), "X = x/a, a = 0.523 mm", "x, mm",
                "centre lines, 100 mm/s, 1859 N/mm, 65 nodes: converged")  # fmt: skip


def test_the_dry_contact_of_a_coated_body_is_named_as_another(make_solution, drawn):
    keys = ["contact.deformation=coated", "coating.thickness=40 um", "coating.modulus=4 GPa"]
    film = panels_of(drawn(make_solution(settings=keys)))[0][1]
    assert "dry contact (Hertz, uncoated)" in lines_of(film)


def test_a_line_contact_has_one_panel(make_line, drawn):
    assert len(panels_of(drawn(make_line()))) == 1


def test_millimetres_along_the_upper_side(make_solution, drawn):
    solution = make_solution()
    figure = drawn(solution)
    figure.draw_without_rendering()
    (upper,) = panels_of(figure)[0][0].child_axes
    assert upper.get_xlim() == pytest.approx(1e3 * solution.x[[0, -1]], rel=1e-12)


def test_the_range_of_the_film_shows_what_is_inside_and_below():
    X = np.linspace(-2.0, 2.0, 41)
    film = np.where(np.abs(X) < 0.8, 40.0, 1e5)
    assert film_range(X, film) == (0.0, 120.0)
    assert film_range(X, np.zeros(41)) == (0.0, 10.0)
    assert film_range(X, film - 100.0 * (X == 0.0)) == pytest.approx((-66.0, 120.0))


def test_a_film_axis_of_a_grid_so_coarse_that_no_node_is_inside_the_dry_contact():
    position = np.array([-3.0, -1.0, 1.0, 3.0])
    assert film_range(position, np.array([900.0, 40.0, 40.0, 900.0])) == (0.0, SMALLEST_FILM_RANGE)


@pytest.mark.parametrize(
    "angle, titles",
    {
        0: ("Y = 0, along the motion (left to right)", "X = 0, across the motion"),
        30: ("Y = 0, along x", "X = 0, along y"),
        180: ("Y = 0, along x", "X = 0, along y"),
    }.items(),
)
def test_lines_are_named_by_the_motion_where_that_is_along_x(make_solution, drawn, angle, titles):
    figure = drawn(make_solution(settings=[f"motion.angle={angle}"]))
    assert tuple(axes.get_title() for axes, _ in panels_of(figure)) == titles
