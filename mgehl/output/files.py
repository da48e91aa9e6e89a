"""Files of a run directory: configuration, result, history, fields."""

import csv
import json
import pickle
from dataclasses import asdict
from functools import partial
from math import isfinite
from pathlib import Path

import tomli_w

from mgehl.discretization import status
from mgehl.errors import one_line
from mgehl.grid.events import FILES, event
from mgehl.output.center_line import center_line
from mgehl.output.memory_file import netcdf_file
from mgehl.output.whole_file import whole_file, write_whole
from mgehl.version import VERSION


@event(FILES)
def on_first_rank(comm, function, *arguments):
    """As `from_first_rank`, for what reads or writes files."""
    return from_first_rank(comm, function, *arguments)


def from_first_rank(comm, function, *arguments):
    """Call on rank 0 and return there what it returned, None elsewhere.

    Every rank raises what it raised.
    """
    result = error = None
    if comm.rank == 0:
        try:
            result = function(*arguments)
        except Exception as caught:
            error = caught
    told = comm.bcast(_sendable(error))
    if told is not None:
        raise error or told  # its own has the traceback
    return result


def _sendable(error):
    """The error, or one that says the same: some cannot be sent to other ranks."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {one_line(error)}")
    return error


CONFIGURATION = "configuration.toml"
NAMES = (
    CONFIGURATION, "result.json", "history.csv", "fields.h5", "picture.png", "centerline.csv",
)  # fmt: skip
"""The files of a run directory, in the order of `RunFiles`; the last is a wedge's."""


CHECKPOINT, START = "checkpoint", "start"
"""Folder of what a run that has not finished has reached; in it that of the run it started from."""

REPORT = "report.html"
"""The page that `mgehl report` makes of a directory where no other file is named."""


class RunFiles:
    """Paths of a run directory's files."""

    def __init__(self, directory):
        self.directory = Path(directory)
        (
            self.configuration, self.result, self.history, self.fields, self.picture, self.center_line,
        ) = (self.directory / name for name in NAMES)  # fmt: skip
        self.checkpoint = self.directory / CHECKPOINT


def write_config(path, tables):
    """A resolved configuration's tables, as TOML that `mgehl run` reads."""
    write_whole(path, tomli_w.dumps(tables))


def write_result(path, result):
    """result.json; numbers that are not finite become null, which JSON can hold."""
    with whole_file(path) as part:
        part.write_text(json.dumps(finite(asdict(result)), indent=2, allow_nan=False) + "\n", "utf-8")


def finite(value):
    """A value of plain data with None for every number that is not finite, which JSON cannot hold."""
    if isinstance(value, dict):
        return {key: finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [finite(each) for each in value]
    return None if isinstance(value, float) and not isfinite(value) else value


def write_history(path, rows):
    """history.csv: a row per cycle from dictionaries of one shape."""
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]) if rows else [])
        writer.writeheader()
        writer.writerows(rows)


def write_center_line(path, mesh, fields):
    """centerline.csv of a wedge: X in mm and P  [Liu eq. 44] along Y = 0, nan in a pillar."""
    X, P = center_line(mesh, fields)
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["X_mm", "P"])
        writer.writerows(zip(X.tolist(), P.tolist(), strict=True))


def write_fields(path, solution):
    """fields.h5, netCDF-4: pressure, film and status with coordinates, SI and dimensionless."""
    mesh, contact, fields = solution.mesh, solution.contact, solution.fields
    with whole_file(path) as part, netcdf_file(part) as file:
        file.dimensions = {"y": mesh.ny, "x": mesh.nx}
        file.attrs["mgehl"] = VERSION
        file.attrs["H0"] = solution.H0
        put = partial(_put, file)
        put("x", ("x",), solution.x, "m", "distance along x")
        put("y", ("y",), solution.y, "m", "distance along y")
        put("X", ("x",), mesh.X, "1", "x over its unit: Hertz semi-axis a, or mm")
        put("Y", ("y",), mesh.Y, "1", "y over its unit: Hertz semi-axis b, or mm")
        plane = ("y", "x")
        put("pressure", plane, solution.pressure, "Pa", "fluid or contact pressure")
        put("film", plane, solution.film, "m", "film thickness or gap")
        unit = f"maximum Hertz pressure, or eta u/(m^2 mm): {contact.pressure_scale:.6g} Pa"
        put("P", plane, fields.P, "1", f"pressure over its unit, {unit}")
        put("H", plane, fields.H, "1", f"gap over its unit, a^2/R_x, or m mm: {contact.film_scale:.6g} m")
        names = ", ".join(f"{k} {name}" for k, name in enumerate(status.names(solution.is_dry)))
        put("status", plane, fields.status, "1", names)
        if fields.p is not None:
            put("p", plane, fields.p, "1", f"the fluid's own pressure over its unit, {unit}")
            put("filling", plane, fields.filling, "1", "part of the gap above the layers that holds fluid")


def _put(file, name, dimensions, values, unit, description):
    # Shuffled, a double's like bytes lie side by side: a sixth less on the disk, in half the time.
    packed = {"compression": "gzip", "compression_opts": 1, "shuffle": True} if values.ndim == 2 else {}
    variable = file.create_variable(name, dimensions, values.dtype, data=values, **packed)
    variable.attrs["units"] = unit
    variable.attrs["long_name"] = description
