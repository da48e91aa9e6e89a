"""Titles of pictures, and labels that tell runs apart."""

from types import SimpleNamespace

import pytest
from test_files import make_result

from mgehl.config import load_config
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


def test_names_of_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_names(["x/one", "y/two"]) == ["one", "two"]
    assert run_names(["x/one", "y/one", "y/two"]) == ["x/one", "y/one", "y/two"]
    assert run_names(["x/."]) == ["x"]
