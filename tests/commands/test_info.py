"""mgehl info: what it says is what is there."""

import json
import platform

import numpy
import pytest
from petsc4py import PETSc

from mgehl.cli import main
from mgehl.config import chosen_config
from mgehl.version import VERSION


@pytest.fixture
def told(capsys):
    """Function that runs `mgehl info --json` and returns what it printed."""

    def run(*arguments):
        assert main(["info", "--json", *arguments]) == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_versions_are_those_of_what_is_imported(told):
    found = told()
    assert found["versions"]["mgehl"] == VERSION
    assert found["versions"]["python"] == platform.python_version()
    assert found["versions"]["numpy"] == numpy.__version__
    assert found["petsc"]["version"] == ".".join(map(str, PETSc.Sys.getVersion()))


def test_petsc_tells_how_it_was_configured(told):
    petsc = told()["petsc"]
    assert "--with" in petsc["configured"] and "\n" not in petsc["configured"]
    assert petsc["debug"] is ("--with-debugging=1" in petsc["configured"])
    assert petsc["integers"] in ("32 bits", "64 bits")
    assert petsc["precision"] == "float64, 8 bytes"


def test_threads_and_machine(told, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    found = told()
    assert found["threads"]["OMP_NUM_THREADS"] == "3" and found["threads"]["MKL_NUM_THREADS"] is None
    assert found["mpi"]["ranks"] == 1
    assert 1 <= found["machine"]["cores_allowed"] <= found["machine"]["cores"]
    assert found["machine"]["memory_GiB"] > 0.1


def test_the_configuration_that_would_be_read(told, tmp_path):
    assert told()["configuration"]["file"] == str(chosen_config().resolve())
    (tmp_path / "mine.toml").write_text("[contact]\nkind = 'line'\n[grid]\nnodes = 129\n")
    expected = {"chosen": "on the command line", "kind": "line", "nodes": 129}
    found = told(str(tmp_path / "mine.toml"))["configuration"]
    assert found == expected | {"file": str(tmp_path / "mine.toml")}


def test_lines_are_aligned_and_broken_but_no_path_is(capsys, monkeypatch, tmp_path):
    long = tmp_path / (90 * "x")
    long.write_text("")
    assert main(["info", str(long)]) == 0
    whole = capsys.readouterr().out
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["info", str(long)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert str(long) in lines[1] and max(len(line) for line in lines if "/" not in line) <= 60
    assert [line for line in lines if line[0] != " "] == [
        "configuration", "versions", "petsc", "mpi", "threads", "fft", "compiled", "machine"
    ]  # fmt: skip
    assert all(line[24] == " " and line[25] != " " for line in lines if line[0] == " ")
    assert " ".join(lines).split() == whole.split()


def test_a_configuration_that_cannot_be_read_is_one_line(capsys):
    assert main(["info", "missing.toml"]) == 2
    out, err = capsys.readouterr()
    assert out == "" and "missing.toml" in err and len(err.splitlines()) == 1
