"""Every command's help ends with an example, and every example runs."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from mgehl.cli import main, parser
from mgehl.commands import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
SMALL = ["grid.nodes=65", "motion.speed=0.5 m/s", "solver.start=film"]


def own_environment():
    """This one's, without what MPI set for this process and with mgehl importable anywhere."""
    kept = {
        k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_", "PMI_"))
    }
    return kept | {"PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])}


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    """A directory with a small run in runs/try, which examples may name."""
    here = tmp_path_factory.mktemp("examples")
    settings = [word for setting in SMALL for word in ("--set", setting)]
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


@pytest.mark.parametrize("name", COMMANDS)
def test_help_ends_with_the_example_as_it_is_to_be_typed(name, capsys):
    with pytest.raises(SystemExit) as stop:
        main([name, "--help"])
    assert stop.value.code == 0
    last = capsys.readouterr().out.rstrip().splitlines()[-1]
    assert last == subparser(name).epilog and last.startswith("example: ") and f"mgehl {name}" in last


@pytest.mark.parametrize("name", COMMANDS)
def test_the_example_runs(name, directory):
    done = subprocess.run(
        example(name), cwd=directory, env=own_environment(), capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
