"""Several runs in one picture."""

import numpy as np
import pytest

from mgehl.errors import UserError
from mgehl.output.pictures import style
from mgehl.output.pictures.comparison import compare_histories, compare_lines


@pytest.fixture
def drawn():
    """Function that compares runs with one of the functions of `comparison`."""

    def draw(function, solutions, labels):
        with style.applied():
            return function(solutions, labels)

    return draw


def line_of(axes, label):
    (line,) = [line for line in axes.get_lines() if line.get_label() == label]
    return line


def test_lines_of_all_runs_in_GPa_and_nm(make_solution, drawn, check_texts):
    runs = [make_solution(nodes=33), make_solution(nodes=65)]
    figure = drawn(compare_lines, runs, ["coarse", "fine"])
    along, across, films_along, films_across = figure.axes
    for label, run in (("coarse", runs[0]), ("fine", runs[1])):
        i, j = run.mesh.nearest(0.0, 0.0)
        GPa, nm = 1e-9 * run.pressure, 1e9 * run.film
        for axes, position, values in (
            (along, run.mesh.X, GPa[j]), (across, run.mesh.Y, GPa[:, i]),
            (films_along, run.mesh.X, nm[j]), (films_across, run.mesh.Y, nm[:, i]),
        ):  # fmt: skip
            np.testing.assert_allclose(line_of(axes, label).get_xydata().T, [position, values])
    check_texts(
        figure, "coarse", "fine", "Hertz", "pressure, GPa", "film thickness, nm", "X = x/a, a = 0.4108 mm",
        "centre lines, 0.005 mm/s, 800 N, 2 runs",
    )  # fmt: skip


def test_each_load_has_its_own_hertz_pressure_and_no_common_axis(make_solution, drawn):
    runs = [make_solution(settings=[f"contact.load={load} N"]) for load in (800, 100, 800)]
    axes = drawn(compare_lines, runs, "abc").axes
    hertz = [line.get_ydata().max() for line in axes[0].get_lines() if line.get_label() == "Hertz"]
    assert hertz == pytest.approx([1e-9 * run.contact.hertz.p_h for run in runs[:2]])
    assert axes[2].get_xlabel() == "X = x/a"


def test_films_that_differ_much_are_drawn_on_a_logarithmic_axis(make_solution, drawn):
    """Ten times as thick: no line of either is cut off inside the contact."""
    runs = [make_solution(nodes=65), make_solution(nodes=65)]
    assert drawn(compare_lines, runs, "ab").axes[2].get_yscale() == "linear"
    runs[1].fields.H *= 10.0
    axes = drawn(compare_lines, runs, "ab").axes[2]
    thin, thick = (1e9 * run.film.min() for run in runs)
    low, high = axes.get_ylim()
    assert axes.get_yscale() == "log" and 0.0 < low < thin and thick < high


def test_line_contacts_have_no_lines_across(make_line, drawn):
    assert len(drawn(compare_lines, [make_line(65), make_line(129)], "ab").axes) == 2


def test_wedges(make_wedge, drawn, check_texts):
    runs = [make_wedge(), make_wedge(settings=["wedge.pillar=none"])]
    figure = drawn(compare_lines, runs, ["square pillar", "no pillar"])
    P = line_of(figure.axes[0], "no pillar").get_ydata()
    np.testing.assert_array_equal(P, runs[1].fields.P[16])
    assert np.isnan(line_of(figure.axes[0], "square pillar").get_ydata()).any()
    check_texts(figure, "X, mm", "square pillar", "no pillar")


def test_runs_of_different_kinds_are_not_compared(make_solution, make_line, make_wedge, drawn):
    for other in (make_line(), make_wedge()):
        with pytest.raises(UserError, match="different kinds of contact"):
            drawn(compare_lines, [make_solution(), other], "ab")


def test_histories_with_a_ring_where_a_grid_begins(make_solution, make_rows, drawn, check_texts):
    histories = make_rows(grids=(65, 129), cycles=4), make_rows(grids=(65,), cycles=3)
    figure = drawn(compare_histories, [make_solution(rows=rows) for rows in histories], ["two", "one"])
    residual, load = figure.axes
    for label, rows in zip(("two", "one"), histories, strict=True):
        np.testing.assert_array_equal(
            line_of(residual, label).get_ydata(), [row["residual"] for row in rows]
        )
        errors = [abs(row["load_error"]) for row in rows]
        np.testing.assert_array_equal(line_of(load, label).get_ydata(), errors)
    assert [line_of(residual, label).get_markevery() for label in ("two", "one")] == [[0, 4], [0]]
    check_texts(figure, "residual (rms), dimensionless", "|load error|, dimensionless", "cycle, in order")


def test_nine_runs_are_told_apart_and_their_legend_has_room(make_solution, drawn, check_texts):
    labels = [f"{10**k} mm/s, harmonic mean of the mobility" for k in range(9)]
    figure = drawn(compare_histories, [make_solution() for _ in labels], labels)
    lines = [line_of(figure.axes[0], label) for label in labels]
    assert len({(line.get_color(), line.get_linestyle()) for line in lines}) == 9
    check_texts(figure, *labels)


@pytest.mark.parametrize(
    "angle, title", [(0, "Y = 0, along the motion (left to right)"), (30, "Y = 0, along x")]
)
def test_lines_are_along_the_motion_if_they_all_are(make_solution, drawn, angle, title):
    runs = [make_solution(), make_solution(settings=[f"motion.angle={angle}"])]
    assert drawn(compare_lines, runs, "ab").axes[0].get_title() == title
