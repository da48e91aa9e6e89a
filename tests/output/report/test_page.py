"""Pages: cells, columns of numbers, HTML that is whole and escaped, files that are replaced whole."""

from base64 import b64encode
from math import inf, nan

import pytest

from mgehl.errors import OutputError
from mgehl.output.report.page import (
    BAD,
    NO_NUMBER,
    Cell,
    Page,
    Section,
    Text,
    Verdict,
    number,
    picture,
    render,
    table,
    write_page,
)


def page_of(*blocks, **others):
    return Page("A title", "a subtitle", (Section("one", "First", blocks),), **others)


@pytest.mark.parametrize(
    "value, text",
    [(1.0, "1"), (-0.0, "0"), (1234567.0, "1.23457e+06"), (12345678, "12345678"), (1e-12, "1e-12")],
)
def test_numbers(value, text):
    assert number(value) == text


@pytest.mark.parametrize("value", [nan, inf, -inf, None])
def test_what_is_no_number_is_called_so(value):
    assert number(value) == NO_NUMBER


class TestTable:
    def kinds(self, *column):
        made = table("", ("head",), [(text,) for text in column])
        return [made.columns[0].kind, *(row[0].kind for row in made.rows)]

    def test_columns_of_numbers_are_numbers_with_their_heading(self):
        assert self.kinds("1", "-2.5e-3", "", "none", NO_NUMBER, "3 of 7", "3 to 7") == ["number"] * 8

    def test_other_columns_are_not(self):
        assert self.kinds("1", "a film", "a text that is broken into lines") == [
            "short",
            "short",
            "short",
            "",
        ]
        assert "number" not in self.kinds("", "")

    def test_a_cell_that_is_something_stays_so(self):
        assert self.kinds(Cell("1", BAD), "2") == ["number", BAD, "number"]

    def test_a_heading_among_rows_does_not_count(self):
        made = table("", ("a", "b"), [(Cell("[grid]"),), ("x", "1")])
        assert [len(row) for row in made.rows] == [1, 2] and made.rows[1][1].kind == "number"
        assert '<th scope="rowgroup" colspan="2">[grid]</th>' in render(page_of(made))


def test_every_text_is_escaped():
    hostile = "<script>alert('1')</script> & \""
    pages = [
        page_of(Text(hostile)),
        page_of(table(hostile, ("a",), [("b",)])),
        page_of(table("c", (hostile,), [(hostile,)], folded=True)),
        page_of(picture(hostile, hostile, b"", "image/png", (4.0, 4.0))),
        page_of(verdict=Verdict(BAD, hostile, hostile), highlights=((hostile, hostile),)),
        Page(hostile, hostile, (Section("one", hostile, ()),)),
    ]
    for page in pages:
        html = render(page)
        assert "<script" not in html and "alert(&#39;1&#39;)" in html


def test_a_picture_is_part_of_the_page():
    html = render(page_of(picture("caption", "what it shows", b"\x89PNG", "image/png", (8.4, 4.0))))
    data = b64encode(b"\x89PNG").decode()
    assert f'<img src="data:image/png;base64,{data}" alt="what it shows">' in html
    assert (
        '<figure class="wide" style="--inches: 8.4">' in html and "<figcaption>caption</figcaption>" in html
    )


def test_long_tables_are_folded_where_asked_for():
    rows = [(str(k),) for k in range(3)]
    assert "<details>" not in render(page_of(table("nodes", ("i",), rows)))
    assert "<summary>nodes (3 rows)</summary>" in render(page_of(table("nodes", ("i",), rows, folded=True)))


def test_the_title_says_the_verdict():
    html = render(page_of(verdict=Verdict(BAD, "Not converged", "it diverged")))
    assert "<title>A title: Not converged</title>" in html
    assert '<div class="verdict bad">' in html and "it diverged" in html
    assert "<title>A title</title>" in render(page_of())


def test_sections_are_listed_and_linked():
    assert '<a href="#one">First</a>' in render(page_of())
    assert '<section id="one" aria-labelledby="one-heading">' in render(page_of())


class TestWritePage:
    def test_nothing_else_is_left(self, tmp_path):
        write_page(tmp_path / "page.html", page_of())
        assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
        assert (tmp_path / "page.html").read_text(encoding="utf-8") == render(page_of())

    def test_a_page_that_fails_leaves_the_old_one(self, tmp_path, monkeypatch):
        (tmp_path / "page.html").write_text("old")

        def full(_file):
            raise OSError(28, "No space left on device")

        monkeypatch.setattr("mgehl.output.whole_file.os.fsync", full)
        with pytest.raises(OutputError, match="page.html: cannot be written: No space left on device"):
            write_page(tmp_path / "page.html", page_of())
        assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
        assert (tmp_path / "page.html").read_text() == "old"

    def test_a_directory_that_is_not_there(self, tmp_path):
        with pytest.raises(OutputError, match="page.html: cannot be written: No such file"):
            write_page(tmp_path / "none" / "page.html", page_of())

    def test_a_directory_in_the_place_of_the_file(self, tmp_path):
        (tmp_path / "page.html").mkdir()
        with pytest.raises(OutputError, match="page.html: cannot be written"):
            write_page(tmp_path / "page.html", page_of())
        assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
