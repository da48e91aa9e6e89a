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
