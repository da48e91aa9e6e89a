"""What tests/tools/processes.py gives to processes that tests begin."""

import os
import subprocess
import sys
from pathlib import Path

import processes

TOOLS = Path(processes.__file__).parent
BEGINS = """
import subprocess, sys
from mpi4py import MPI
sys.exit(subprocess.run([sys.executable, "-c", sys.argv[1]]).returncode)
"""
RANKS = """
import subprocess, sys
from processes import own_environment
sys.exit(subprocess.run(["mpiexec", "-n", "2", "echo", "heard"], env=own_environment()).returncode)
"""


def test_ranks_begin_below_a_process_that_called_mpi():
    """Those of pytest-xdist may be such ones. Without this, mpiexec ends with status 1 and no word."""
    path = os.pathsep.join([str(TOOLS), os.environ.get("PYTHONPATH", "")])
    environment = processes.own_environment(PYTHONPATH=path)
    words = [sys.executable, "-c", BEGINS, RANKS]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (0, "heard\nheard\n")
