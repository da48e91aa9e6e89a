"""Format, lint and the types of the Python interface: what pre-commit asks, too."""

import subprocess
import sys
from pathlib import Path

import constants
import pytest

from mgehl.config import load_config

ROOT = Path(__file__).resolve().parent.parent


@pytest.mark.parametrize(
    "tool", ["ruff format --check mgehl tests configs", "ruff check mgehl tests configs", "mypy"]
)
def test_a_tool_has_nothing_to_say(tool):
    pytest.importorskip(tool.split()[0])
    done = subprocess.run(
        [sys.executable, "-m", *tool.split()], cwd=ROOT, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_number_that_steers_a_solve_can_be_changed():
    """By the tool that tells what it does: in its place, and nothing else."""
    found = list(constants.numbers())
    assert len({number.path for number in found}) > 20
    for number in found:
        text = (ROOT / number.path).read_text()
        assert number.changed(text, number.value).count("\n") == text.count("\n")
        low, high = number.others()
        assert low < number.value < high
        scope = {}
        line = number.changed(text, high).splitlines()[number.place[0]]
        exec(line, scope)
        assert scope[number.name] == high


def test_cases_of_that_tool_are_configurations():
    for name, settings in constants.CASES.values():
        load_config(ROOT / "configs" / f"{name}.toml", settings)
