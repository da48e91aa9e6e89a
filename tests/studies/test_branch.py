"""Both branches at one speed, studies of the transition on small grids, and what a kill leaves."""

import csv
import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.cli import main
from mgehl.discretization.status import CONTACT
from mgehl.studies import grid, transition
from mgehl.studies.branch import Branches
from mgehl.studies.study import PAPER, Study, merged, papers_grid

FILM = merged(PAPER, {"grid": papers_grid(65)})


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def run(directory, *words):
    """A study by the command line; its exit status."""
    return main(["study", *words, "--quiet", "--out", str(directory)])


@pytest.fixture
def study(tmp_path):
    return Study(tmp_path, MPI.COMM_SELF, (129,), speak=False)


class TestBothBranches:
    SPEED = 0.03

    @pytest.fixture(scope="class")
    def points(self, tmp_path_factory):
        """129 nodes at 30 mm/s, where the grid has two solutions."""
        study = Study(tmp_path_factory.mktemp("branches"), MPI.COMM_SELF, (129,), speak=False)
        with Branches(study, transition.case(129)) as branches:
            down = branches.walk("down", [0.1, 0.055, self.SPEED])
            up = branches.walk("up", [0.005, 0.01, 0.02, self.SPEED])
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

    def test_the_contact_of_either_is_pressed(self, points):
        for point in points:
            assert point.fields.P[point.fields.status == CONTACT].min() >= 0.0


class TestJump:
    def test_a_branch_that_ends_goes_on_from_the_other_start(self, study):
        """The film cannot be followed to 20 mm/s on 65 nodes: full contact is what there is."""
        with Branches(study, transition.case(65)) as branches:
            film, contact = branches.walk("down", [0.3, 0.02])
        assert film.origin == "start" and film.result.central_film_nm > 140.0
        assert film.obstacle == "" and contact.obstacle != ""  # why it ended, kept with the point
        assert contact.origin == "other start" and contact.result.contact.area_fraction > 0.95
        assert contact.result.settled


class TestStart:
    def test_a_start_may_take_twice_the_steps(self, tmp_path):
        """18 from nothing at 0.2 m/s on 65 nodes, in a study whose points may take ten."""
        study = Study(tmp_path, MPI.COMM_SELF, (65,), speak=False)
        with Branches(study, merged(FILM, {"solver": {"max_steps": 10}})) as branches:
            (start,) = branches.walk("down", [0.2])
        assert start.origin == "start" and start.result.settled
        assert 10 < start.result.work.steps <= 20


class TestPoints:
    def test_a_second_walk_solves_nothing(self, study, monkeypatch):
        with Branches(study, FILM) as branches:
            first = branches.walk("down", [1.0, 0.8])
        monkeypatch.setattr("mgehl.solver.continuation.Continuation.begin", None)
        monkeypatch.setattr("mgehl.solver.continuation.Continuation.follow", None)
        with Branches(study, FILM) as branches:
            second = branches.walk("down", [1.0, 0.8])
        assert [point.result for point in first] == [point.result for point in second]
        assert all(np.array_equal(a.fields.H, b.fields.H) for a, b in zip(first, second, strict=True))

    def test_another_way_is_another_point(self, study):
        with Branches(study, FILM) as branches:
            keys = {
                branches._key(branch, way, ())
                for branch in ("down", "up")
                for way in ([1.0], [0.8], [1.0, 0.8])
            }
        with Branches(study, transition.case(129)) as branches:
            keys.add(branches._key("down", [1.0], ()))
        assert len(keys) == 7


