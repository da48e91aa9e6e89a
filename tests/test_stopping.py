import os
import signal
import sys

import pytest
from processes import ended

from mgehl.stopping import SIGNALS, StopWhenTold


def handlers():
    return {number: signal.getsignal(number) for number in SIGNALS}


@pytest.mark.parametrize("told", [False, True])
def test_handlers_are_what_they_were_afterwards(told):
    before = handlers()
    with StopWhenTold("hint"):
        assert all(handlers()[number] != before[number] for number in SIGNALS)
        if told:
            os.kill(os.getpid(), signal.SIGTERM)
    assert handlers() == before


@pytest.mark.parametrize("number", SIGNALS)
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
    done = ended([sys.executable, "-c", text])
    assert (done.returncode, done.stdout, done.stderr) == (-number, "alive\nalive\n", "")


def test_what_is_ignored_stays_ignored():
    """As under nohup."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with StopWhenTold("hint") as stop:
            os.kill(os.getpid(), signal.SIGHUP)
            assert stop() is None
    finally:
        signal.signal(signal.SIGHUP, before)
