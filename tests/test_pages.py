"""Numbers on the page of results stand in the tables that are linked beside them."""

import csv
import re

import pytest
from places import ROOT

RUNS = ROOT / "runs"
PAGE = RUNS / "README.md"
NUMBER = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?"
QUOTED = re.compile(r"`([-+]?\d[^`]*)`")
LINK = re.compile(r"\]\((tables/[^)]+)\)")


def passages(text):
    return [part for part in re.split(r"\n(?=\||- )|\n\n", text) if QUOTED.search(part)]


def tables(passage):
    """The CSV files that a passage links to, a picture's being those of its study."""
    found = set()
    for link in LINK.findall(passage):
        path = RUNS / link
        stem = re.sub(r"-(films|figure-\d+\w?|figures-\d+-\d+)$", "", path.stem)
        own = path.with_suffix(".csv")
        found |= {own} if own.exists() else set(path.parent.glob(f"{stem}*.csv"))
    return sorted(found)


def numbers(path):
    with path.open() as file:
        return {text for row in csv.reader(file) for cell in row for text in re.findall(NUMBER, cell)}


@pytest.mark.parametrize("passage", passages(PAGE.read_text()), ids=lambda text: text[:40].strip("|- "))
def test_every_number_quoted_is_in_a_table_linked_beside_it(passage):
    known = set().union(*(numbers(path) for path in tables(passage)))
    quoted = [number for span in QUOTED.findall(passage) for number in re.findall(NUMBER, span)]
    assert [number for number in quoted if number not in known] == []


def test_the_page_quotes_numbers():
    assert len(QUOTED.findall(PAGE.read_text())) > 20


def test_every_file_linked_is_there():
    links = LINK.findall(PAGE.read_text())
    assert len(links) > 5
    assert [link for link in links if not (RUNS / link).exists()] == []
