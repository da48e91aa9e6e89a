import json
import platform

import numpy
import pytest
from petsc4py import PETSc

from mgehl.cli import main
from mgehl.config_file import chosen_config
from mgehl.version import VERSION


@pytest.fixture
def told(capsys):
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


def test_the_configuration_that_would_be_read(told, tmp_path):
    assert told()["configuration"]["file"] == str(chosen_config().resolve())
    (tmp_path / "mine.toml").write_text("[contact]\nkind = 'line'\n[grid]\nnodes = 129\n")
    expected = {"chosen": "on the command line", "kind": "line", "nodes": 129}
    found = told(str(tmp_path / "mine.toml"))["configuration"]
    assert found == expected | {"file": str(tmp_path / "mine.toml")}


def test_a_configuration_that_cannot_be_read_is_one_line(refused):
    assert "missing.toml" in refused("info", "missing.toml")
