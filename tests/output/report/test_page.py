"""Pages: numbers, columns of numbers, HTML that is whole and escaped."""

from base64 import b64encode
from math import inf, nan

import pytest

from mgehl.output.report.page import (
    BAD,
    NO_NUMBER,
    Cell,
    Page,
    Section,
    Text,
    number,
    picture,
    render,
    table,
)


def page_of(*blocks, **others):
    return Page("A title", "a subtitle", (Section("one", "First", blocks),), **others)


@pytest.mark.parametrize(
    "value, text",
    [(1.0, "1"), (-0.0, "0"), (1234567.0, "1.23457e+06"), (12345678, "12345678"), (1e-12, "1e-12")]
    + [(each, NO_NUMBER) for each in (nan, inf, -inf, None)],
)
def test_numbers(value, text):
    assert number(value) == text


@pytest.mark.parametrize("column, kinds", [
    (("1", "-2.5e-3", "", "none", NO_NUMBER, "3 of 7", "3..7"), ["number"] * 8),
    (("1", "a film", "a text that is broken into lines"), ["short", "short", "short", ""]),
    ((Cell("1", BAD), "2"), ["number", BAD, "number"]),
])  # fmt: skip
def test_columns_of_numbers_are_numbers_with_their_heading(column, kinds):
    made = table("", ("head",), [(text,) for text in column])
    assert [made.columns[0].kind, *(row[0].kind for row in made.rows)] == kinds


def test_a_heading_among_rows_does_not_count_and_what_is_no_row_is_left_out():
    made = table("", ("a", "b"), [(Cell("[grid]"),), False, ("x", "1")])
    assert [len(row) for row in made.rows] == [1, 2] and made.rows[1][1].kind == "number"
    assert '<th scope="rowgroup" colspan="2">[grid]</th>' in render(page_of(made))


def test_every_text_is_escaped():
    hostile = "<script>alert('1')</script> & \""
    pages = [
        page_of(Text(hostile)),
        page_of(table(hostile, ("a",), [("b",)])),
        page_of(table("c", (hostile,), [(hostile,)], folded=True)),
        page_of(picture(hostile, hostile, b"", "image/png", (4.0, 4.0))),
        page_of(verdict=(BAD, hostile, hostile)),
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


def test_the_title_says_the_verdict_and_sections_are_linked():
    html = render(page_of(verdict=(BAD, "Not converged", "it diverged")))
    assert "<title>A title: Not converged</title>" in html and "it diverged" in html
    assert '<a href="#one">First</a>' in html and '<section id="one"' in html
