"""What every study uses: orders, limits, merged tables, files."""

import csv
from math import isnan

import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import ConfigError, OutputError, UserError
from mgehl.kinds import case_of
from mgehl.run import solve
from mgehl.solver.from_config import set_up
from mgehl.studies.study import BEST, PAPER, Study, merged, observed_order, richardson

FILM = {"motion": {"speed": 1.0}, "grid": {"nodes": 65}}
SLOWER = {"motion": {"speed": 0.7}}


def test_a_case_of_ones_own_is_differenced_by_the_best():
    scheme = set_up(case_of(config_from_tables(FILM))).settings.scheme
    assert {"couette": scheme.couette, "face_mobility": scheme.face_mobility} == BEST


@pytest.mark.parametrize("order", [0.5, 1, 2, 3])
@pytest.mark.parametrize("amplitude", [0.25, -4.0])
class TestMadeUpSequences:
    """limit + amplitude dX^order on grids that are each twice as fine."""

    def values(self, amplitude, order, grids=3):
        return [8.0 + amplitude * 0.5 ** (order * k) for k in range(grids)]

    def test_richardson_finds_limit_and_order(self, amplitude, order):
        assert richardson(self.values(amplitude, order)) == pytest.approx((8.0, order), rel=1e-12)

    def test_the_last_three_grids_count(self, amplitude, order):
        values = [1e6, *self.values(amplitude, order)]
        assert richardson(values) == pytest.approx((8.0, order), rel=1e-12)

    def test_order_of_errors_of_whatever_sign(self, amplitude, order):
        coarse, fine = (value - 8.0 for value in self.values(amplitude, order, 2))
        assert observed_order(coarse, fine) == pytest.approx(order, rel=1e-12)
        assert observed_order(coarse, -fine) == pytest.approx(order, rel=1e-12)


@pytest.mark.parametrize("values", [(1, 2, 3), (1, 2, 4), (1, 2, 1.5), (1, 2, 2), (1, 1, 2), (1, 1, 1)])
def test_without_falling_differences_of_one_sign_there_is_no_limit_to_see(values):
    limit, order = richardson(values)
    assert isnan(limit) and isnan(order)


@pytest.mark.parametrize("errors", [(0.0, 1.0), (1.0, 0.0), (0.0, 0.0)])
def test_no_order_without_errors(errors):
    assert isnan(observed_order(*errors))


def test_later_tables_have_authority_and_none_is_changed():
    first = {"grid": {"nodes": 65, "x": [-2, 2]}}
    second = {"grid": {"nodes": 129}, "motion": {"speed": 1.0}}
    assert merged(first, second) == {"grid": {"nodes": 129, "x": [-2, 2]}, "motion": {"speed": 1.0}}
    assert first == {"grid": {"nodes": 65, "x": [-2, 2]}} and second["grid"] == {"nodes": 129}


@pytest.fixture
def study(tmp_path):
    return Study(tmp_path, MPI.COMM_SELF, (65,))


ROWS = [{"name": "a", "film nm": "1.5"}, {"name": "b", "film nm": ""}]


def test_a_table_is_written_twice_and_printed(study, capsys):
    study.write_table("films", ROWS)
    with (study.directory / "films.csv").open() as file:
        assert list(csv.DictReader(file)) == ROWS
    text = (study.directory / "films.md").read_text()
    assert text == "| name | film nm |\n| --- | --- |\n| a | 1.5 |\n| b |  |\n"
    assert "name   film nm\n──────────────\na          1.5\nb\n" in capsys.readouterr().out


def test_a_quiet_study_prints_nothing(study, capsys):
    study.speak = False
    study.write_table("films", ROWS)
    study.draw("picture", lambda path, text: path.write_text(text), "drawn")
    study.solve("a film", FILM)
    assert capsys.readouterr().out == ""
    assert (study.directory / "picture.png").read_text() == "drawn"


def test_it_says_what_it_solved_and_what_did_not_converge(study, capsys):
    study.cases = 2
    assert study.solve("a film", FILM).result.converged
    study.solve("too short", merged(PAPER, FILM, {"solver": {"max_steps": 1}}))
    first, second = capsys.readouterr().out.splitlines()
    assert first.startswith("  1/2") and first.endswith("a film")
    assert second.startswith("  2/2") and "too short  NOT CONVERGED: residual" in second


def test_named_cases_are_solved_in_their_order_and_one_that_cannot_be_is_passed(study, capsys, monkeypatch):
    def broken(config, comm):
        if config.grid.nodes == 129:
            raise UserError("there is no room")
        return solve(config, comm)

    monkeypatch.setattr("mgehl.studies.study.solve", broken)
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


def test_a_point_without_fields_is_small(study):
    one, again = (study.solve("a film", FILM, with_fields=False) for _ in range(2))
    assert one.fields is again.fields is None and again.result == one.result and again.rows == one.rows
    (point,) = (study.directory / "points").iterdir()
    assert point.stat().st_size < 50_000


def test_a_table_that_cannot_be_written_is_one_line(tmp_path):
    (tmp_path / "file").touch()
    study = Study(tmp_path / "file", MPI.COMM_SELF, speak=False)
    with pytest.raises(OutputError, match="cannot be written"):
        study.write_table("films", ROWS)


def test_a_picture_that_cannot_be_drawn_is_said_and_costs_nothing(tmp_path, capsys):
    def broken(path):
        raise RuntimeError("Failed to process string with tex because latex could not be found")

    Study(tmp_path, MPI.COMM_SELF, speak=False).draw("films", broken)
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("mgehl: ") and "films.png: cannot be drawn: Failed to process" in line
