"""What may end a run before its time: a signal, Ctrl-C or a limit of time."""

import signal
import threading
import time

from mgehl.errors import Stopped

SIGNALS = {signal.SIGTERM: "SIGTERM", signal.SIGINT: "Ctrl-C", signal.SIGHUP: "SIGHUP"}
"""Those that whoever started mgehl has not had ignored, as nohup does with the last."""


class StopWhenTold:
    """A context manager in which the first signal is a request, asked for by calling, and the second ends
    the process. `hint` tells how to go on. A limit of time ends nothing before the second call: whoever
    goes on again and again within the shortest gets on."""

    _second = signal.SIG_DFL

    def __init__(self, hint, time_limit=None):
        self._hint, self._limit = hint, time_limit
        self._started, self._signal, self._before = time.monotonic(), None, {}
        self._asked = 0

    def __enter__(self):
        self._before = {number: signal.signal(number, self._take) for number in self._heeded()}
        return self

    def __exit__(self, *_):
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def __call__(self):
        """None, or the `Stopped` to raise as soon as everything is on disk."""
        if self._signal is not None:
            return Stopped(f"stopped by {SIGNALS[self._signal]}; {self._hint}", 128 + self._signal)
        self._asked += 1
        if self._limit is not None and self._asked > 1 and time.monotonic() - self._started >= self._limit:
            status = 128 + signal.SIGTERM
            return Stopped(f"stopped by --time-limit after {self._limit:g} s; {self._hint}", status)
        return None

    def _heeded(self):
        return [number for number in SIGNALS if signal.getsignal(number) != signal.SIG_IGN]

    def _take(self, number, _frame):
        self._signal = number
        signal.signal(number, self._second)


class StopOnCtrlC(StopWhenTold):
    """The same for scripts and notebooks: of Ctrl-C alone, where nobody else has taken it; a second one
    raises KeyboardInterrupt wherever it is.
    """

    _second = signal.default_int_handler

    def __init__(self):
        super().__init__("nothing is kept")

    def _heeded(self):
        is_free = signal.getsignal(signal.SIGINT) is signal.default_int_handler
        return [signal.SIGINT] if is_free and threading.current_thread() is threading.main_thread() else []
