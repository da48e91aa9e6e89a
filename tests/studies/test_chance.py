import numpy as np
import pytest
from told import rows_of

from mgehl.cli import main
from mgehl.studies import machine, mixed, rollers, study
from mgehl.studies.chance import Drawn
from mgehl.studies.study import merged

GRIDS = {"mixed": "65", "machine": "65", "rollers": "257"}


def run(name, directory, *words):
    return main(["study", name, "--nodes", GRIDS[name], "--quiet", "--out", str(directory), *words])


def said(directory, name):
    (row,) = rows_of(directory / f"{name}-summary.csv")
    return row


@pytest.fixture
def long_waves(monkeypatch):
    """Little roughness, in waves that 65 nodes resolve."""
    surface = {"surface": {"shortest_wavelength": 90e-6}}
    monkeypatch.setattr(mixed, "COMMON", merged(mixed.COMMON, surface))
    monkeypatch.setattr(mixed, "RMS", (10e-9, 20e-9))
    monkeypatch.setattr(mixed, "SPEED", (0.005, 0.05))


class TestBalls:
    def test_two_cases(self, tmp_path, long_waves, monkeypatch):
        here = tmp_path / "mixed"
        assert run("mixed", here, "--cases", "2", "--seed", "3") == 0
        rows, whole = rows_of(here / "mixed.csv"), said(here, "mixed")
        for case, found in zip(mixed.draw(2, 3), rows, strict=True):
            assert float(found["rms nm"]) == pytest.approx(1e9 * case.tables["surface"]["rms"], abs=0.05)
            assert found["verdict"] == "converged" and float(found["lambda"]) > 0.0
            assert 0.0 <= float(found["load on solids"]) <= float(found["load on contact"])
            assert 0.0 <= float(found["made"]) < 1e-6 and float(found["convolutions"]) > 5
        assert whole["converged"] == "2" and whole["not settled"] == "0"
        mean = np.mean([float(each["convolutions"]) for each in rows])
        assert float(whole["convolutions, mean"]) == pytest.approx(mean, abs=0.1)
        most = max(float(each["made"]) for each in rows)
        assert float(whole["largest made"]) == most
        assert len(list((here / "runs").iterdir())) == 2
        monkeypatch.setattr(study, "run", None)  # nothing is solved again
        assert run("mixed", here, "--cases", "2", "--seed", "3", "--resume") == 0
        assert rows_of(here / "mixed.csv") == rows

    def test_a_case_that_fails_is_told_by_the_exit_status(self, tmp_path, long_waves):
        here = tmp_path / "mixed"
        assert run("mixed", here, "--cases", "1", "--set", "solver.max_steps=1") == 1
        (found,) = rows_of(here / "mixed.csv")
        assert found["verdict"].startswith("NOT CONVERGED: ")
        assert said(here, "mixed")["converged"] == "0" and said(here, "mixed")["not settled"] == "1"


STEEL = {"reduced_modulus": 226e9, "boundary_film": 2e-9}
ONE = {
    "machine": {"contact": {"radius_x": 0.01, "radius_y": 0.01, "load": 50.0, **STEEL},
                "motion": {"speed": 0.01, "angle": 0.0}},
    "rollers": {"contact": {"kind": "line", "radius_x": 0.01, "load_per_length": 2e5, **STEEL},
                "motion": {"speed": 0.03}},
}  # fmt: skip
"""A steel ball and a steel roller with long waves, which the grids show."""


@pytest.mark.parametrize("name, module", [("machine", machine), ("rollers", rollers)])
class TestMachines:
    def test_a_case(self, tmp_path, monkeypatch, name, module):
        waves = {"kind": "waviness", "amplitude": 100e-9, "wavelength_x": 0.1e-3}
        own = ONE[name] | {"surface": waves, "solver": {"error": True}}
        monkeypatch.setattr(module, "draw", lambda *_: [Drawn(1, "steel", own)])
        assert run(name, tmp_path / name) == 0
        (found,) = rows_of(tmp_path / name / f"{name}.csv")
        assert (found["E' GPa"], found["layers nm"], found["verdict"]) == ("226", "2", "converged")
        assert found.get("surface", found.get("profile")).startswith("waves")
        assert "±" in found["mean gap nm"]
        assert float(found["Sq nm"]) == pytest.approx(100.0 / 2.0**0.5, abs=1.0)
        assert said(tmp_path / name, name)["with a band about the mean gap"] == "1"
