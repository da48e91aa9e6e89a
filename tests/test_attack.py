"""Small samples of the attacks that tests/tools/attack.py makes by the thousand."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

TOOL = Path(__file__).parent / "tools" / "attack.py"


@pytest.mark.parametrize(
    "attack, count", [("words", 15), ("cases", 6), ("damage", 6), ("flips", 6), ("writers", 1)]
)
def test_a_few_find_nothing(attack, count):
    words = [sys.executable, str(TOOL), attack, "--count", str(count), "--seed", "11"]
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_"))}
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    assert json.loads(done.stdout.splitlines()[-1])["findings"] == 0
