"""Study rollers on a small grid: what is drawn, and what is said of it."""

import csv

import pytest

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.studies import rollers
from mgehl.studies.drawn import HARD, PRESSURE, PRESSURE_OF_SOFT, SOFT, Drawn
from mgehl.studies.rollers import draw


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture
def one_case(monkeypatch):
    """A steel roller with long waves."""
    waves = {"kind": "waviness", "amplitude": 100e-9, "wavelength_x": 0.1e-3}
    bodies = {
        "kind": "line",
        "radius_x": 0.01,
        "reduced_modulus": 226e9,
        "load_per_length": 2e5,
        "boundary_film": 2e-9,
    }
    tables = {"contact": bodies, "motion": {"speed": 0.03}, "surface": waves}
    monkeypatch.setattr(rollers, "draw", lambda *_: [Drawn(1, tables)])


def test_a_case(tmp_path, one_case):
    here = tmp_path / "rollers"
    assert main(["study", "rollers", "--nodes", "257", "--quiet", "--out", str(here)]) == 0
    (found,) = read(here / "rollers.csv")
    assert (found["E' GPa"], found["layers nm"], found["profile"]) == ("226", "2", "waves")
    assert found["verdict"] == "converged" and "±" in found["mean gap nm"]
    said = {each["what"]: each["value"] for each in read(here / "rollers-summary.csv")}
    assert (said["cases"], said["converged"]) == ("1", "1 (100.0 %)")


class TestWhatIsDrawn:
    @pytest.fixture(scope="class")
    def cases(self):
        return draw(40, 3)

    def test_more_cases_begin_with_the_same(self, cases):
        assert cases[:5] == draw(5, 3) != draw(5, 4)

    def test_pressures_and_films_are_what_was_drawn(self, cases):
        contacts = [contact_from(config_from_tables(case.tables)) for case in cases]
        assert {contact.reduced_modulus for contact in contacts} == {*HARD, *SOFT}
        for contact in contacts:
            of_soft = contact.reduced_modulus in SOFT
            p_h = contact.hertz.p_h / (contact.reduced_modulus if of_soft else 1.0)
            low, high = PRESSURE_OF_SOFT if of_soft else PRESSURE
            assert low * (1.0 - 1e-9) <= p_h <= high * (1.0 + 1e-9)

    def test_there_are_both_sorts(self, cases):
        kinds = [case.tables["surface"]["kind"] for case in cases]
        assert {"waviness", "self-affine"} == set(kinds)
