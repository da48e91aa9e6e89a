"""Pages: numbers, columns of numbers, HTML that is whole and escaped."""

from math import inf, nan

import pytest

from mgehl.output.report.page import BAD, NO_NUMBER, number, picture, render, table


def page_of(**parts):
    page = {"title": "A title", "subtitle": "a subtitle", "verdict": None, "what": []}
    return page | {"tables": [], "pictures": [], "origin": None} | parts


@pytest.mark.parametrize(
    "value, text",
    [(1.0, "1"), (-0.0, "0"), (1234567.0, "1.23457e+06"), (12345678, "12345678"), (1e-12, "1e-12")]
    + [(each, NO_NUMBER) for each in (nan, inf, -inf, None)],
)
def test_numbers(value, text):
    assert number(value) == text


def test_every_text_is_escaped():
    hostile = "<script>alert('1')</script> & \""
    for parts in (
        {"what": [hostile]},
        {"tables": [table(hostile, ("a",), [("b",)])]},
        {"tables": [table("c", (hostile,), [(hostile,)], folded=True)]},
        {"pictures": [picture(hostile, hostile, b"", "image/png", (4.0, 4.0))]},
        {"verdict": (BAD, hostile, hostile)},
        {"title": hostile, "subtitle": hostile},
    ):
        html = render(page_of(**parts))
        assert "<script" not in html and "alert(&#39;1&#39;)" in html


def test_the_title_says_the_verdict_and_sections_are_linked():
    html = render(page_of(verdict=(BAD, "Not converged", "it diverged")))
    assert "<title>A title: Not converged</title>" in html and "it diverged" in html
    assert '<a href="#what">What it is</a>' in html and '<section id="what"' in html
