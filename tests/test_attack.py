"""Small samples of the attacks that tests/tools/attack.py makes by the thousand."""

import json
import sys
from copy import deepcopy
from importlib import import_module
from pathlib import Path

import pytest
from processes import ended

import mgehl
from mgehl.discretization.status import CAVITATED, LUBRICATED

TOOL = Path(__file__).parent / "tools" / "attack.py"


@pytest.mark.parametrize("attack, count", [("words", 10), ("damage", 5)])
def test_a_few_find_nothing(attack, count):
    words = [sys.executable, str(TOOL), attack, "--count", str(count), "--seed", "11"]
    done = ended(words, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    assert json.loads(done.stdout.splitlines()[-1])["findings"] == 0


class TestTheIndependentTest:
    """It finds nothing wrong with what is right, and what is wrong with the rest."""

    @pytest.fixture(scope="class")
    def wrong(self):
        return import_module("independent").wrong

    @pytest.fixture(scope="class", params=[{}, {"contact.kind": "line"}], ids=["point", "line"])
    def film(self, request):
        settings = {"grid.nodes": 65, "solver.error": False, "motion.speed": 0.5, "solver.start": "film"}
        return mgehl.solve(mgehl.load(None, settings | request.param))

    def test_a_film_is_right(self, wrong, film):
        assert film.result.converged and wrong(film) == ""

    def test_a_gap_of_its_own(self, wrong, film):
        assert wrong(changed(film, H=film.fields.H * (1.0 + 1e-4))).startswith("gap off")

    def test_fluid_that_pulls(self, wrong, film, monkeypatch):
        monkeypatch.setitem(wrong.__globals__, "_wrong_gap", lambda _: "")
        monkeypatch.setitem(wrong.__globals__, "_wrong_load", lambda _: "")
        P = film.fields.P.copy()
        P[:, 5] = -1e-3
        assert wrong(changed(film, P=P)).startswith("tension")
        P[:, 5] = 1e-3
        status = film.fields.status.copy()
        status[:, 5] = CAVITATED
        assert wrong(changed(film, P=P, status=status)) == "pressure in a cavity"
        assert wrong(changed(film, H=film.fields.H - film.fields.H.max())).startswith("overlap")
        P[:, 1:-1] = P.max()
        status[:] = LUBRICATED
        assert wrong(changed(film, P=P, status=status)).startswith("cut by the domain")


def changed(solution, **fields):
    found = deepcopy(solution)
    for name, values in fields.items():
        setattr(found.fields, name, values)
    return found
