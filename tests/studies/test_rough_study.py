"""Study rough on a tiny grid, and what becomes of points that did not converge."""

import csv
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.cli import main
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.model.load_share import aihara
from mgehl.output.mixed_result import MixedResult
from mgehl.output.result import Work
from mgehl.studies import rough, rough_figures
from mgehl.studies.study import merged

NUMBERS = ("load on contact", "contact/Hertz area", "patches", "minimum film nm", "torn")


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def cases(directory, monkeypatch, *words):
    """Two speeds of long waves on 65 nodes; the exit status."""
    smooth = {"surface": {"rms": 20e-9, "shortest_wavelength": 90e-6}}
    for name, value in {"FASTEST": 0.01, "SLOWEST": 0.005, "COUNT": 2}.items():
        monkeypatch.setattr(rough, name, value)
    monkeypatch.setattr(rough, "CASE", merged(rough.CASE, smooth))
    return main(["study", "rough", "--nodes", "65", "--quiet", "--out", str(directory), *words])


def test_two_speeds_from_both_starts(tmp_path, monkeypatch):
    directory = tmp_path / "rough"
    assert cases(directory, monkeypatch, "--boundary-film", "10 nm") == 0
    files = {path.name for path in directory.iterdir()}
    assert files == {
        "rough.csv",
        "rough.md",
        "load-share.png",
        "states.png",
        "points",
        "study.json",
        "manifest.json",
    }
    rows = read(directory / "rough.csv")
    assert [(row["speed mm/s"], row["start"]) for row in rows] == [
        ("10", "film"), ("10", "contact"), ("5", "film"), ("5", "contact"),
    ]  # fmt: skip
    for row in rows:
        assert row["verdict"] == "converged"
        assert 0.0 < float(row["load on contact"]) < float(row["contact/Hertz area"]) < 0.2
        assert float(row["load on contact apart from the other start"]) < 1e-5
        assert float(row["minimum film nm"]) >= 10.0
        assert float(row["Aihara"]) == pytest.approx(aihara(float(row["lambda"])), abs=1e-3)
    for fast, slow in zip(rows[:2], rows[2:], strict=True):
        assert float(slow["lambda"]) == pytest.approx(float(fast["lambda"]) * 0.5**0.67, rel=1e-3)
        assert float(slow["load on contact"]) > float(fast["load on contact"])
    assert len(list((directory / "points").iterdir())) == 4
    assert cases(directory, monkeypatch, "--boundary-film", "10 nm", "--resume") == 0
    assert read(directory / "rough.csv") == rows and len(list((directory / "points").iterdir())) == 4


def test_a_study_whose_points_do_not_converge_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(rough, "CASE", merged(rough.CASE, {"solver": {"max_steps": 1}}))
    assert cases(tmp_path / "rough", monkeypatch) == 1
    rows = read(tmp_path / "rough" / "rough.csv")
    assert all(row["verdict"].startswith("NOT CONVERGED: ") for row in rows)
    assert {row[name] for row in rows for name in NUMBERS} == {""}
    assert not (tmp_path / "rough" / "states.png").exists()
    assert (tmp_path / "rough" / "load-share.png").exists()


def point(speed, converged=True, start="film", share=0.5):
    numbers = 1e2 * speed, 100.0, share, 1.0 - share, 1e-9, 0.25, 7, 1e-10, 40.0, 2.0, 80.0, 0.1
    mixed = MixedResult(*numbers, mean_gap_nm=9.5, loaded_gap_nm=3.25)
    result = SimpleNamespace(
        converged=converged, settled=True, doubt="Eq. 2 is broken", reason="it is wrong", mixed=mixed,
        work=Work(80.0, 9),
        resolution=SimpleNamespace(surface_nodes=9.5),
    )  # fmt: skip
    status = np.full((9, 9), LUBRICATED)
    status[4, 4] = CONTACT
    mesh = Mesh(9, 9, (-2.0, 2.0), (-2.0, 2.0))
    return rough.Point(speed, start, result, mesh, np.full((9, 9), 40.0, np.float32), status)


class TestPointsThatAreNoResults:
    def test_they_have_a_verdict_and_no_numbers(self):
        both = [point(1.0), point(1.0, converged=False, start="contact")]
        good, bad = (rough.row(each, both) for each in both)
        assert {bad[name] for name in NUMBERS} == {""} and good["patches"] == "7"
        assert (good["mean gap nm"], good["gap by pressure nm"]) == ("9.5000", "3.2500")
        assert bad["verdict"] == "Eq. 2 is broken: it is wrong"
        assert good["load on contact apart from the other start"] == ""

    def test_starts_are_compared_where_both_are(self):
        both = [point(1.0), point(1.0, start="contact", share=0.75)]
        assert rough.row(both[0], both)["load on contact apart from the other start"] == "2.5e-01"

    def test_states_are_chosen_among_the_others(self):
        ways = {k: [point(k, k != 3.0), point(k, k == 5.0, start="contact")] for k in (1.0, 2.0, 3.0)}
        assert [each.speed for each in rough.chosen(ways)] == [1.0, 2.0]
        assert rough.chosen({1.0: [point(1.0, False)]}) == []

    def test_a_mark_for_each_on_the_edge_and_not_among_the_results(self, tmp_path, monkeypatch):
        figures = []
        monkeypatch.setattr(rough_figures, "save", lambda figure, path: figures.append(figure))
        points = [point(0.01), point(0.001, converged=False, share=0.9)]
        rough_figures.load_share(tmp_path / "none.png", points, {"Aihara": aihara})
        (figure,) = figures
        lines = {line.get_label(): line for line in figure.axes[0].lines}
        assert lines["from film"].get_xydata().tolist() == [[1.0, 0.5]]
        (tick,) = [line for line in figure.axes[0].lines if line.get_marker() == "|"]
        assert tick.get_xdata()[0] == pytest.approx(0.1) and tick.get_ydata()[0] != 0.9
        assert any("1 of 2 did not converge" in text.get_text() for text in figure.texts)


def test_a_state_without_any_film_within_the_ellipse_is_drawn(tmp_path):
    dry = replace(point(1.0), status=np.full((9, 9), CONTACT))
    rough_figures.states(tmp_path / "states.png", [dry])
    assert (tmp_path / "states.png").read_bytes().startswith(b"\x89PNG")


def test_the_case_is_resolved_and_goes_from_full_film_to_nearly_dry():
    from mgehl.kinds import contact_from, mesh_from
    from mgehl.output.surface import RESOLVED_NODES, wave_nodes
    from mgehl.studies.study import _config

    config = _config(rough.case(rough.NODES, rough.FASTEST, "film", 2e-9))
    contact = contact_from(config)
    assert wave_nodes(contact, mesh_from(config, contact)) > RESOLVED_NODES
    ratios = [contact.at_speed(speed).expected_film / contact.roughness for speed in rough.speeds()]
    assert len(ratios) == 20 and ratios[0] > 3.0 and ratios[-1] < 0.01
