"""The picture of how a run converged."""

import numpy as np
import pytest

from mgehl.errors import OutputError
from mgehl.output.pictures import style
from mgehl.output.pictures.history import column, history

OWN_SPEED = ["motion.speed=0.5 m/s"]
"""That of the last rows of `make_rows`."""


@pytest.fixture
def drawn():
    """Function that draws a run's history and returns its figure."""

    def draw(solution):
        with style.applied():
            return history(solution)

    return draw


def lines_of(axes):
    return {line.get_label(): line.get_ydata() for line in axes.get_lines()}


def test_residual_load_error_and_sets_against_the_cycles_in_order(make_solution, make_rows, drawn):
    rows = make_rows(grids=(65, 129), cycles=4)
    errors, sets = drawn(make_solution(rows=rows)).axes
    np.testing.assert_array_equal(errors.get_lines()[0].get_xdata(), np.arange(8))
    np.testing.assert_array_equal(lines_of(errors)["residual (rms)"], [row["residual"] for row in rows])
    np.testing.assert_array_equal(
        lines_of(errors)["|load error|"], [abs(row["load_error"]) for row in rows]
    )
    for name, label in (("contact", "in contact"), ("cavitated", "cavitated"), ("changed", "changed")):
        np.testing.assert_array_equal(lines_of(sets)[label], [row[f"{name}_nodes"] for row in rows])
    assert errors.get_yscale() == "log" and sets.get_yscale() == "symlog"


def test_grids_have_bands_and_names(make_solution, make_rows, drawn, check_texts):
    """Every other one is grey, from half a cycle before its first to half a cycle after its last."""
    rows = make_rows(grids=(65, 129, 257), cycles=4)
    figure = drawn(make_solution(rows=rows, settings=OWN_SPEED))
    spans = [(patch.get_xy()[0, 0], patch.get_xy()[2, 0]) for patch in figure.axes[0].patches]
    assert spans == [(-0.5, 3.5), (7.5, 11.5)]
    check_texts(figure, "65 nodes, 1 m/s", "129 nodes, 1 m/s", "257 nodes")
    (above,) = figure.axes[0].child_axes
    assert above.get_xticks().tolist() == [1.5, 5.5, 9.5]


def test_a_wedge_has_the_residuals_of_its_solves(make_wedge, drawn, check_texts):
    figure = drawn(make_wedge())
    (errors,) = figure.axes
    np.testing.assert_array_equal(lines_of(errors)["residual (rms)"], [1.0, 1e-6, 1e-12])
    check_texts(figure, "linear solve", "error, dimensionless", "33 nodes")


@pytest.mark.parametrize("rows", [[{"grid": 1}], [{"residual": "x"}]])
def test_a_column_that_is_not_there(rows):
    with pytest.raises(OutputError, match="history.csv has no numbers in its column residual"):
        column(rows, "residual")


def test_no_cycles(make_solution, drawn):
    with pytest.raises(OutputError, match="history.csv has no cycles"):
        drawn(make_solution(rows=[]))
