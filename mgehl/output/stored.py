"""A run read back from its fields.h5, for pictures, reports, exports and new starts.

fields.h5 holds all of a run. The other files of its directory are copies, and are not read. Each part of
fields.h5 has a checksum of HDF5's: what is damaged is refused. Nothing that a file holds is ever run.
"""

import csv
import json
import tomllib
from math import nan
from pathlib import Path

import dacite
import h5py
import numpy as np

from mgehl.config_value import AUTO
from mgehl.discretization.status import NAMES
from mgehl.errors import NoRunError, OutputError, one_line
from mgehl.kinds import contact_from, mesh_from
from mgehl.model.own_function import without_running
from mgehl.output import files
from mgehl.output.checkpoint import is_begun
from mgehl.output.fields import Fields
from mgehl.output.frames import StoredFrames
from mgehl.output.laws import is_law, laws_in, placed
from mgehl.output.result import Result
from mgehl.output.solution import Solution
from mgehl.output.whole_file import is_plain


def _real(value):
    if type(value) not in (int, float, type(None)):
        raise ValueError(f"{value!r} is no number")
    return nan if value is None else float(value)


AS_JSON = dacite.Config(cast=[tuple], type_hooks={float: _real})
"""JSON knows neither tuples nor numbers that are not finite (they are null)."""


def result_from(tables):
    """The `Result` that nested plain values stand for; its numbers that are null are nan. Raises
    ValueError, TypeError or DaciteError where they stand for none."""
    return dacite.from_dict(Result, tables, AS_JSON)


def read_run(directory) -> Solution:
    """The `Solution` that a finished run left in its directory, fields and all, on this rank.

    Its own laws are not run: the directory may be anybody's. Raises OutputError where there is none,
    or it is damaged.
    """
    return _read(directory, _solution)


def read_texts(directory):
    """{name: text} of the files of a finished run. Raises OutputError."""
    return _read(directory, _texts)


def files_of(directory):
    """Names of the files that the run in a directory wrote; none where there is no run."""
    try:
        texts = read_texts(directory)
        tables = tomllib.loads(texts[files.CONFIGURATION])
        own = {*filter(is_law, laws_in(tables)), *({*files.NAMES} & texts.keys())}
    except (OutputError, ValueError, KeyError):
        return set()
    in_time = {files.SERIES, files.FRAMES} if "end" in tables.get("time", {}) else set()
    return own | {files.FIELDS, files.PICTURE} | in_time


def _read(directory, found):
    """What is `found(file, directory)` in the fields.h5 of a directory. Raises OutputError."""
    directory = Path(directory)
    path = directory / files.FIELDS
    if not is_plain(path):
        if is_begun(directory):
            raise NoRunError(f"{directory}: has not finished: go on with: mgehl run --resume {directory}")
        if is_plain(directory / files.STUDY):
            raise NoRunError(f"{directory}: is a sweep or a study, whose runs are {directory}/runs/*")
        raise NoRunError(f"{directory}: is no run directory: it has no {files.FIELDS}")
    try:
        with h5py.File(path, "r") as file:
            return found(file, directory)
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise OutputError(f"{path}: is damaged, or no run of mgehl: {one_line(error)}") from None


def _texts(file, _directory):
    if files.WHOLE not in file:
        raise ValueError("it is of mgehl 0.1: solve it anew")
    return json.loads(file[files.WHOLE][()].tobytes())


def _solution(file, directory):
    texts = _texts(file, directory)
    tables, record = tomllib.loads(texts[files.CONFIGURATION]), json.loads(texts[files.RESULT])
    places = {name: str((directory / name).resolve()) for name in laws_in(tables)}
    courses = {key: each[()] for key, each in file.get(files.COURSES, {}).items()}
    config = placed(tables, places, courses).with_numbers(record.get(files.INPUTS, {}))
    named = config.as_toml_tables()["grid"]
    if config.kind.is_loaded and AUTO in (named.get("x"), named.get("y")):
        raise ValueError("it has no domain in numbers, as a finished run has")
    contact = without_running(contact_from(config))
    mesh = mesh_from(config, contact)
    fields, result, H0 = _fields(file, mesh), result_from(record), float(file.attrs["H0"])
    if not np.isfinite(H0):
        raise ValueError("H0 is not finite")
    frames = StoredFrames(directory / files.FRAMES)
    kept = frames if config.is_in_time and is_plain(frames.path) else None
    rows = _rows(texts[files.HISTORY])
    return Solution(config, contact, mesh, fields, rows, result, H0, frames=kept)


def _fields(file, mesh):
    """`Fields` of the whole grid of this mesh."""
    names = ["P", "H", "status", *({"p", *files.FURTHER} & file.keys())]
    if any(file[name].shape != (mesh.ny, mesh.nx) for name in names):
        raise ValueError(f"its fields are not of {mesh.nx} x {mesh.ny} nodes")
    fields = Fields(**{name: file[name][()] for name in names})
    if not all(np.isfinite(array).all() for array in fields.named.values()):
        raise ValueError("its fields are not finite everywhere")
    if not np.isin(fields.status, range(len(NAMES))).all():
        raise ValueError("it has nodes of a status that there is not")
    return fields


def _rows(text):
    """Rows of a history.csv, numbers as numbers; none of a run in time that did not find its beginning."""
    if not text.strip():
        return []
    names, *rows = csv.reader(text.splitlines())
    if not rows or "residual" not in names:
        raise ValueError("its history is none of a run")
    return [dict(zip(names, map(_as_number, row), strict=True)) for row in rows]


def _as_number(text):
    return int(text) if text.lstrip("+-").isdigit() else float(text)
