"""Study machine on a tiny grid: what is drawn, and what is said of it."""

import csv

import numpy as np
import pytest

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.studies import drawn, machine
from mgehl.studies.drawn import HARD, PRESSURE, PRESSURE_OF_SOFT, SOFT, Drawn
from mgehl.studies.machine import draw


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture
def one_case(monkeypatch):
    """A steel ball with long waves, which 65 nodes show."""
    waves = {"kind": "waviness", "amplitude": 100e-9, "wavelength_x": 0.1e-3}
    bodies = {
        "radius_x": 0.01,
        "radius_y": 0.01,
        "reduced_modulus": 226e9,
        "load": 50.0,
        "boundary_film": 2e-9,
    }
    motion = {"speed": 0.01, "angle": 0.0}
    monkeypatch.setattr(
        machine, "draw", lambda *_: [Drawn(1, {"contact": bodies, "motion": motion, "surface": waves})]
    )


@pytest.mark.parametrize("steps, verdict", [(100, "converged"), (0, "NOT CONVERGED: ")])
def test_a_case(tmp_path, one_case, monkeypatch, steps, verdict):
    limits = drawn.AS_BY_DEFAULT | {"solver": {"error": True, "max_steps": steps}}
    monkeypatch.setattr(drawn, "AS_BY_DEFAULT", limits)
    here = tmp_path / "machine"
    status = main(["study", "machine", "--nodes", "65", "--quiet", "--out", str(here)])
    assert status == (0 if steps else 1)
    (found,) = read(here / "machine.csv")
    assert found["verdict"].startswith(verdict) and found["surface"] == "waves along x"
    assert (found["E' GPa"], found["layers nm"]) == ("226", "2")
    assert float(found["Sq nm"]) == pytest.approx(100.0 / 2.0**0.5, abs=1.0)
    assert ("±" in found["mean gap nm"]) is bool(steps)
    said = {each["what"]: each["value"] for each in read(here / "machine-summary.csv")}
    assert said["converged"] == ("1 (100.0 %)" if steps else "0 (0.0 %)")
    assert said["not settled"] == ("0" if steps else "1")


class TestWhatIsDrawn:
    @pytest.fixture(scope="class")
    def cases(self):
        return draw(60, 3)

    def test_more_cases_begin_with_the_same(self, cases):
        assert cases[:5] == draw(5, 3) != draw(5, 4)

    def test_pressures_and_films_are_what_was_drawn(self, cases):
        contacts = [contact_from(config_from_tables(case.tables)) for case in cases]
        moduli = {contact.reduced_modulus for contact in contacts}
        assert moduli == {*HARD, *SOFT}
        for contact in contacts:
            of_soft = contact.reduced_modulus in SOFT
            p_h = contact.hertz.p_h / (contact.reduced_modulus if of_soft else 1.0)
            low, high = PRESSURE_OF_SOFT if of_soft else PRESSURE
            assert low * (1.0 - 1e-9) <= p_h <= high * (1.0 + 1e-9)

    def test_surfaces_have_the_roughness_they_were_given(self):
        """Of every sort, about 100 nm rms."""
        chance = np.random.default_rng(1)
        for number in range(1, 30):
            surface = machine.surface_of(chance, number, 1e-7, 1e-5)
            contact = contact_from(config_from_tables({"motion": {"speed": 1.0}, "surface": surface}))
            assert contact.roughness == pytest.approx(1e-7, rel=0.25)

    def test_there_are_all_sorts(self, cases):
        surfaces = {machine.finish(case.tables["surface"]) for case in cases}
        assert {"waves along x", "waves along y", "waves along x and y", "random 1:1"} <= surfaces
        angles = [case.tables["motion"]["angle"] for case in cases]
        assert 0.1 < np.mean([angle > 0.0 for angle in angles]) < 0.6
