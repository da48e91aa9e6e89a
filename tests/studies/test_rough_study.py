"""Study rough on a tiny grid, and what becomes of points that did not converge."""

import csv

import pytest

from mgehl.cli import main
from mgehl.model.load_share import aihara
from mgehl.studies import rough
from mgehl.studies.study import merged

NUMBERS = ("load on contact", "load on solids", "contact/Hertz area", "patches", "minimum film nm", "torn")


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A function: two speeds of long waves on 65 nodes; the exit status, directory and rows."""
    smooth = {"surface": {"rms": 20e-9, "shortest_wavelength": 90e-6}}
    for name, value in {"FASTEST": 0.01, "SLOWEST": 0.005, "COUNT": 2}.items():
        monkeypatch.setattr(rough, name, value)
    monkeypatch.setattr(rough, "CASE", merged(rough.CASE, smooth))
    here = tmp_path / "rough"

    def run(*words):
        status = main(["study", "rough", "--nodes", "65", "--quiet", "--out", str(here), *words])
        return status, here, read(here / "rough.csv")

    return run


def test_two_speeds_from_both_starts(study):
    status, here, rows = study("--set", "contact.boundary_film=10 nm")
    files = {"rough.csv", "rough.md", "load-share.png", "points", "study.json"}
    assert status == 0 and {path.name for path in here.iterdir()} == files
    assert [(row["speed mm/s"], row["start"]) for row in rows] == [
        ("10", "film"), ("10", "contact"), ("5", "film"), ("5", "contact"),
    ]  # fmt: skip
    for row in rows:
        assert row["verdict"] == "converged"
        assert 0.0 < float(row["load on solids"]) < float(row["load on contact"]) < 0.2
        assert float(row["load on contact apart from the other start"]) < 1e-5
        assert float(row["minimum film nm"]) >= 10.0
        assert float(row["Aihara"]) == pytest.approx(aihara(float(row["lambda"])), abs=1e-3)
    for fast, slow in zip(rows[:2], rows[2:], strict=True):
        assert float(slow["lambda"]) == pytest.approx(float(fast["lambda"]) * 0.5**0.67, rel=1e-3)
        assert float(slow["load on contact"]) > float(fast["load on contact"])
    assert study("--set", "contact.boundary_film=10 nm", "--resume")[2] == rows
    assert len(list((here / "points").iterdir())) == 4


def test_points_that_do_not_converge_have_a_verdict_and_no_numbers(study):
    status, here, rows = study("--set", "solver.max_steps=1")
    assert status == 1 and all(row["verdict"].startswith("NOT CONVERGED: ") for row in rows)
    assert {row[name] for row in rows for name in NUMBERS} == {""}
    assert {row["load on contact apart from the other start"] for row in rows} == {""}
    assert (here / "load-share.png").read_bytes().startswith(b"\x89PNG")
