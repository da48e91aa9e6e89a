"""Configurations drawn at random: each is solved, or refused in one line that names a key.

A thousand are read in every run of the tests, and as many solved as take less than a minute;
MGEHL_THOROUGH=1 solves a thousand, new ones every time (about five minutes):

    MGEHL_THOROUGH=1 python -m pytest tests/test_hypothesis.py
"""

import json
import os
import signal
import tempfile
import time
import tomllib
import warnings
from contextlib import contextmanager
from dataclasses import asdict, replace
from math import isfinite
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from configurations import KEYS, raw_tables, solvable_tables
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from independent import wrong
from mpi4py import MPI

from mgehl import solve
from mgehl.config import SECTIONS, config_from_tables, load_config
from mgehl.errors import ConfigError, OutputError, printable
from mgehl.kinds import check_contact, contact_from
from mgehl.output.stored import read_run
from mgehl.run import run

THOROUGH = bool(os.environ.get("MGEHL_THOROUGH"))
SOLVED, RUN = (1000, 100) if THOROUGH else (150, 10)
PATIENCE = 20.0
"""Seconds of computing that 65 nodes may take; three steps take a fiftieth, twenty a tenth."""

REPEATABLE = {
    "derandomize": not THOROUGH,
    "database": None,
    "deadline": None,  # that is `no_longer_than`
    "print_blob": True,
    "suppress_health_check": list(HealthCheck),
}


@contextmanager
def no_longer_than(seconds):
    """Fail where something computes longer, however busy the machine is.

    What takes ten times as long is taken to hang and interrupted, though PETSc may not survive that.
    """

    def give_up(_signal, _frame):
        raise TimeoutError(f"still at it after {10.0 * seconds:g} s")

    before, started = signal.signal(signal.SIGPROF, give_up), time.process_time()
    signal.setitimer(signal.ITIMER_PROF, 10.0 * seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    spent = time.process_time() - started
    assert spent < seconds, f"took {spent:.1f} s of computing"


def accepted(tables):
    """The configuration, or None where it is refused: in one line that names one of its keys."""
    try:
        config = config_from_tables(tables)
        check_contact(config, contact_from(config))
    except ConfigError as error:
        assert_names_a_key(str(error), tables)
        event("refused")
        return None
    event("accepted")
    return config


def assert_names_a_key(message, tables):
    """One line that begins with a key, a section or an unknown name that was given."""
    assert message and len(message.splitlines()) == 1
    sections = {*SECTIONS, *(f"[{name}]" for name in SECTIONS)}
    known = sections | {f"{section}.{key}" for section, key in KEYS}
    given = {name for name in tables}
    given |= {f"{name}.{key}" for name in tables if isinstance(tables[name], dict) for key in tables[name]}
    names = known | {printable(" ".join(name.splitlines())) for name in given}
    assert any(message.startswith(name) for name in names), message


@settings(max_examples=1000, **REPEATABLE)
@given(raw_tables())
def test_every_configuration_is_read_or_refused(tables):
    with no_longer_than(PATIENCE):
        config = accepted(tables)
    if config is not None:
        assert config_from_tables(tomllib.loads(tomli_w.dumps(config.as_toml_tables()))) == config


@settings(max_examples=300, **REPEATABLE)
@given(
    st.sampled_from(sorted(KEYS)).map(".".join) | st.text(max_size=10),
    st.text(max_size=20) | st.floats().map(repr) | st.integers().map(repr),
)
def test_every_setting_is_read_or_refused(name, text):
    try:
        load_config(os.devnull, [f"{name}={text}"])
    except ConfigError as error:
        assert len(str(error).splitlines()) == 1


@settings(max_examples=SOLVED, **REPEATABLE)
@given(solvable_tables())
def test_every_contact_is_solved_or_refused(tables):
    config = accepted(tables)
    if config is None:
        return
    with no_longer_than(PATIENCE), no_warnings():
        solution = solve(config, MPI.COMM_SELF)
    result = solution.summary
    assert len(result.reason.splitlines()) == 1 and str(solution)
    event(f"{config.contact.kind}, {'converged' if result.converged else 'not converged'}")
    if not is_finite(solution):
        event(f"not finite: {result.reason[:8]}")
        assert not result.converged
    elif result.converged and config.contact.kind != "wedge" and "moes" not in tables:
        assert wrong(solution) == ""


@settings(max_examples=RUN, **REPEATABLE)
@given(solvable_tables())
def test_every_run_leaves_files_that_read_back(tables):
    config = accepted(tables)
    if config is None:
        return
    with tempfile.TemporaryDirectory() as directory, no_longer_than(PATIENCE), no_warnings():
        result = run(config, Path(directory), MPI.COMM_SELF)
        json.loads((Path(directory) / "result.json").read_text(), parse_constant=pytest.fail)
        try:
            read = read_run(directory)
        except OutputError as error:
            assert "not finite" in str(error) and not result.converged
            event("not finite")
            return
    # An automatic domain is kept in numbers: a later version may choose another.
    kept = replace(config, grid=read.config.grid)
    assert read.config == kept and read.config.grid.nodes == config.grid.nodes
    assert read.summary.reason == result.reason


def is_finite(solution):
    fields = solution.film, solution.pressure
    numbers = numbers_of(asdict(solution.summary))
    return all(map(isfinite, numbers)) and all(np.isfinite(field).all() for field in fields)


@contextmanager
def no_warnings():
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        yield


def numbers_of(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return [number for each in value for number in numbers_of(each)]
    return [value] if isinstance(value, float) else []
