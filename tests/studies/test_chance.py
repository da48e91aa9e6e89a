"""Studies mixed, machine and rollers on tiny grids: what is drawn, what is kept, what is said of all."""

import csv
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.errors import UserError
from mgehl.kinds import contact_from
from mgehl.studies import chance, machine, mixed, rollers, study
from mgehl.studies.chance import Drawn, summary
from mgehl.studies.machine import HARD, PRESSURE, PRESSURE_OF_SOFT, SOFT
from mgehl.studies.study import merged

GRIDS = {"mixed": "65", "machine": "65", "rollers": "257"}


def run(name, directory, *words):
    return main(["study", name, "--nodes", GRIDS[name], "--quiet", "--out", str(directory), *words])


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def said(directory, name):
    (row,) = read(directory / f"{name}-summary.csv")
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
        rows, whole = read(here / "mixed.csv"), said(here, "mixed")
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
        assert len(list((here / "points").iterdir())) == 2
        monkeypatch.setattr(study, "solve", None)  # nothing is solved again
        assert run("mixed", here, "--cases", "2", "--seed", "3", "--resume") == 0
        assert read(here / "mixed.csv") == rows

    def test_a_case_that_fails_is_told_by_the_exit_status(self, tmp_path, long_waves):
        here = tmp_path / "mixed"
        assert run("mixed", here, "--cases", "1", "--set", "solver.max_steps=1") == 1
        (found,) = read(here / "mixed.csv")
        assert found["verdict"].startswith("NOT CONVERGED: ")
        assert said(here, "mixed")["converged"] == "0" and said(here, "mixed")["not settled"] == "1"

    def test_a_case_that_breaks_off_is_said_and_passed(self, tmp_path, long_waves, monkeypatch):
        """The others have their rows; it is counted among those that did not settle."""
        whole, here = study.solve, tmp_path / "mixed"

        def broken(config, comm):
            if config.surface.seed == 1:
                raise UserError("there is no room")
            return whole(config, comm)

        monkeypatch.setattr(study, "solve", broken)
        assert run("mixed", here, "--cases", "2", "--seed", "3") == 1
        lost, good = read(here / "mixed.csv")
        assert (lost["case"], lost["verdict"]) == ("1", "NOT SOLVED: there is no room")
        assert good["verdict"] == "converged" and said(here, "mixed")["not settled"] == "1"

    def test_all_lie_within_their_limits_and_fill_them(self):
        cases = mixed.draw(400, 1)
        keys = {"surface.rms": mixed.RMS, "contact.load": mixed.LOAD, "motion.speed": mixed.SPEED}
        for name, (low, high) in keys.items():
            section, key = name.split(".")
            values = [case.tables[section][key] / low for case in cases]
            shares = np.log(values) / np.log(high / low)
            assert 0.0 <= shares.min() < 0.02 and 0.98 < shares.max() <= 1.0
            assert abs(shares.mean() - 0.5) < 0.05
        assert {case.tables["surface"]["seed"] for case in cases} == set(range(1, 401))


STEEL = {"reduced_modulus": 226e9, "boundary_film": 2e-9}
ONE = {
    "machine": {
        "contact": {"radius_x": 0.01, "radius_y": 0.01, "load": 50.0, **STEEL},
        "motion": {"speed": 0.01, "angle": 0.0},
    },
    "rollers": {
        "contact": {"kind": "line", "radius_x": 0.01, "load_per_length": 2e5, **STEEL},
        "motion": {"speed": 0.03},
    },
}
"""A steel ball and a steel roller with long waves, which the grids show."""


