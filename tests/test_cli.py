import json
import pickle
import shlex
import sys

import pytest
from places import RUN_FILES, names_in
from processes import MGEHL, ended
from told import status_of

from mgehl.errors import ConfigError, OptionError, OutputError, UserError

DRY = ["run", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--set", "motion.speed=0.005 mm/s"]

pytestmark = pytest.mark.usefixtures("empty_directory")


def mgehl(*arguments):
    return ended([*MGEHL, *arguments])


def test_a_run_in_a_process_of_its_own(tmp_path):
    done = mgehl(*DRY, "--out", "here")
    assert (done.returncode, done.stderr) == (0, "")
    assert "\nCONVERGED" in done.stdout
    assert names_in(tmp_path / "here") == RUN_FILES
    assert [path.name for path in tmp_path.iterdir()] == ["here"]


def piped(command):
    """(exit status, stdout, stderr) of a command of the shell, mgehl's the status of a pipe's first."""
    done = ended(["bash", "-c", f"set -o pipefail; {command.replace('mgehl', shlex.join(MGEHL), 1)}"])
    assert done.stderr.count("\n") <= 1 and "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("where", ["| head -n 1", "> /dev/full", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_a_run_whose_words_nobody_hears_goes_on(tmp_path, where):
    status, _, err = piped(f"{shlex.join(['mgehl', *DRY])} --out here {where}")
    assert (status, err) == (0, "")
    assert names_in(tmp_path / "here") == RUN_FILES


@pytest.mark.parametrize("words", [["--version"], ["--help"], ["run", "--help"], ["run", "--nonsense"], []])
def test_of_several_ranks_one_says_it(capsys, monkeypatch, words):
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "0")
    first = status_of(*words)
    assert "mgehl" in "".join(capsys.readouterr())
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "1")
    assert status_of(*words) == first
    assert capsys.readouterr() == ("", "")


NOTHING = [
    ["run", ""], ["run", "--resume", ""], ["run", "--start-from", ""], ["run", "--out", ""],
    ["run", "--time-limit", ""], ["run", "--save-every", " "], ["run", "--set", ""], ["new", ""],
    ["new", "/"],
    ["new", "here/"], ["new", "."], ["new", ".."], ["collect", "x", "--out", ""], ["collect", ""],
    ["report", ""], ["plot", "x", "--style", ""], ["export", "x", "--to", ""],
    ["study", "dry", "--out", ""],
    ["check", ""], ["run", "a\0b"], ["study", "dry", "--direction", "down"],
    ["study", "onset"], ["study", "dry", "--force", "--resume"],
    ["run", "/dev/zero"], ["run", "-fp_trap"], ["run", "-options_file", "nowhere"],
    ["run", "-mgehl_pc_mg_levels", "50"], ["run", "-mgehl_pc_type", "mg"],
]  # fmt: skip


@pytest.mark.parametrize("arguments", NOTHING, ids=[" ".join(map(repr, words)) for words in NOTHING])
def test_words_that_are_nothing_are_one_line(tmp_path, refused, arguments):
    refused(*arguments)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("value, said", [("-1", "-1.0"), ("-1 s", "'-1 s'"), ("-.5", "-0.5")])
def test_a_number_below_0_is_the_options_own_and_not_petscs(refused, value, said):
    """Of --save-every -1 --out d the --out was blamed."""
    line = refused("run", "--save-every", value, "--out", "d")
    assert f"--save-every = {said}: must be a number in s" in line


class TestFailures:
    """Whatever a command raises is one line with a status; `mgehl.failures` has them all."""

    @pytest.mark.parametrize(
        "error, status, line",
        [
            (ZeroDivisionError("a\nb \x1b[31mred"), 1,
             "an error of mgehl's own: ZeroDivisionError: a b \\x1b[31mred"),
            (MemoryError(), 1, "out of memory: fewer nodes"),
            (RecursionError("deep"), 1, "an error of mgehl's own"),
            (OSError(28, "No space left on device", "here/file"), 2, "here/file: No space left on device"),
            (ImportError("No module named 'petsc4py'"), 2, 'eval "$(make -s env)"'),
            (UnicodeEncodeError("ascii", "\udcff", 0, 1, "no"), 1, "an error of mgehl's own"),
            (KeyboardInterrupt(), 130, "stopped by Ctrl-C"),
            (BrokenPipeError(32, "Broken pipe"), 141, None),
        ],
    )  # fmt: skip
    @pytest.mark.parametrize("command", [["keys"], ["info"]], ids=["alone", "in parallel"])
    def test_is_one_line(self, capsys, monkeypatch, command, error, status, line):
        def fail(*_):
            raise error

        monkeypatch.setattr(f"mgehl.commands.{command[0]}.execute", fail)
        assert status_of(*command) == status
        out, err = capsys.readouterr()
        assert (out, err.count("\n")) == ("", 1 if line else 0)
        assert not line or (err.startswith("mgehl: ") and line in err)

    def test_a_working_directory_that_is_gone(self, tmp_path, refused, monkeypatch):
        gone = tmp_path / "gone"
        gone.mkdir()
        monkeypatch.chdir(gone)
        gone.rmdir()
        assert "the working directory is gone" in refused("run")

    @pytest.mark.parametrize("missing", ["numba", "numpy", "petsc4py"])
    @pytest.mark.parametrize("words", [[], ["run"]])
    def test_as_a_module_without_its_packages(self, missing, words):
        """A python that has none of them can still read `python -m mgehl`."""
        text = f"import sys, runpy; sys.modules['{missing}'] = None; sys.argv = ['mgehl', *{words}]; "
        text += "runpy.run_module('mgehl', run_name='__main__')"
        done = ended([sys.executable, "-c", text])
        if done.returncode == 0:  # the help needs nothing that is missing
            assert words == [] and done.stderr == "" and "solve one contact" in done.stdout
        else:
            assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
            assert 'eval "$(make -s env)"' in done.stderr


