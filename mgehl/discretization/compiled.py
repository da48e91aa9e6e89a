"""Functions compiled by numba, kept on disk from run to run where that can be done.

Where it cannot (no directory that may be written, a full disk, a file that is damaged) they are compiled
again, which takes some seconds.
"""

from numba import njit


def compiled(**options):
    """A decorator as `numba.njit`, with a cache that may fail. Nothing may be fused (`fastmath`): what is
    depends on whether a function was compiled just now, and with it the digits."""

    def decorate(function):
        dispatcher = njit(**options)(function)
        try:
            dispatcher.enable_caching()
        except (RuntimeError, OSError):  # no place for one
            return dispatcher
        dispatcher._cache = _Lenient(dispatcher._cache)
        return dispatcher

    return decorate


class _Lenient:
    """Numba's cache of one function: it has not what it cannot read, and keeps not what it cannot write."""

    def __init__(self, cache):
        self._cache = cache

    def load_overload(self, *arguments):
        try:
            return self._cache.load_overload(*arguments)
        except Exception:  # what a damaged file raises is anybody's guess
            return None

    def save_overload(self, *arguments):
        try:
            self._cache.save_overload(*arguments)
        except OSError:
            pass

    def __getattr__(self, name):
        return getattr(self._cache, name)
