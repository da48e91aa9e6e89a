"""A function of a user's own file, named "FILE.py:FUNCTION" in a configuration."""

import inspect
import re
import sys
import traceback
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np

from mgehl.errors import UserError, one_line

_NAME = re.compile(r"(?P<file>[^\0\n]+\.py):(?P<function>[^\W\d]\w*)")


def is_own(value):
    """True of "FILE.py:FUNCTION"."""
    return isinstance(value, str) and _NAME.fullmatch(value) is not None


def absolute(value, directory="."):
    """The same function, the path of its file counted from `directory`; None of anything else."""
    if not is_own(value):
        return None
    match = _NAME.fullmatch(value)
    return f"{(Path(directory) / match['file']).resolve()}:{match['function']}"


def file_and_function(value):
    """The file and the function of "FILE.py:FUNCTION"; None of anything else."""
    match = _NAME.fullmatch(value) if isinstance(value, str) else None
    return match and (match["file"], match["function"])


class OwnFunctionError(UserError):
    """What is wrong with a `function` of the user's, in one line: it begins with file and name."""

    def __init__(self, function, what):
        super().__init__(f"{function.value!r}: {what}")
        self.function, self._what = function, what

    def __reduce__(self):
        return OwnFunctionError, (self.function, self._what)  # it may go from rank to rank


@dataclass(frozen=True)
class OwnFunction:
    """Runs the file when the function is first called; what goes wrong is an OwnFunctionError."""

    value: str
    """FILE.py:FUNCTION"""

    def array(self, shape, *arguments):
        """Call it; its result as doubles of the `shape`."""
        return self._shaped(shape, self._call(arguments))

    def pair(self, shape, *arguments):
        """Call it; a value and its derivative as doubles of the `shape`."""
        results = self._call(arguments)
        if not isinstance(results, tuple | list) or len(results) != 2:
            raise self.error("must return two arrays, the value and its derivative")
        return [self._shaped(shape, each) for each in results]

    def check_arguments(self, *names):
        """Refuse a function that cannot be called with these arguments by position. The file is read anew:
        in a notebook it may have changed since the last run."""
        _run.cache_clear()
        try:
            inspect.signature(self._function()).bind(*names)
        except TypeError:
            raise self.error(f"must take {len(names)} arguments: {', '.join(names)}") from None
        except ValueError:
            pass  # compiled ones may not tell

    def error(self, what):
        """The error that says what is wrong with this function."""
        return OwnFunctionError(self, what)

    def _shaped(self, shape, result):
        try:
            if np.iscomplexobj(result):
                raise self.error("must return real numbers, returns complex ones")
            if np.asarray(result).dtype.kind in "SU":
                raise self.error(f"must return numbers, returns the text {result!r}")
            return np.broadcast_to(np.asarray(result, dtype=float), shape)
        except (TypeError, ValueError):
            parts = isinstance(result, tuple | list)  # of several lengths: they have no shape
            size = f"{len(result)} parts" if parts else f"shape {np.shape(result)}"
            found = f"{type(result).__name__} of {size}"
            raise self.error(f"must return numbers of shape {shape}, returns {found}") from None

    def _call(self, arguments):
        function = self._function()
        try:
            with np.errstate(all="ignore"):
                return function(*arguments)
        except (Exception, SystemExit) as error:
            raise self.error(f"raises {self._describe(error)}{_not_given(arguments)}") from None

    def _function(self):
        match = _NAME.fullmatch(self.value)
        try:
            module = _run(match["file"])
        except OSError as error:
            raise self.error(f"cannot be read: {error.strerror or error}") from None
        except (Exception, SystemExit) as error:
            raise self.error(f"the file cannot be run: {self._describe(error)}") from None
        function = getattr(module, match["function"], None)
        if not callable(function):
            raise self.error(f"the file has no function {match['function']}")
        return function

    def _describe(self, error):
        """An error and the line of the file that it comes from."""
        file = _NAME.fullmatch(self.value)["file"]
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.lineno for frame in frames if frame.filename == file]
        if isinstance(error, SyntaxError):
            lines = [error.lineno]
        where = f" (line {lines[-1]})" if lines else ""
        return f"{type(error).__name__}: {one_line(error, 200)}{where}"


@dataclass(frozen=True)
class StoredFunction(OwnFunction):
    """That of a run which is only read: its file may be anybody's, and is never run."""

    def _function(self):
        raise self.error("is not run where results are read")


def without_running(thing):
    """A contact, or any dataclass, with `StoredFunction` for each `OwnFunction` in it, however deep."""
    if isinstance(thing, OwnFunction):
        return StoredFunction(thing.value)
    if not is_dataclass(thing):
        return thing
    found = {each.name: getattr(thing, each.name) for each in fields(thing) if each.init}
    stored = {name: without_running(each) for name, each in found.items()}
    return replace(thing, **stored) if any(stored[name] is not found[name] for name in found) else thing


def _not_given(arguments):
    """What a law that failed may have missed: its conditions that the configuration does not name."""
    told = [
        (each.name, getattr(at, each.name)) for at in arguments if is_dataclass(at) for each in fields(at)
    ]
    missing = ", ".join(f"at.{name}" for name, value in told if value is None)
    return f" ({missing}: None here)" if missing else ""


@cache
def _run(file):
    """The module of a file. (Importing it would leave a cache beside it, and may read a stale one.)"""
    if Path(file).exists() and not Path(file).is_file():  # a pipe or a device may have no end
        raise OSError("is no file")
    module = ModuleType(f"mgehl own {file}")
    module.__file__ = file
    code = compile(Path(file).read_bytes(), file, "exec")
    sys.modules[module.__name__] = module  # where dataclasses look for the names of their fields
    exec(code, module.__dict__)
    return module
