import json

import pytest

from mgehl.cli import main
from mgehl.config_file import chosen_config


@pytest.fixture
def told(capsys):
    def run(*arguments):
        assert main(["info", "--json", *arguments]) == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_the_configuration_that_would_be_read(told, tmp_path):
    assert told()["configuration"]["file"] == str(chosen_config().resolve())
    (tmp_path / "mine.toml").write_text("[contact]\nkind = 'line'\n[grid]\nnodes = 129\n")
    expected = {"chosen": "on the command line", "kind": "line", "nodes": 129}
    found = told(str(tmp_path / "mine.toml"))["configuration"]
    assert found == expected | {"file": str(tmp_path / "mine.toml")}
