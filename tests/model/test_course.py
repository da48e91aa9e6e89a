import pytest

from mgehl.model.course import Own, Table
from mgehl.model.own_function import OwnFunction
from mgehl.model.text_table import FileError


@pytest.fixture
def table(tmp_path):
    def written(text):
        path = tmp_path / "speed.csv"
        path.write_text(text)
        return Table(str(path))

    return written


def test_a_table_is_straight_between_its_rows(table):
    course = table("t s, u m/s\n0, 1\n2, 3\n4, 3\n")
    assert course.value(1.0) == 2.0
    assert course.integral(1.0, 3.0) == pytest.approx(2.5 + 3.0)
    assert course.range(3.0) == (1.0, 3.0)
    assert course.kinks() == (0.0, 2.0, 4.0)


TEXTS = {
    "commas": "\ufeff# a comment\n0,1\n\n1,2\n",
    "decimal commas between semicolons": "t;v\n0,0;1,25\n0,5;1,5\n1,0;1,75\n",
    "an empty comment above": "# made by hand\n#\n0 1\n1 2\n",
    "quoted decimal commas between commas": '"0,0","1,25"\n"1,0","1,75"\n',
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_tables_as_they_come(table, text):
    assert table(text).value(0.5) == 1.5


@pytest.mark.parametrize(
    "text, what",
    [("0,1\n", "two or more"), ("0,1\n1,2\n0.5,3\n", "does not rise from 1 s on"),
     ("0;20\n0.5;20\n0.5;40\n1;40\n", "lines 2 and 3 have the same time, 0.5 s: a jump"),
     ("0,1,9\n1,2,9\n", "must have two columns, times and values; has 3"),
     ("0\n1\n", "two columns, times and values; has 1"), ("0,1\n1,\n2,3\n", "line 2 has no two numbers"),
     ("0,1\n1,nan\n2,3\n", "line 2 has no two numbers"),
     ("t;v\nx;y\n", "has no row of numbers: line 1 is 't;v'"),
     ("t;v;what\n0,0;0,5;start\n1,0;0,5;end\n", "has no row of numbers: 'start' in line 2 is none"),
     ("0,1\n1,x\n", "'x' is no number"), ("0,1\n0.5,2\n", "must cover 0 to 1"),
     ("0.1,1\n2,2\n", "must cover 0 to 1")],
)  # fmt: skip
def test_what_is_wrong_with_a_table(table, text, what):
    with pytest.raises(FileError, match=what):
        table(text).check(1.0)


def test_a_table_may_end_where_the_run_does_but_for_its_digits(table):
    table("0,1\n0.9999995,2\n").check(1.0)


def test_a_function_of_ones_own(tmp_path):
    (tmp_path / "mine.py").write_text("def speed(t):\n    return 3.0 * t**2\n")
    course = Own(OwnFunction(f"{tmp_path}/mine.py:speed"))
    assert course.value(2.0) == 12.0
    assert course.integral(1.0, 2.0) == pytest.approx(7.0)
    # Of values from 0 to 27 a straight line from 1 s to 2 s is at most 3/4 above the curve.
    assert course.bend(1.0, 2.0, 3.0) == pytest.approx(0.75 / 27.0, rel=1e-3)


def test_a_wave_with_a_period_of_even_times_is_seen(tmp_path):
    """A thousand periods in a run were constant: "load 20 to 20 N"."""
    (tmp_path / "mine.py").write_text(
        "from math import pi, sin\ndef load(t): return 20 + 15 * sin(2e3 * pi * t)\n"
    )
    assert Own(OwnFunction(f"{tmp_path}/mine.py:load")).range(1.0) == pytest.approx((5.0, 35.0), abs=0.1)


def test_a_peak_between_the_samples_is_met_in_a_step(tmp_path):
    peak = "def load(t): return 20 + 40 * max(0, 1 - abs(t - 0.25049) / 2e-4)\n"
    (tmp_path / "mine.py").write_text(peak)
    assert Own(OwnFunction(f"{tmp_path}/mine.py:load")).bend(0.2502, 0.2508, 1.0) > 0.5
