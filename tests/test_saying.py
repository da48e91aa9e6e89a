"""Lines for a terminal of some width."""

import pytest

from mgehl.saying import columns, folded

LINE = "name      " + " ".join(f"word{k}" for k in range(20))


def test_a_line_is_broken_at_spaces_and_nothing_is_lost():
    lines = folded(LINE, " " * 10, 40).splitlines()
    assert max(map(len, lines)) <= 40 and " ".join(lines).split() == LINE.split()
    assert lines[0].startswith("name      word0 ") and all(each.startswith(" " * 10) for each in lines[1:])


@pytest.mark.parametrize("width", [None, len(LINE)])
def test_a_line_that_has_room_stays(width):
    assert folded(LINE, " ", width) == LINE


def test_a_path_stays_whole_beside_its_name():
    line = "name      /a/path" + 40 * "/x"
    assert folded(line, " " * 10, 40) == line


def test_a_terminal_narrower_than_the_indent_is_no_end():
    assert folded(LINE, " " * 10, 5).split() == LINE.split()


@pytest.mark.parametrize("said, width", [("80", 80), ("0", None), ("-1", None), ("wide", None), ("", None)])
def test_columns_that_the_environment_says(monkeypatch, capsys, said, width):
    monkeypatch.setenv("COLUMNS", said)
    assert columns() == width


def test_no_terminal_has_none(monkeypatch, capsys):
    monkeypatch.delenv("COLUMNS", raising=False)
    assert columns() is None
