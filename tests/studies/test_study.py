from math import isnan

import pytest
from mpi4py import MPI

from mgehl.errors import ConfigError, UserError
from mgehl.output.study_directory import StudyRecord
from mgehl.run import run
from mgehl.studies.limits import order_of_errors, richardson
from mgehl.studies.study import Study, merged

FILM = {"motion": {"speed": 1.0}, "grid": {"nodes": 65}}
SLOWER = {"motion": {"speed": 0.7}}


@pytest.mark.parametrize("order", [0.5, 1, 2, 3])
@pytest.mark.parametrize("amplitude", [0.25, -4.0])
class TestMadeUpSequences:
    """limit + amplitude dX^order on grids that are each twice as fine."""

    def values(self, amplitude, order, grids=3):
        return [8.0 + amplitude * 0.5 ** (order * k) for k in range(grids)]

    def test_richardson_finds_limit_and_order(self, amplitude, order):
        assert richardson(self.values(amplitude, order)) == pytest.approx((8.0, order), rel=1e-12)

    def test_order_of_errors_of_whatever_sign(self, amplitude, order):
        coarse, fine = (value - 8.0 for value in self.values(amplitude, order, 2))
        assert order_of_errors(coarse, fine) == pytest.approx(order, rel=1e-12)
        assert order_of_errors(coarse, -fine) == pytest.approx(order, rel=1e-12)


@pytest.mark.parametrize("values", [(1, 2, 3), (1, 2, 4), (1, 2, 1.5), (1, 2, 2), (1, 1, 2), (1, 1, 1)])
def test_without_falling_differences_of_one_sign_there_is_no_limit_to_see(values):
    limit, order = richardson(values)
    assert isnan(limit) and isnan(order)


@pytest.fixture
def study(tmp_path):
    return Study(tmp_path, MPI.COMM_SELF, StudyRecord("films", (65,), 1, {}))


def test_named_cases_are_solved_in_their_order_and_one_that_cannot_be_is_passed(study, capsys, monkeypatch):
    def broken(case, *how):
        if case.config.grid.nodes == 129:
            raise UserError("there is no room")
        return run(case, *how)

    monkeypatch.setattr("mgehl.studies.study.run", broken)
    large = merged(FILM, {"grid": {"nodes": 129}})
    found = dict(study.solved({"a film": FILM, "large": large, "slower": merged(FILM, SLOWER)}))
    assert list(found) == ["a film", "slower"] and study.failures == 1
    assert study.lost == {"large": "there is no room"}
    assert found["slower"].result.central_film_nm < found["a film"].result.central_film_nm
    out, err = capsys.readouterr()
    assert err == "mgehl: large: not solved: there is no room\n"
    assert [line[:5] for line in out.splitlines()] == ["  1/3", "  3/3"]


def test_a_configuration_that_is_none_ends_a_study_before_it_begins(study, capsys):
    with pytest.raises(ConfigError, match="speeed"):
        next(study.solved({"a film": FILM, "wrong": {"motion": {"speeed": 1.0}}}))
    assert capsys.readouterr().out == ""


def test_settings_have_authority_over_every_case(study):
    study.settings = SLOWER
    assert study.solve("a film", FILM).config.motion.speed == SLOWER["motion"]["speed"]
