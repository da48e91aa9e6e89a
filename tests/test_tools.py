import subprocess
import sys
from pathlib import Path

import pytest

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
