import pickle

import numpy as np
import pytest

from mgehl.errors import UserError
from mgehl.model.own_function import OwnFunction, OwnFunctionError

SHAPE = (2, 3)
WITH_A_DATACLASS = """
from __future__ import annotations
from dataclasses import dataclass

@dataclass
class Constant:
    value: float

def law(p):
    return Constant(2.0).value, 0.0
"""


@pytest.fixture
def own(tmp_path):
    def make(text, name="law"):
        (tmp_path / "mine.py").write_text(text)
        return OwnFunction(f"{tmp_path}/mine.py:{name}")

    return make


def refusal(function, *arguments):
    with pytest.raises(OwnFunctionError) as caught:
        function.check_arguments(*arguments)
        function.pair(SHAPE, *(np.zeros(SHAPE) for _ in arguments))
    start, _, what = str(caught.value).partition("mine.py:law': ")
    assert start.startswith("'/") and caught.value.function is function and "\n" not in what
    return what


@pytest.mark.parametrize(
    "text, words",
    [
        ("x = 1", "the file has no function law"),
        ("law = 1", "the file has no function law"),
        ("def law(p:\n", "the file cannot be run: SyntaxError: "),
        ("\nimport no_such_module_at_all",
         "ModuleNotFoundError: No module named 'no_such_module_at_all' (line 2)"),
        ("import sys\nsys.exit('over')", "the file cannot be run: SystemExit: over (line 2)"),
        ("def law(): return 1, 2", "must take 1 arguments: p"),
        ("def law(p, q): return 1, 2", "must take 1 arguments: p"),
        ("def law(p):\n  q = 0\n  return 1 / q, 0", "raises ZeroDivisionError: division by zero (line 3)"),
        ("def law(p): return p", "must return two arrays, the value and its derivative"),
        ("def law(p): return p, p, p", "must return two arrays, the value and its derivative"),
        ("def law(p): return p, p[0, :2]",
         "must return numbers of shape (2, 3), returns ndarray of shape (2,)"),
        ("def law(p): return p, (p, 1.0)",
         "must return numbers of shape (2, 3), returns tuple of 2 parts"),
        ("def law(p): return p, 1j * p", "must return real numbers, returns complex ones"),
        ("def law(p): return p, '0.5'", "must return numbers, returns the text '0.5'"),
    ],
)  # fmt: skip
def test_what_goes_wrong_is_one_line(own, text, words):
    assert words in refusal(own(text), "p")


def test_a_file_that_is_not_there(own, tmp_path):
    function = own("")
    (tmp_path / "mine.py").unlink()
    assert refusal(function, "p") == "cannot be read: No such file or directory"


def test_a_file_that_changed_is_read_anew_at_the_next_start(own):
    function = own("def law(p): return 1.0, 0.0")
    function.check_arguments("p")
    assert function.pair((), 0.0)[0] == 1.0
    own("def law(p): return 2.0, 0.0")
    assert function.pair((), 0.0)[0] == 1.0  # not in the middle of a run
    function.check_arguments("p")
    assert function.pair((), 0.0)[0] == 2.0


def test_an_error_goes_from_rank_to_rank(own):
    error = own("").error("must be other\nthan this")
    copy = pickle.loads(pickle.dumps(error))
    assert isinstance(copy, UserError) and str(copy) == str(error) and copy.function == error.function


def test_dataclasses_and_pickles(own):
    function = own(WITH_A_DATACLASS)
    copy = pickle.loads(pickle.dumps(function))
    assert copy == function and hash(copy) == hash(function)
    assert copy.pair((), 0.0)[0] == 2.0
