"""A run read back from its directory, for pictures, reports, exports and new starts."""

import csv
import json
from math import nan

import dacite
import h5netcdf
import numpy as np

from mgehl.config import load_config
from mgehl.config_value import AUTO
from mgehl.discretization.status import NAMES
from mgehl.errors import ConfigError, OutputError, one_line
from mgehl.kinds import contact_from, mesh_from
from mgehl.model.own_function import without_running
from mgehl.output.directory import check_result
from mgehl.output.dry_result import DryResult
from mgehl.output.files import RunFiles
from mgehl.output.result import Result
from mgehl.output.solution import Fields, Solution
from mgehl.output.wedge_result import WedgeResult

OPTIONAL = "p", "filling"
"""Fields that older results are without."""


def _real(value):
    """A number of JSON: null stands for one that is not finite. Raises ValueError for a word."""
    if value is not None and (isinstance(value, bool) or not isinstance(value, int | float)):
        raise ValueError(f"{value!r} is no number")
    return nan if value is None else float(value)


def _yes_or_no(value):
    """True or false, and nothing that Python would take for it."""
    if not isinstance(value, bool):
        raise ValueError(f"{value!r} is neither true nor false")
    return value


def _whole(value):
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"{value!r} is no whole number")
    return value


def _word(value):
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no text")
    return value


AS_JSON = dacite.Config(
    check_types=False,
    cast=[tuple],
    type_hooks={float: _real, bool: _yes_or_no, int: _whole, str: _word},
)
"""JSON knows neither tuples nor numbers that are not finite (they are null)."""


def read_run(directory) -> Solution:
    """The `Solution` that a finished run left in its directory, fields and all, on this rank.

    Its own laws are not run: the directory may be anybody's. Raises OutputError where a file is missing, is
    not as the run wrote it, or not a run's.
    """
    check_result(directory)
    files = RunFiles(directory)
    config = read_config(files)
    contact = without_running(contact_from(config))
    mesh = mesh_from(config, contact)
    fields, H0 = read_fields(files.fields, mesh)
    rows, result = _read_history(files.history), read_result(files, config)
    return Solution(config, contact, mesh, fields, rows, result, H0, local=fields)


def read_config(files):
    """The `Config` of a finished run. Raises OutputError where it is none, or leaves a domain open."""
    try:
        config = load_config(files.configuration)
    except ConfigError as error:
        raise OutputError(f"{files.directory}: {error}") from None
    named = config.as_toml_tables()["grid"]
    if config.kind.is_loaded and AUTO in (named.get("x"), named.get("y")):
        raise OutputError(f"{files.configuration}: has no domain in numbers, as that of a finished run has")
    return config


def read_fields(path, mesh):
    """`Fields` of the whole grid and H0 from a fields.h5 of this mesh."""
    try:
        with h5netcdf.File(path, "r") as file:
            names = [
                name for name in ("P", "H", "status", *OPTIONAL) if name not in OPTIONAL or name in file
            ]
            fields = Fields(**{name: np.asarray(file[name]) for name in names})
            H0 = float(file.attrs["H0"])
    except FileNotFoundError:
        raise OutputError(f"{path}: is not there: the run has not finished") from None
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise OutputError(f"{path}: is damaged, or no fields of mgehl: {one_line(error)}") from None
    shape = (mesh.ny, mesh.nx)
    if any(array.shape != shape for array in fields.arrays):
        raise OutputError(f"{path}: its fields are not of {mesh.nx} x {mesh.ny} nodes")
    if not all(np.isfinite(each).all() for each in (*fields.arrays, H0)):
        raise OutputError(f"{path}: its fields are not finite everywhere")
    if not np.isin(fields.status, range(len(NAMES))).all():
        raise OutputError(f"{path}: has nodes of a status that there is not")
    return fields, H0


def _read_history(path):
    """Rows of history.csv, numbers as numbers."""
    try:
        text = path.read_text(encoding="utf-8")
        lines = csv.reader(text.splitlines())
        names = next(lines, [])
        rows = [dict(zip(names, map(_number, line), strict=True)) for line in lines]
        if not rows or "residual" not in names:
            raise ValueError("it is no history of a run")
        if not text.endswith("\n"):
            # A last number that is cut short is a number, too.
            raise ValueError("its last line is cut off")
        return rows
    except (OSError, ValueError, csv.Error) as error:
        raise OutputError(f"{path}: cannot be read: {one_line(error)}") from None


def read_result(files, config):
    """The `Result`, `WedgeResult` or `DryResult` of result.json; its numbers that are null are nan.

    Raises OutputError where it is missing, or cut off.
    """
    path = files.result
    try:
        return result_from(json.loads(path.read_text(encoding="utf-8")), config)
    except (OSError, ValueError, TypeError, AttributeError, dacite.DaciteError) as error:
        raise OutputError(f"{path}: cannot be read: {one_line(error)}") from None


def result_from(plain, config):
    """The `Result`, `DryResult` or `WedgeResult` that nested plain values stand for.

    Raises ValueError, TypeError or DaciteError where they stand for none.
    """
    kind = Result if config.kind.is_loaded else WedgeResult
    return dacite.from_dict(DryResult if config.is_dry else kind, plain, AS_JSON)


def _number(text):
    return int(text) if text.lstrip("+-").isdigit() else float(text)