class TestStudies:
    @pytest.fixture(autouse=True)
    def few(self, monkeypatch):
        """Few speeds, fast ones: 65 and 129 nodes resolve no others."""
        monkeypatch.setattr(transition, "COUNT", 4)

    def test_transition(self, tmp_path):
        assert run(tmp_path / "t", "transition", "--grid", "65") == 0
        for nodes in (65,):
            rows = read(tmp_path / "t" / f"transition-{nodes}.csv")
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
                png = tmp_path / "t" / f"transition-{nodes}-{picture}.png"
                assert png.read_bytes().startswith(b"\x89PNG")

    def test_one_direction_of_another_mean(self, tmp_path, monkeypatch):
        monkeypatch.setattr(transition, "SLOWEST", 0.05)
        monkeypatch.setattr(transition, "COUNT", 2)
        words = ("transition", "--grid", "129", "--direction", "down")
        assert run(tmp_path / "t", *words, "--set", "discretization.face_mobility=geometric") == 0
        rows = read(tmp_path / "t" / "transition-129.csv")
        assert [(row["branch"], row["contact/Hertz area"]) for row in rows] == [("down", "0.0000")] * 2

    def test_grid(self, tmp_path):
        assert run(tmp_path / "g", "grid", "--nodes", "65,129") == 0
        rows = read(tmp_path / "g" / "contact.csv")
        assert all(row["settled"] == "yes" and row["Eq. 2 broken"].startswith("0 ") for row in rows)
        assert float(rows[1]["order"]) > 1.0
        assert len(read(tmp_path / "g" / "film.csv")) == 2
        assert {row["central: limit, order"] for row in read(tmp_path / "g" / "film.csv")} == {""}
        assert {"figures-11-12.png", "figure-13.png"} <= {path.name for path in (tmp_path / "g").iterdir()}


@pytest.mark.parametrize(
    ("films", "contact", "text"),
    [
        ((9.0, 8.25, 8.0625), (0, 0, 0), "8.000, 2.00"),
        ((9.0, 8.25, 8.0625), (5, 0, 0), ""),
        ((12.4364, 12.0798, 11.77), (0, 0, 0), "not to be told yet"),
        ((9.0, 8.25), (0, 0), ""),
    ],
    ids=["second order", "contact on the first", "order 0.2", "two grids"],
)
def test_a_limit_is_that_of_three_full_films(films, contact, text):
    found = [
        SimpleNamespace(film=film, contact=SimpleNamespace(nodes=nodes))
        for film, nodes in zip(films, contact, strict=True)
    ]
    assert grid._limit(found, "film") == text


class TestKill:
    SCRIPT = (
        "import sys; from mgehl.studies import transition; transition.COUNT = 3; "
        "from mgehl.cli import main; sys.exit(main(sys.argv[1:]))"
    )

    def command(self, directory, *more):
        study = ("study", "transition", "--grid", "65", "--out", str(directory))
        return [sys.executable, "-c", self.SCRIPT, *study, *more]

    def test_what_was_finished_is_not_lost(self, tmp_path):
        """Killed with some points done, gone on with: the table of a study that was left alone."""
        killed, alone = tmp_path / "killed", tmp_path / "alone"
        child = subprocess.Popen(self.command(killed), start_new_session=True, stdout=subprocess.DEVNULL)
        points = killed / "points"
        deadline = time.monotonic() + 300.0
        while time.monotonic() < deadline and len(list(points.glob("*"))) < 3:
            time.sleep(0.02)
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        done = {path: path.stat().st_mtime_ns for path in points.glob("[!.]*.npz")}
        assert 2 <= len(done) < 6 and not (killed / "transition-65.csv").exists()
        subprocess.run(self.command(killed, "--resume"), check=True, stdout=subprocess.DEVNULL)
        subprocess.run(self.command(alone), check=True, stdout=subprocess.DEVNULL)
        assert all(path.stat().st_mtime_ns == when for path, when in done.items())
        resumed, whole = (read(path / "transition-65.csv") for path in (killed, alone))
        assert len(resumed) == 6
        for one, other in zip(resumed, whole, strict=True):
            assert one["branch"] == other["branch"] and one["from"] == other["from"]
            assert float(one["central nm"]) == pytest.approx(float(other["central nm"]), abs=1e-3)

    def test_a_directory_that_exists_is_kept(self, tmp_path, capsys):
        (tmp_path / "t").mkdir()
        assert run(tmp_path / "t", "transition", "--grid", "65") == 2
        assert "exists" in capsys.readouterr().err
