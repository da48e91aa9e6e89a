import numpy as np
import pytest

from mgehl.errors import OutputError
from mgehl.output.pictures.history import history


def lines_of(axes):
    return {line.get_label(): line.get_ydata() for line in axes.get_lines()}


def test_residual_load_error_and_sets_against_the_cycles_in_order(make_solution, make_rows, drawn):
    rows = make_rows(grids=(65, 129), cycles=4)
    errors, sets = drawn(history, make_solution(rows=rows)).axes
    np.testing.assert_array_equal(errors.get_lines()[0].get_xdata(), np.arange(8))
    np.testing.assert_array_equal(lines_of(errors)["residual (rms)"], [row["residual"] for row in rows])
    off = [abs(row["load_error"]) for row in rows]
    np.testing.assert_array_equal(lines_of(errors)["|load error|"], off)
    for name, label in (("contact", "in contact"), ("cavitated", "cavitated"), ("changed", "changed")):
        np.testing.assert_array_equal(lines_of(sets)[label], [row[f"{name}_nodes"] for row in rows])
    assert errors.get_yscale() == "log" and sets.get_yscale() == "symlog"


def test_no_cycles(make_solution, drawn):
    with pytest.raises(OutputError, match="history.csv has no cycles"):
        drawn(history, make_solution(rows=[]))