def test_petsc_options_reach_the_solver_and_unknown_ones_are_reported():
    done = mgehl(*DRY, "--out", "here", "-mgehl_ksp_monitor", "-mgehl_snes_monitor", "-mgehl_nonsense", "3")
    assert done.returncode == 0
    assert "KSP Residual norm" in done.stdout
    assert "SNES Function norm" in done.stdout
    text = done.stdout + done.stderr
    left = [line for line in text.splitlines() if "Option left" in line]
    assert len(left) == 1 and "-mgehl_nonsense" in left[0] and "3" in left[0]


def test_a_petsc_option_with_a_value_changes_the_run():
    """The value is not taken for the configuration file."""
    done = mgehl(*DRY, "--out", "here", "-mgehl_snes_max_it", "1")
    assert done.returncode == 1
    assert "NOT CONVERGED" in done.stdout and "1 steps" in done.stdout
    assert "Option left" not in done.stdout + done.stderr


def test_a_directory_that_exists_is_refused_and_replaced_with_force(tmp_path, refused):
    here = tmp_path / "here"
    here.mkdir()
    (here / "result.json").write_text("old")
    assert "here exists: add --force" in refused(*DRY, "--out", "here")
    line = refused(*DRY, "--out", "here", "--force")
    assert "here/result.json" in line and "is left alone" in line
    assert (here / "result.json").read_text() == "old"
    assert [path.name for path in here.iterdir()] == ["result.json"]
    (here / "result.json").unlink()
    for _ in range(2):
        assert status_of(*DRY, "--out", "here", "--force", "--quiet") == 0
    assert json.loads((here / "result.json").read_text())["converged"] is True
    assert names_in(here) == RUN_FILES


BAD = [
    (["run", "missing.toml"], ["missing.toml", "cannot be read"]),
    (["run", "broken.toml"], ["broken.toml", "TOML"]),
    (["run", "--set", "grid.nodes=66"], ["grid.nodes = 66", "65 or 129"]),
    (["run", "--nonsense"], ["--nonsense"]),
    (["check", "--ranks", "0"], ["--ranks 0"]),
    (["check", "--set", "contact.load=1e9"], ["contact.load"]),
    (["info", "missing.toml"], ["missing.toml"]),
    (["run", "one.toml", "two.toml"], ["two.toml"]),
    (["run", "--set"], ["--set"]),
    (["run", "--out", "broken.toml"], ["broken.toml", "is no directory"]),
    (["run", "--out", "broken.toml/deep"], ["broken.toml/deep", "cannot be written"]),
    (["run", "-mgehl_ksp_monitor", "--out", "here"], ["--out", "PETSc options"]),
    (["frobnicate"], ["frobnicate"]),
    (["run", "--set", "contact.kind=line", "--set", "contact.load=1"], ["contact.load = 1", '"line"']),
    (["study", "schemes", "--nodes", "65,257"], ["--nodes 65,257", "129"]),
    (["study", "mixed", "--nodes", "65,129"], ["--nodes 65,129", "one grid"]),
    (["study", "methods", "--nodes", "65"], ["--nodes 65", "grids of its own"]),
    (["study"], ["NAME"]),
    (["study", "frobnicate"], ["frobnicate", "wedge", "schemes"]),
    (["study", "schemes", "--nodes", "100"], ["grid.nodes = 100", "65 or 129"]),
    (["study", "schemes", "--set", "grid.nodes=65"], ["--set", "--nodes"]),
    (["study", "schemes", "--out", "broken.toml"], ["broken.toml", "is no directory"]),
    (["study", "schemes", "--out", "broken.toml/deep"], ["broken.toml/deep", "cannot be written"]),
]


@pytest.mark.parametrize("arguments, parts", BAD, ids=[" ".join(words) for words, _ in BAD])
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, refused, arguments, parts):
    (tmp_path / "broken.toml").write_text("[grid\n")
    line = refused(*arguments)
    assert all(part in line for part in parts)
    assert [path.name for path in tmp_path.iterdir()] == ["broken.toml"]


def test_a_solver_type_that_cannot_be_followed_is_one_line(tmp_path):
    done = mgehl(*DRY, "--out", "here", "-mgehl_snes_type", "newtonls")
    assert done.returncode == 2
    assert done.stderr.startswith("mgehl: -mgehl_snes_type") and len(done.stderr.splitlines()) == 1


def test_a_looser_option_does_not_loosen_the_verdict(tmp_path):
    done = mgehl(*DRY, "--out", "here", "-mgehl_snes_atol", "1e30")
    assert done.returncode == 1
    assert "NOT CONVERGED: the residual of the final state" in done.stdout


KINDS = (UserError, ConfigError, OptionError, OutputError)


@pytest.mark.parametrize("kind", KINDS)
def test_the_message_is_one_line(kind):
    assert str(kind("a\nb\r\nc\x85d\u2028e")) == "a b c d e"


@pytest.mark.parametrize("kind", KINDS)
def test_it_can_be_sent_to_other_ranks(kind):
    sent = pickle.loads(pickle.dumps(kind("why")))
    assert type(sent) is kind and str(sent) == "why"
