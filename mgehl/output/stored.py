"""A run read back from its directory, for pictures, reports, exports and new starts."""

import csv
import json
from math import nan
from pathlib import Path

import dacite
import h5netcdf
import numpy as np

from mgehl.config import load_config
from mgehl.discretization.status import NAMES
from mgehl.errors import ConfigError, OutputError, one_line
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.dry_result import DryResult
from mgehl.output.files import RunFiles
from mgehl.output.result import Result
from mgehl.output.solution import Fields, Solution
from mgehl.output.wedge_result import WedgeResult

LENIENT = dacite.Config(
    check_types=False,
    cast=[tuple],
    type_hooks={float: lambda value: nan if value is None else float(value)},
)
"""JSON knows neither tuples nor numbers that are not finite (they are null)."""


def read_run(directory) -> Solution:
    """The `Solution` that a finished run left in its directory, fields and all, on this rank.

    Raises OutputError where a file is missing, cut off or not a run's.
    """
    files = RunFiles(directory)
    if not Path(directory).is_dir():
        raise OutputError(f"{directory}: is no run directory")
    try:
        config = load_config(files.configuration)
    except ConfigError as error:
        raise OutputError(f"{directory}: {error}") from None
    contact = contact_from(config)
    mesh = mesh_from(config, contact)
    fields, H0 = read_fields(files.fields, mesh)
    rows, result = _read_history(files.history), read_result(files, config)
    return Solution(config, contact, mesh, fields, rows, result, H0, local=fields)


def read_fields(path, mesh):
    """`Fields` of the whole grid and the approach H0 from a fields.h5 of this mesh."""
    try:
        with h5netcdf.File(path, "r") as file:
            fields = Fields(*(np.asarray(file[name]) for name in ("P", "H", "status")))
            H0 = float(file.attrs["H0"])
    except FileNotFoundError:
        raise OutputError(f"{path}: is not there: the run has not finished") from None
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise OutputError(f"{path}: is damaged, or no fields of mgehl: {one_line(error)}") from None
    shape = (mesh.ny, mesh.nx)
    if any(array.shape != shape for array in (fields.P, fields.H, fields.status)):
        raise OutputError(f"{path}: its fields are not of {mesh.nx} x {mesh.ny} nodes")
    if not all(np.isfinite(each).all() for each in (fields.P, fields.H, H0)):
        raise OutputError(f"{path}: its fields are not finite everywhere")
    if not np.isin(fields.status, range(len(NAMES))).all():
        raise OutputError(f"{path}: has nodes of a status that there is not")
    return fields, H0


def _read_history(path):
    """Rows of history.csv, numbers as numbers."""
    try:
        text = path.read_text()
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
    path, kind = files.result, Result if config.kind.is_loaded else WedgeResult
    if config.is_dry:
        kind = DryResult
    try:
        return dacite.from_dict(kind, json.loads(path.read_text()), LENIENT)
    except (OSError, ValueError, TypeError, AttributeError, dacite.DaciteError) as error:
        raise OutputError(f"{path}: cannot be read: {one_line(error)}") from None


def _number(text):
    return int(text) if text.lstrip("+-").isdigit() else float(text)
