"""Names, limits and surroundings that are not meant well: an answer, or one line with its status."""

import os
import shutil
from pathlib import Path

import pytest
from processes import MGEHL, ended

from mgehl.cli import main

WEDGE = ["run", "--set", "contact.kind=wedge", "--set", "grid.nodes=65", "--quiet"]
NAME = os.fsdecode(b"\xff\xfe")
"""Of a directory: no text in UTF-8."""

pytestmark = pytest.mark.usefixtures("empty_directory")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    out = tmp_path_factory.mktemp("finished") / "wedge"
    assert main([*WEDGE, "--out", str(out)]) == 0
    return out


def process(*words, before="", **variables):
    done = ended(["bash", "-c", f'{before} "$@"', "-", *MGEHL, *words], **variables)
    return done.returncode, done.stderr.splitlines()


class TestNamesThatAreNoText:
    READERS = [
        ["report"], ["plot", "--kind", "lines", "--format", "png"], ["collect"], ["export", "--to", "npz"],
        ["export", "--to", "vts"], ["export", "--to", "nc"], ["export", "--to", "csv"],
        ["run", "--quiet", "--resume"],
    ]  # fmt: skip

    @pytest.mark.parametrize("words", READERS, ids=" ".join)
    def test_a_run_there_is_read(self, finished, capsys, words):
        shutil.copytree(finished, NAME)
        position = 1 if words[0] != "run" else len(words)
        assert main([*words[:position], NAME, *words[position:]]) == 0
        assert capsys.readouterr().err == ""

    def test_a_run_begins_stops_and_goes_on_there(self, capsys):
        words = ["run", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--quiet", "--out", NAME]
        assert main([*words, "--time-limit", "1e-9"]) == 143
        assert main(["run", "--resume", NAME, "--quiet"]) == 0
        assert main(["run", f"{NAME}/configuration.toml", "--quiet", "--out", f"{NAME}/again"]) == 0
        assert all(line.isprintable() for line in capsys.readouterr().err.splitlines())


@pytest.mark.parametrize("style", ["/dev/zero", "pipe", "folder"])
def test_a_style_without_end(finished, refused, style):
    os.mkfifo("pipe")
    Path("folder").mkdir()
    shutil.copytree(finished, "wedge")
    line = refused("plot", "wedge", "--style", style)
    assert style in line and "cannot be read" in line


@pytest.mark.parametrize("kilobytes", [450000, 560000, 700000])
def test_a_limit_of_memory_that_is_too_low(kilobytes):
    """It ended in BLAS, never, in a dozen lines of MPI, or in a unit that was not understood."""
    before = f"ulimit -v {kilobytes};"
    status, lines = process("run", "--set", "grid.nodes=513", "--out", "here", before=before)
    assert status == 2 and len(lines) == 1, lines
    assert lines[0].endswith(f"allows {kilobytes / 1024:.0f} (ulimit -v)")
    assert not Path("here").exists()


PLAIN = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


@pytest.mark.parametrize("variables", [{"PYTHONWARNINGS": "error"}, PLAIN])
def test_surroundings_in_which_a_run_goes_on(variables):
    assert process(*WEDGE, "--out", "über µ", **variables) == (0, [])
    assert process("report", "über µ", **variables) == (0, [])
    assert process("collect", "über µ", **variables) == (0, [])


def test_without_any_surroundings():
    """Where the packages are found without it, it runs; elsewhere it says how to put the environment on."""
    status, lines = process(*WEDGE, "--out", "here", before="env -i")
    assert (status, lines) == (0, []) or (status == 2 and len(lines) == 1 and "make -s env" in lines[0])
