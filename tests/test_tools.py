import sys

import pytest
from places import ROOT
from processes import ended


@pytest.mark.parametrize(
    "tool", ["ruff format --check mgehl tests configs", "ruff check mgehl tests configs", "mypy"]
)
def test_a_tool_has_nothing_to_say(tool):
    pytest.importorskip(tool.split()[0])
    done = ended([sys.executable, "-m", *tool.split()], 300, ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
