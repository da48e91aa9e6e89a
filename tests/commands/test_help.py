import os
import shlex
import sys

import pytest
from places import ROOT
from processes import ended

from mgehl.cli import main, parser
from mgehl.commands import COMMANDS

SMALL = ["grid.nodes=65", "motion.speed=0.5 m/s", "solver.start=film"]


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    here = tmp_path_factory.mktemp("examples")
    settings = [f"--set={setting}" for setting in SMALL]
    assert main(["run", *settings, "--out", str(here / "runs" / "try"), "--quiet"]) == 0
    return here


def subparser(name):
    (commands,) = (action for action in parser()._actions if action.dest == "command")
    return commands.choices[name]


def example(name):
    """The words of a command's example, for this interpreter and whatever tree it tests."""
    words = shlex.split(subparser(name).epilog.removeprefix("example: "))
    if words[0] == "mgehl":
        words = ["python", "-m", *words]
    return [sys.executable if word == "python" else word for word in words]


@pytest.mark.parametrize("columns", [80, 120])
@pytest.mark.parametrize("name", COMMANDS)
def test_help_ends_with_the_example_as_it_is_to_be_typed(name, columns, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", str(columns))
    with pytest.raises(SystemExit) as stop:
        main([name, "--help"])
    assert stop.value.code == 0
    text = capsys.readouterr().out.rstrip()
    assert max(map(len, text.splitlines())) <= columns
    last = text[text.rindex("example: ") :]
    assert last.count("\n") == last.count(" \\\n") < len(last.splitlines())
    typed = shlex.split(last.removeprefix("example: ").replace("\\\n", ""))
    assert typed == shlex.split(subparser(name).epilog.removeprefix("example: "))
    assert f"mgehl {name}" in last


def test_mgehl_alone_is_a_question_for_help(capsys):
    with pytest.raises(SystemExit) as stop:
        main([])
    out, err = capsys.readouterr()
    assert stop.value.code == 0 and err == "" and all(f"\n    {name}" in out for name in COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_the_example_runs(name, directory):
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    done = ended(example(name), 300, directory, PYTHONPATH=path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
