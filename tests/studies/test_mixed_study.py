"""Study mixed on a tiny grid: what is drawn, what is kept, what is said of cases that fail."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from mgehl.cli import main
from mgehl.studies import mixed
from mgehl.studies.mixed import Found, draw, row, summary
from mgehl.studies.study import merged


def study(directory, *words):
    return main(["study", "mixed", "--nodes", "65", "--quiet", "--out", str(directory), *words])


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture
def long_waves(monkeypatch):
    """Little roughness, in waves that 65 nodes resolve."""
    surface = {"surface": {"shortest_wavelength": 90e-6}}
    monkeypatch.setattr(mixed, "CASE", merged(mixed.CASE, surface))
    monkeypatch.setattr(mixed, "RMS", (10e-9, 20e-9))
    monkeypatch.setattr(mixed, "SPEED", (0.005, 0.05))


def test_two_cases(tmp_path, long_waves, monkeypatch):
    here = tmp_path / "mixed"
    assert study(here, "--cases", "2", "--seed", "3") == 0
    rows, whole = read(here / "mixed.csv"), read(here / "mixed-summary.csv")
    for case, found in zip(draw(2, 3), rows, strict=True):
        assert float(found["rms nm"]) == pytest.approx(1e9 * case.rms, abs=0.05)
        assert found["verdict"] == "converged" and float(found["lambda"]) > 0.0
        assert float(found["convolutions"]) > 5 and float(found["overlap/Sq"]) <= 1e-3
    said = {each["what"]: each["value"] for each in whole}
    assert said["converged"] == "2 (100.0 %)" and said["not settled"] == "0"
    mean = np.mean([float(each["convolutions"]) for each in rows])
    assert float(said["convolutions, mean"]) == pytest.approx(mean, abs=0.1)
    assert len(list((here / "points").iterdir())) == 2

    def never(*_):
        raise AssertionError("is solved again")

    monkeypatch.setattr(mixed, "solve", never)
    assert study(here, "--cases", "2", "--seed", "3", "--resume") == 0
    assert read(here / "mixed.csv") == rows


def test_a_case_that_fails_is_told_by_the_exit_status(tmp_path, long_waves, monkeypatch):
    monkeypatch.setattr(mixed, "CASE", merged(mixed.CASE, {"solver": {"max_steps": 1}}))
    assert study(tmp_path / "mixed", "--cases", "1") == 1
    (found,) = read(tmp_path / "mixed" / "mixed.csv")
    assert found["verdict"].startswith("NOT CONVERGED: ")
    said = {each["what"]: each["value"] for each in read(tmp_path / "mixed" / "mixed-summary.csv")}
    assert said["converged"] == "0 (0.0 %)" and said["not settled"] == "1"
    assert said["largest overlap/Sq of the converged"] == "none"


class TestWhatIsDrawn:
    def test_more_cases_begin_with_the_same(self):
        assert draw(20, 7)[:5] == draw(5, 7) != draw(5, 8)

    def test_all_lie_within_their_limits_and_fill_them(self):
        cases = draw(400, 1)
        for name, (low, high) in {"rms": mixed.RMS, "load": mixed.LOAD, "speed": mixed.SPEED}.items():
            shares = np.log([getattr(case, name) / low for case in cases]) / np.log(high / low)
            assert 0.0 <= shares.min() < 0.02 and 0.98 < shares.max() <= 1.0
            assert abs(shares.mean() - 0.5) < 0.05
        assert {case.number for case in cases} == set(range(1, 401))

    def test_each_has_a_surface_of_its_own(self):
        one, other = (case.tables(257)["surface"]["seed"] for case in draw(2, 7))
        assert one != other


GOOD = Found(True, True, "", "all holds", 0.5, 0.25, 40, 9.0, 1e-5, 100.0, 12, 3.0)


def test_the_summary_tells_converged_doubted_and_not_settled_apart():
    doubted = replace(GOOD, converged=False, doubt="Eq. 2 is broken", overlap=9.0, convolutions=300.0)
    lost = replace(doubted, settled=False, doubt="", convolutions=1100.0)
    said = {each["what"]: each["value"] for each in summary([GOOD, doubted, lost])}
    assert [said[what] for what in ("settled, and in doubt", "not settled")] == ["1", "1"]
    assert said["convolutions, mean"] == "500.0" and said["convolutions, median"] == "300.0"
    assert said["convolutions of the converged, mean"] == "100.0"
    assert said["largest overlap/Sq of the converged"] == "1.0e-05"
    (case,) = draw(1, 7)
    assert row(case, doubted)["verdict"] == "Eq. 2 is broken: all holds"


@pytest.mark.parametrize(
    "word", ["--cases=0", "--seed=-1", "--cases=ten", "--seed=1.5", "--seed=9999999999"]
)
def test_numbers_that_are_none_are_refused_in_a_line(capsys, tmp_path, word):
    assert study(tmp_path / "mixed", word) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert word.replace("=", " ") in line and "must be a whole number from" in line


def test_other_studies_draw_nothing(capsys, tmp_path):
    assert main(["study", "inlet", "--cases", "3", "--out", str(tmp_path / "inlet")]) == 2
    assert "--cases 3: means nothing to study inlet" in capsys.readouterr().err