@pytest.mark.parametrize("name, module", [("machine", machine), ("rollers", rollers)])
class TestMachines:
    def test_a_case(self, tmp_path, monkeypatch, name, module):
        waves = {"kind": "waviness", "amplitude": 100e-9, "wavelength_x": 0.1e-3}
        own = ONE[name] | {"surface": waves, "solver": {"error": True}}
        monkeypatch.setattr(module, "draw", lambda *_: [Drawn(1, "steel", own)])
        assert run(name, tmp_path / name) == 0
        (found,) = read(tmp_path / name / f"{name}.csv")
        assert (found["E' GPa"], found["layers nm"], found["verdict"]) == ("226", "2", "converged")
        assert found.get("surface", found.get("profile")).startswith("waves")
        assert "±" in found["mean gap nm"]
        assert float(found["Sq nm"]) == pytest.approx(100.0 / 2.0**0.5, abs=1.0)
        assert said(tmp_path / name, name)["with a band about the mean gap"] == "1"

    def test_pressures_and_films_are_what_was_drawn(self, name, module):
        contacts = [contact_from(config_from_tables(case.tables)) for case in module.draw(60, 3)]
        assert {contact.reduced_modulus for contact in contacts} == {*HARD, *SOFT}
        for contact in contacts:
            of_soft = contact.reduced_modulus in SOFT
            p_h = contact.hertz.p_h / (contact.reduced_modulus if of_soft else 1.0)
            low, high = PRESSURE_OF_SOFT if of_soft else PRESSURE
            assert low * (1.0 - 1e-9) <= p_h <= high * (1.0 + 1e-9)


@pytest.mark.parametrize("module", [mixed, machine, rollers])
def test_more_cases_begin_with_the_same(module):
    assert module.draw(9, 7)[:3] == module.draw(3, 7) != module.draw(3, 8)


def test_surfaces_of_machines_have_the_roughness_they_were_given():
    """Of every sort, about 100 nm rms."""
    some, sorts = np.random.default_rng(1), set()
    for number in range(1, 30):
        surface = machine.surface_of(some, number, 1e-7, 1e-5)
        sorts.add(machine.finish(surface))
        contact = contact_from(config_from_tables({"motion": {"speed": 1.0}, "surface": surface}))
        assert contact.roughness == pytest.approx(1e-7, rel=0.25)
    assert {"waves along x", "waves along y", "waves along x and y", "random 1:1"} <= sorts


def result(convolutions, band, made=1e-12, **verdict):
    """What a summary asks of a `Result`."""
    error = None if band is None else SimpleNamespace(mean_nm=band)
    parts = {"work": SimpleNamespace(convolutions=convolutions), "mixed": SimpleNamespace(error=error)}
    parts |= {"mass": SimpleNamespace(made_share=made)}
    return SimpleNamespace(**{"converged": True, "settled": True} | verdict, **parts)


def test_the_summary_tells_converged_doubted_and_not_settled_apart():
    numbers = summary(
        [
            result(100.0, 0.2),
            result(200.0, None),
            result(600.0, 0.1, made=3e-10),
            result(9.0, 0.1, made=1.0, converged=False),
            result(2000.0, 0.1, converged=False, settled=False),
        ],
        lost=1,
    )
    assert numbers["with a band about the mean gap"] == "2"
    verdicts = [numbers[what] for what in ("cases", "converged", "in doubt", "not settled")]
    assert verdicts == ["6", "3", "1", "2"]
    assert numbers["mean of the converged"] == "300.0"
    assert (numbers["median"], numbers["most"]) == ("200.0", "2000.0")
    assert numbers["largest made"] == "3.0e-10"


@pytest.mark.parametrize(
    "word", ["--cases=0", "--seed=-1", "--cases=ten", "--seed=1.5", "--seed=9999999999"]
)
def test_numbers_that_are_none_are_refused_in_a_line(capsys, tmp_path, word):
    assert run("mixed", tmp_path / "mixed", word) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert word.replace("=", " ") in line and "must be a whole number from" in line


def test_other_studies_draw_nothing(capsys, tmp_path):
    assert main(["study", "dry", "--cases", "3", "--out", str(tmp_path / "dry")]) == 2
    assert "--cases 3: means nothing to study dry" in capsys.readouterr().err


def test_the_seed_by_default_is_none_of_those_that_constants_were_chosen_on():
    assert chance.drawn_of(SimpleNamespace(wanted=3, seed=None), mixed.draw, 9) == mixed.draw(3, 2030)
