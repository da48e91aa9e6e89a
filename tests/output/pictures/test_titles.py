from types import SimpleNamespace

import pytest
from made_solution import make_result
from matplotlib.quiver import Quiver

from mgehl.config import load_config
from mgehl.output.pictures.figures import figures
from mgehl.output.pictures.titles import labels, run_names


def runs(*settings, converged=True):
    result = make_result(converged=converged, settled=converged)
    return [SimpleNamespace(config=load_config(settings=each), result=result) for each in settings]


@pytest.mark.parametrize(
    "one, other, said",
    [
        (["motion.speed=0.5 m/s"], ["motion.speed=20 mm/s"], ["500 mm/s", "20 mm/s"]),
        (["grid.nodes=65"], ["grid.nodes=129"], ["65 nodes", "129 nodes"]),
        (["discretization.face_mobility=harmonic"], [], ["harmonic mean", "arithmetic mean"]),
        (["solver.tolerance=1e-6"], [], ["solver.tolerance 1e-06", "solver.tolerance 1e-08"]),
        (["contact.radius_y=20 mm"], [], ["contact.radius_y 0.02 m", "contact.radius_y 0.0127 m"]),
        (["grid.nodes=65", "solver.start=film"], ["grid.nodes=129", "solver.start=film"],
         ["65 nodes", "129 nodes"]),
        (["moes.M=20", "moes.L=10"], ["moes.M=200", "moes.L=10"], ["moes.M 20", "moes.M 200"]),
    ],
)  # fmt: skip
def test_they_say_the_keys_that_differ(one, other, said):
    assert labels(runs(one, other), ["a", "b"]) == said


def test_a_course_of_time_is_told_by_its_name(tmp_path):
    for name in ("one", "two"):
        (tmp_path / f"{name}.csv").write_text("0,1\n1,2\n")
    settings = ([f"motion.speed={tmp_path / name}.csv", "time.end=1"] for name in ("one", "two"))
    assert labels(runs(*settings), ["a", "b"]) == ["motion.speed one.csv", "motion.speed two.csv"]


def test_names_of_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_names(["x/one", "y/two"]) == ["one", "two"]
    assert run_names(["x/one", "y/one", "y/two"]) == ["x/one", "y/one", "y/two"]
    assert run_names(["x/."]) == ["x"]


@pytest.mark.parametrize(
    "speed, way, arrow, said",
    [(-1500.0, " (right to left)", [-1.0], "-1.5 m/s"), (40.0, " (left to right)", [1.0], "40 mm/s"),
     (0.0, "", [], "0 mm/s")],
)  # fmt: skip
def test_pictures_of_a_run_in_time_are_of_its_end(make_solution, tmp_path, speed, way, arrow, said):
    for name, unit, last in (("u", "m/s", speed / 1e3), ("F", "N", 400.0)):
        (tmp_path / f"{name}.csv").write_text(f"t [ms],{name} [{unit}]\n0,2\n4,{last}\n")
    courses = f"motion.speed={tmp_path / 'u.csv'}", f"contact.load={tmp_path / 'F.csv'}"
    last = {"time_s": 4e-3, "speed_mm_s": speed, "load_share": 200.0}
    solution = make_solution(settings=[*courses, "time.end=4 ms"], rows=[last])
    lines, film = (picture.figure for picture in figures(solution, ["lines", "film"]))
    assert lines.axes[0].get_title() == f"Y = 0, along {'the motion' if way else 'x'}{way}"
    told = f"2 N to 400 N, 33 x 33 nodes: converged\nat 4 ms, {said}, 400 N"
    assert lines._suptitle.get_text().endswith(told) and film.axes[0].get_title().endswith(told)
    arrows = [each.U for each in film.axes[0].get_children() if isinstance(each, Quiver)]
    assert [float(U[0]) for U in arrows] == arrow
