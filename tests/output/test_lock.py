import os
import signal
import subprocess
import sys

import pytest
from mpi4py import MPI

from mgehl.errors import OutputError
from mgehl.output.lock import NAME, locked

HOLDER = (
    "import sys, time\n"
    "from mpi4py import MPI\n"
    "from mgehl.output.lock import locked\n"
    "with locked(MPI.COMM_SELF, sys.argv[1]):\n"
    "    print('held', flush=True)\n"
    "    time.sleep(60)\n"
)


@pytest.fixture
def holder(tmp_path):
    words = [sys.executable, "-c", HOLDER, str(tmp_path)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=dict(os.environ))
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.communicate()


def test_a_second_writer_is_refused_by_name(tmp_path, holder):
    with pytest.raises(OutputError, match=f"being written by mgehl process {holder.pid} on"):
        with locked(MPI.COMM_SELF, tmp_path):
            pass


def test_a_dead_process_keeps_nothing(tmp_path, holder):
    os.kill(holder.pid, signal.SIGKILL)
    holder.wait()
    assert (tmp_path / NAME).exists()
    with locked(MPI.COMM_SELF, tmp_path):
        pass


def test_a_link_in_its_place_is_not_followed(tmp_path):
    (tmp_path / "precious").write_text("mine")
    (tmp_path / NAME).symlink_to(tmp_path / "precious")
    with pytest.raises(OutputError, match="cannot be written"):
        with locked(MPI.COMM_SELF, tmp_path):
            pass
    assert (tmp_path / "precious").read_text() == "mine"
