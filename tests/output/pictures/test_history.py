"""The picture of how a run converged."""

import numpy as np
import pytest

from mgehl.errors import OutputError
from mgehl.output.pictures import style
from mgehl.output.pictures.history import column, cycles, grids, history

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


def test_names_of_short_stays_are_turned(make_solution, make_rows, drawn):
    rows = make_rows(grids=(65,), cycles=3) + make_rows(grids=(129,), cycles=40)
    (above,) = drawn(make_solution(rows=rows, settings=OWN_SPEED)).axes[0].child_axes
    assert {label.get_rotation() for label in above.get_xticklabels()} == {30.0}


def test_sweeps_stand_at_their_number(make_solution, drawn):
    sweep = {"grid": 65, "speed_mm_s": 5.0, "residual": 1.0, "load_error": 1e-3, "e_p": 1e-2}
    rows = [sweep | {"step": k, "contact_nodes": 1, "cavitated_nodes": 2} for k in (0, 100, 250)]
    assert cycles(rows)[0].tolist() == [0, 100, 250]
    figure = drawn(make_solution(rows=rows))
    assert figure.axes[-1].get_xlabel() == "relaxation sweep"
    assert set(lines_of(figure.axes[1])) == {"in contact", "cavitated"}


def test_a_wedge_has_the_residuals_of_its_solves(make_wedge, drawn, check_texts):
    figure = drawn(make_wedge())
    (errors,) = figure.axes
    np.testing.assert_array_equal(lines_of(errors)["residual (rms)"], [1.0, 1e-6, 1e-12])
    check_texts(figure, "linear solve", "error, dimensionless", "33 nodes")


def test_texts(make_solution, drawn, check_texts):
    check_texts(
        drawn(make_solution(settings=["motion.speed=0.5 m/s"])), "cycle, in order", "number of nodes",
        "error, dimensionless", "residual (rms)", "|load error|",
        "convergence, 500 mm/s, 800 N, 33 x 33 nodes: converged",
    )  # fmt: skip


def test_one_cycle(make_solution, make_rows, drawn):
    errors, _ = drawn(make_solution(rows=make_rows(grids=(65,), cycles=1))).axes
    assert errors.get_xlim() == (-0.5, 0.5)


def test_grids_come_back():
    rows = [{"grid": nodes} for nodes in (65, 65, 129, 65)]
    assert grids(rows) == [(0, 1), (2, 2), (3, 3)]


def test_speeds_on_one_grid_are_told_apart(make_solution, make_rows, drawn):
    """Of a walk in speed; the run's own has no name, wherever it stands."""
    own = 1e3 * make_solution().contact.speed
    rows = [row | {"speed_mm_s": speed} for speed in (own, 500.0, 250.0)
            for row in make_rows(grids=(129,), cycles=20)]  # fmt: skip
    assert grids(rows) == [(0, 19), (20, 39), (40, 59)]
    (above,) = drawn(make_solution(rows=rows)).axes[0].child_axes
    texts = [text.get_text() for text in above.get_xticklabels()]
    assert texts == ["129 nodes", "129 nodes, 500 mm/s", "129 nodes, 250 mm/s"]


@pytest.mark.parametrize("rows", [[{"grid": 1}], [{"residual": "x"}]])
def test_a_column_that_is_not_there(rows):
    with pytest.raises(OutputError, match="history.csv has no numbers in its column residual"):
        column(rows, "residual")


def test_no_cycles(make_solution, drawn):
    with pytest.raises(OutputError, match="history.csv has no cycles"):
        drawn(make_solution(rows=[]))
