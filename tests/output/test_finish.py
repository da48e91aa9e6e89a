"""The result first, the picture after; a law that changed is said."""

import json
from pathlib import Path

import pytest
from mpi4py import MPI

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.kinds import case_of
from mgehl.output.stored import read_run

DRY = ["run", "--quiet", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--out", "here"]
LAW = "def waves(x, y):\n    return 1e-9 + 0.0 * x * y\n"
WAVY = ["--set", "contact.surface=a.py:waves", "--set", "solver.start=film", "--set", "motion.speed=1",
        "--no-error"]  # fmt: skip


@pytest.fixture(autouse=True)
def empty_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_picture_that_cannot_be_drawn_costs_nothing(tmp_path, capsys, monkeypatch):
    def broken(solution):
        raise RuntimeError("Failed to process string with tex because latex could not be found")

    with monkeypatch.context() as change:
        change.setattr("mgehl.output.pictures.picture.drawn", broken)
        assert main(DRY) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "picture.png: cannot be drawn: Failed to process string" in line
    assert "mgehl run --resume here draws it again" in line
    here = tmp_path / "here"
    assert {path.name for path in here.iterdir()} == {
        "configuration.toml", "fields.h5", "history.csv", "result.json",
    }  # fmt: skip
    before = (here / "fields.h5").stat().st_mtime_ns
    assert main(["run", "--resume", "here", "--quiet"]) == 0
    assert (here / "picture.png").read_bytes().startswith(b"\x89PNG")
    assert (here / "fields.h5").stat().st_mtime_ns == before


@pytest.mark.parametrize("begun", [False, True])
def test_a_kill_at_the_very_beginning_is_in_nobodys_way(monkeypatch, begun):
    """What it left is mgehl's: --force replaces it."""

    def kill(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as change:
        change.setattr("mgehl.run.solve" if begun else "mgehl.output.archive.npy.write_array", kill)
        assert main(DRY) == 130
    assert main(["run", "--resume", "here", "--quiet"]) == (0 if begun else 2)
    assert main([*DRY, "--force"]) == 0


def test_with_force_the_old_result_stays_until_there_is_another(capsys):
    assert main(DRY) == 0
    old = Path("here/fields.h5").read_bytes()
    again = [*DRY, "--force", "--set", "motion.speed=1e-5"]
    assert main([*again, "--time-limit", "1e-9"]) == 143
    assert Path("here/fields.h5").read_bytes() == old and read_run("here").config.motion.speed != 1e-5
    assert main(["run", "--resume", "here", "--quiet"]) == 0
    assert read_run("here").config.motion.speed == 1e-5


class TestLaws:
    def test_a_run_goes_on_with_the_law_that_it_began_with(self, tmp_path, capsys):
        (tmp_path / "a.py").write_text(LAW)
        assert main([*DRY, *WAVY, "--time-limit", "1e-9"]) == 143
        (tmp_path / "a.py").write_text("raise SystemExit('another law')\n")
        capsys.readouterr()
        assert main(["run", "--resume", "here"]) == 0
        (line,) = capsys.readouterr().err.splitlines()
        assert "a.py has changed since the run began, which goes on with its copy of it" in line
        assert (tmp_path / "here" / "laws" / "a.py").read_text() == LAW

    def test_a_copy_that_was_changed_is_said_where_it_is_run_again(self, tmp_path, capsys):
        (tmp_path / "a.py").write_text(LAW)
        assert main([*DRY, *WAVY]) == 0
        (tmp_path / "here" / "laws" / "a.py").write_text(LAW + "\n")
        capsys.readouterr()
        assert main(["run", "here/configuration.toml", "--quiet", "--out", "again"]) == 0
        assert "laws/a.py: has changed since the run that it lies beside" in capsys.readouterr().err


def test_collect_knows_wedges(capsys):
    wedge = ["run", "--quiet", "--set", "grid.nodes=65", "--set", "contact.kind=wedge", "--out", "wedge"]
    assert main(wedge) == 0 and main(DRY) == 0
    assert main(["collect", "wedge", "here"]) == 0
    head, _, first, second = capsys.readouterr().out.splitlines()
    assert "load N" in head and "central nm" in head
    assert first.startswith("| wedge | 65 |") and second.startswith("| here | 65 |")


def test_control_characters_of_a_file_do_not_reach_the_terminal(capsys):
    from mgehl.output.table import markdown

    table = markdown([{"run": "a\x1b[2Jb|c\n"}], ["run"])
    assert table.isprintable() or set(table) - set("\n") and "\x1b" not in table
    assert table.splitlines()[-1] == "| a\\x1b[2Jb\\|c\\n |"


def test_an_address_space_that_is_too_small_is_said_before_blas_loops(monkeypatch):
    import resource

    from mgehl.errors import UserError
    from mgehl.output.memory_limit import check_memory

    case = case_of(config_from_tables({"grid": {"nodes": 513, "x": [-1.9, 1.3], "y": [-1.5, 1.5]}}))
    check_memory(case, 1)
    monkeypatch.setattr(resource, "getrlimit", lambda which: (7e8, 7e8))
    with pytest.raises(UserError, match=r"takes about \d+ MiB of address space.*allows 668"):
        check_memory(case, 1)


WAVES = {"kind": "self-affine", "rms": 2e-7, "shortest_wavelength": 4e-5, "longest_wavelength": 2e-4}


def test_rough_bodies_need_more_memory_and_ranks_share_it(monkeypatch):
    from mgehl.errors import UserError
    from mgehl.output import memory_limit

    smooth = {"grid": {"nodes": 513, "x": [-1.9, 1.3], "y": [-1.5, 1.5]}}
    rough = smooth | {"surface": WAVES}
    monkeypatch.setattr(memory_limit, "_taken", lambda: 0)
    monkeypatch.setattr(memory_limit.resource, "getrlimit", lambda which: (2**30, 2**30))
    memory_limit.check_memory(case_of(config_from_tables(smooth)), 1)
    with pytest.raises(UserError, match="takes about 3"):
        memory_limit.check_memory(case_of(config_from_tables(rough)), 1)
    memory_limit.check_memory(case_of(config_from_tables(rough)), 4)


def test_points_of_a_study_are_read_back_as_they_were(tmp_path):
    """All that a solution is, to the last bit; not finite numbers, too."""
    from dataclasses import replace
    from math import inf

    from mgehl.output.solution_record import record_of, solution_from
    from mgehl.run import solve

    tables = {
        "contact": {"kind": "line"},
        "grid": {"nodes": 65, "x": [-2.0, 1.5]},
        "motion": {"speed": 0.3},
    }
    solved = solve(config_from_tables(tables), MPI.COMM_SELF)
    inequality = replace(solved.result.pressure_inequality, largest_ratio=inf)
    solved = replace(solved, result=replace(solved.result, pressure_inequality=inequality))
    plain, arrays = record_of(solved)
    read = solution_from(json.loads(json.dumps(plain)), arrays)
    assert read.result == solved.result and read.config == solved.config and read.H0 == solved.H0
    assert read.rows == solved.rows and (read.fields.P == solved.fields.P).all()
