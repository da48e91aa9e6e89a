"""What may end a run before its time."""

import os
import signal
import subprocess
import sys
import time

import pytest

from mgehl.errors import Stopped
from mgehl.stopping import SIGNALS, StopWhenTold

STATUS = {signal.SIGTERM: 143, signal.SIGINT: 130, signal.SIGHUP: 129}
NAME = {signal.SIGTERM: "SIGTERM", signal.SIGINT: "Ctrl-C", signal.SIGHUP: "SIGHUP"}


def handlers():
    return {number: signal.getsignal(number) for number in SIGNALS}


@pytest.mark.parametrize("number", STATUS, ids=NAME.values())
def test_a_signal_is_a_request_with_its_status(number):
    with StopWhenTold("go on so") as stop:
        assert stop() is None
        os.kill(os.getpid(), number)
        stopped = stop()
    assert isinstance(stopped, Stopped)
    assert stopped.status == STATUS[number]
    assert str(stopped) == f"stopped by {NAME[number]}; go on so"


@pytest.mark.parametrize("told", [False, True])
def test_handlers_are_what_they_were_afterwards(told):
    before = handlers()
    with StopWhenTold("hint"):
        assert all(handlers()[number] != before[number] for number in SIGNALS)
        if told:
            os.kill(os.getpid(), signal.SIGTERM)
    assert handlers() == before


@pytest.mark.parametrize("number", STATUS, ids=NAME.values())
def test_the_second_ends_the_process(number):
    text = (
        "import os, sys\n"
        "from mgehl.stopping import StopWhenTold\n"
        "with StopWhenTold('hint'):\n"
        "    for _ in range(2):\n"
        "        print('alive', flush=True)\n"
        f"        os.kill(os.getpid(), {int(number)})\n"
        "    print('still alive', flush=True)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (-number, "alive\nalive\n", "")


def test_a_limit_of_time():
    with StopWhenTold("go on so", time_limit=0.05) as stop:
        assert stop() is None
        time.sleep(0.06)
        stopped = stop()
    assert stopped.status == 143
    assert str(stopped) == "stopped by --time-limit after 0.05 s; go on so"


def test_what_is_ignored_stays_ignored():
    """As under nohup."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with StopWhenTold("hint") as stop:
            os.kill(os.getpid(), signal.SIGHUP)
            assert stop() is None
    finally:
        signal.signal(signal.SIGHUP, before)
