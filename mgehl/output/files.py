"""Files of a run directory: configuration, result, history, fields."""

import csv
import json
import pickle
from dataclasses import asdict
from io import StringIO
from math import isfinite

import numpy as np
import tomli_w

from mgehl.discretization import status
from mgehl.errors import one_line
from mgehl.grid.events import FILES, event
from mgehl.kinds.time import ONLY_IN_TIME, own_courses
from mgehl.output.centre_line import centre_pressure
from mgehl.output.laws import portable
from mgehl.output.netcdf import PLANES, netcdf_file, put
from mgehl.version import VERSION

NAMES = CONFIGURATION, RESULT, HISTORY, FIELDS, PICTURE, CENTER_LINE, SERIES, FRAMES = (
    "configuration.toml", "result.json", "history.csv", "fields.h5", "picture.png", "centerline.csv",
    "series.nc", "frames.nc",
)  # fmt: skip
"""The files of a run directory; a centre line is a wedge's, series and frames are of a run in time."""

CHECKPOINT = "checkpoint"
"""Folder of what a run that has not finished has reached."""

STUDY = "study.json"
"""What a study or a sweep was asked for."""

REPORT = "report.html"
"""The page that `mgehl report` makes of a directory where no other file is named."""

PLOTS = "plots"
"""Folder of pictures that `mgehl plot` draws of a run where no other place is named."""

INPUTS = "inputs"
"""In result.json {"section.key": number in SI units} of what was given, or follows from it."""

WHOLE = "run/texts"
"""Data set of fields.h5: its run's texts by their names, as JSON in bytes."""

COURSES = "courses"
"""Group of fields.h5: what functions of the user's own gave for speed and load, which are not run again."""


@event(FILES)
def on_first_rank(comm, function, *arguments):
    """As `from_first_rank`, for what reads or writes files."""
    return from_first_rank(comm, function, *arguments)


def from_first_rank(comm, function, *arguments):
    """Call on rank 0 and return there what it returned, None elsewhere. Every rank raises what it
    raised."""
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


def texts_of(solution):
    """{name: text} of the files of a run that are text: configuration, result, history, a centre line."""
    told = plain_result(solution.result) | {INPUTS: solution.config.inputs}
    texts = {
        CONFIGURATION: tomli_w.dumps(portable(solution.config)),
        RESULT: json.dumps(finite(told), indent=2, allow_nan=False) + "\n",
        HISTORY: csv_text(solution.rows),
    }
    if not solution.contact.is_loaded:
        X, P = centre_pressure(solution.mesh, solution.fields)  # [Liu eq. 44] along Y = 0, nan in a pillar
        points = zip(X.tolist(), P.tolist(), strict=True)
        texts[CENTER_LINE] = csv_text([{"X_mm": x, "P": p} for x, p in points])
    return texts


def csv_text(rows):
    """Rows, dictionaries of the same columns, as CSV; of none an empty line."""
    text = StringIO(newline="")
    csv.writer(text).writerows([rows[0] if rows else [], *map(dict.values, rows)])
    return text.getvalue()


def plain_result(result):
    """A result as plain data. What this kind of contact has not is left out."""
    return {name: each for name, each in asdict(result).items() if each is not None or name == "mixed"}


def finite(value):
    """A value of plain data with None for every number that is not finite, which JSON cannot hold."""
    if isinstance(value, dict):
        return {key: finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [finite(each) for each in value]
    return None if isinstance(value, float) and not isfinite(value) else value


FURTHER = {
    "fluid_pressure": ("Pa", "pressure of the fluid, under contact of that in the layers"),
    "filling": ("1", "part of the gap above the layers that holds fluid"),
    "heights": ("m", "heights of the bodies over smooth ones, a peak positive"),
    "shear": ("Pa", "shear stress of film and solids by sliding"),
    "flash_1": ("K", "rise of the surface of body 1 by friction"),
    "flash_2": ("K", "rise of the surface of body 2 by friction"),
}
"""Unit and meaning of fields that smooth bodies or older results are without."""

OF_FLUIDS = "fluid_pressure", "filling"
"""Those of them that dry contacts are without."""

PACKED = {"compression": "gzip", "compression_opts": 1, "shuffle": True, "fletcher32": True}
"""How arrays are written. Shuffled, a double's like bytes lie side by side: a sixth less on the disk, in
half the time."""


def further_fields(solution):
    """What there is of `FURTHER`, by name; the filling is below 1 in cavities alone."""
    fields = solution.fields.named
    if "p" in fields:
        fields["fluid_pressure"] = fields["p"] * solution.contact.pressure_scale
    nothing = OF_FLUIDS if solution.is_dry else ()
    return {name: fields[name] for name in FURTHER if name in fields and name not in nothing}


def write_fields(path, solution, texts):
    """fields.h5, netCDF-4: pressure, film and status with coordinates, SI and dimensionless; all `texts`.
    Each part of it has a checksum, the data Fletcher's and HDF5's own lists those of its version 1.10."""
    mesh, contact = solution.mesh, solution.contact
    unit = f"maximum Hertz pressure, or eta u/(m^2 mm): {contact.pressure_scale:.6g} Pa"
    names = ", ".join(f"{k} {name}" for k, name in enumerate(status.names(solution.is_dry)))
    meanings = {
        **PLANES,
        **FURTHER,
        "P": ("1", f"pressure over its unit, {unit}"),
        "H": ("1", f"gap over its unit, a^2/R_x, or m mm: {contact.film_scale:.6g} m"),
        "status": ("1", names),
        "p": ("1", f"the fluid's own pressure over its unit, {unit}"),
    }
    planes = {"pressure": solution.pressure, "film": solution.film} | solution.fields.named
    with netcdf_file(path, libver=("v110", "v110")) as file:

        def write(name, dimensions, values, unit, meaning):
            put(file, name, dimensions, values, PACKED, units=unit, long_name=meaning)

        file.dimensions = {"y": mesh.ny, "x": mesh.nx}
        file.attrs.update({"mgehl": VERSION, "H0": solution.H0})
        for axis in "xy":
            write(axis, (axis,), getattr(solution, axis), "m", f"distance along {axis}")
            meaning = f"{axis} over its unit: Hertz semi-axis {'a' if axis == 'x' else 'b'}, or mm"
            write(axis.upper(), (axis,), getattr(mesh, axis.upper()), "1", meaning)
        for name, values in planes.items():
            write(name, ("y", "x"), values, *meanings[name])
        _write_courses(file, own_courses(solution.config))
        _write_texts(file, texts)


def _write_courses(file, courses):
    """Values of a user's own functions of time, {key: values}, in a group of a netCDF file."""
    if not courses:
        return
    group = file.create_group(COURSES)
    group.dimensions = {"instants": len(next(iter(courses.values())))}
    for key, values in courses.items():
        meaning = f"{key} at even times until time.end"
        put(group, key, ("instants",), values, PACKED, units=ONLY_IN_TIME[key], long_name=meaning)


def _write_texts(file, texts):
    """Texts by their names, in a group of a netCDF file."""
    group, name = WHOLE.split("/")
    group, content = file.create_group(group), np.frombuffer(json.dumps(texts).encode(), np.uint8)
    group.dimensions = {"bytes": content.size}
    meaning = "the run's texts by their names, as JSON"
    put(group, name, ("bytes",), content, PACKED, units="1", long_name=meaning)
