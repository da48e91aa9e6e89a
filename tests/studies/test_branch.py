import pytest
from mpi4py import MPI
from places import names_in
from told import rows_of

from mgehl.cli import main
from mgehl.output.study_directory import StudyRecord
from mgehl.studies import transition
from mgehl.studies.branch import Branch
from mgehl.studies.study import Study


def run(directory, *words):
    return main(["study", *words, "--quiet", "--out", str(directory)])


class TestBothBranches:
    SPEED = 0.03

    @pytest.fixture(scope="class")
    def points(self, tmp_path_factory):
        asked = StudyRecord("transition", (), 1, {})
        study = Study(tmp_path_factory.mktemp("branches"), MPI.COMM_SELF, asked, speak=False)
        down = Branch(study, transition.case(129), "down").walk([0.1, 0.055, self.SPEED])
        up = Branch(study, transition.case(129), "up").walk([0.005, 0.01, 0.02, self.SPEED])
        return down[-1], up[-1]

    def test_both_are_solutions(self, points):
        for point in points:
            result = point.result
            assert point.speed == self.SPEED and point.origin == "continued"
            assert result.settled and result.residual <= 1e-8 and abs(result.load_error) <= 1e-8
            assert result.complementarity_error <= 1e-6

    def test_they_are_not_the_same(self, points):
        down, up = points
        assert down.result.contact.area_fraction < 0.1 and down.result.central_film_nm > 20.0
        assert up.result.contact.area_fraction > 0.95 and abs(up.result.central_film_nm) < 1e-6
        assert up.result.contact.load_fraction > 0.95


class TestStudies:
    @pytest.fixture(autouse=True)
    def few(self, monkeypatch):
        monkeypatch.setattr(transition, "COUNT", 4)

    def test_transition(self, tmp_path):
        assert run(tmp_path / "t", "transition", "--grid", "65") == 0
        rows = rows_of(tmp_path / "t" / "transition-65.csv")
        assert [row["branch"] for row in rows] == ["down"] * 4 + ["up"] * 4
        assert all(row["settled"] == "yes" for row in rows)
        for row in rows:
            carried = float(row["load on contact"]) + float(row["load on fluid"])
            assert carried == pytest.approx(1.0, abs=1e-4)
            assert float(row["U of the paper"]) == pytest.approx(float(row["U"]) * 2.0 / 3.0, rel=1e-3)
            assert max(float(row[e]) for e in ("e^p", "e^p lubr.", "e^p solid")) < 1e-4
            broken, checked = map(int, row["at the interface"].split(" of "))
            assert broken <= checked == int(row["Eq. 2 broken"].split(" of ")[1])
            assert (broken == 0) == (float(row["there by at most p_h"]) == 0.0)
        slowest = [row for row in rows if row["speed mm/s"] == "0.005"]
        assert all(float(row["contact/Hertz area"]) > 0.95 for row in slowest)
        for picture in ("films", "figure-14"):
            png = tmp_path / "t" / f"transition-65-{picture}.png"
            assert png.read_bytes().startswith(b"\x89PNG")

    def test_grid(self, tmp_path):
        assert run(tmp_path / "g", "grid", "--nodes", "65,129") == 0
        rows = rows_of(tmp_path / "g" / "contact.csv")
        assert all(row["settled"] == "yes" and row["Eq. 2 broken"].startswith("0 ") for row in rows)
        assert float(rows[1]["order"]) > 1.0
        assert len(rows_of(tmp_path / "g" / "film.csv")) == 2
        assert {row["central: limit, order"] for row in rows_of(tmp_path / "g" / "film.csv")} == {""}
        assert {"figures-11-12.png", "figure-13.png"} <= names_in(tmp_path / "g")
