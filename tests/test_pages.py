"""Numbers on the page of results stand in tables that a study wrote."""

import csv
import re
from pathlib import Path

import pytest

RUNS = Path(__file__).parents[1] / "runs"
PAGE = RUNS / "README.md"
QUOTED = re.compile(r"`([-+]?\d[\d.]*(?:e[-+]?\d+)?)`")


@pytest.fixture(scope="module")
def cells():
    """Every number of every table, as it is written there."""
    texts = set()
    for table in (RUNS / "tables").glob("*.csv"):
        with table.open() as file:
            for row in csv.reader(file):
                for cell in row:
                    texts.update(re.findall(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?", cell))
    return texts


def test_every_number_quoted_is_in_a_table(cells):
    quoted = QUOTED.findall(PAGE.read_text())
    assert len(quoted) > 20
    assert [number for number in quoted if number not in cells] == []


def test_every_file_linked_is_there():
    links = re.findall(r"\]\((tables/[^)]+)\)", PAGE.read_text())
    assert len(links) > 5
    assert [link for link in links if not (RUNS / link).exists()] == []
