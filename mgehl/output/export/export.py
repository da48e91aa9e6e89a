"""A run's fields in the formats of other programs, each file whole or not there at all."""

import csv
import json
from io import BytesIO
from pathlib import Path

import numpy as np

from mgehl.discretization import status
from mgehl.errors import OutputError, UserError
from mgehl.output.export.netcdf import write_netcdf
from mgehl.output.export.paraview import write_pvd, write_vts
from mgehl.output.files import FURTHER, finite, further_fields, plain_result
from mgehl.output.laws import portable
from mgehl.output.whole_file import whole_file, writing


def write_npz(path, solution):
    """Write x, y, pressure and film in SI, P, H, status and its names, `further_fields`, and two texts. The
    texts `result` and `configuration` are strings of JSON; nothing in the file is pickled."""
    memory = BytesIO()  # zipfile complains at length where the disk is full
    np.savez_compressed(
        memory,
        **{name: getattr(solution, name) for name in ("x", "y", "pressure", "film", "status")},
        P=solution.fields.P,
        H=solution.fields.H,
        **further_fields(solution),
        status_names=np.array(status.names(solution.is_dry)),
        result=json.dumps(finite(plain_result(solution.result)), allow_nan=False),
        configuration=json.dumps(portable(solution.config)),
    )
    path.write_bytes(memory.getbuffer())


def write_csv(path, solution):
    """Write a row for each node, x running fastest; numbers read back to the last bit."""
    x, y = np.meshgrid(solution.x, solution.y)
    names = np.array(status.names(solution.is_dry))[solution.status]
    columns = {
        "x_m": x,
        "y_m": y,
        "pressure_Pa": solution.pressure,
        "film_m": solution.film,
        "status": names,
    }
    columns |= {_with_unit(name): values for name, values in further_fields(solution).items()}
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(each.ravel().tolist() for each in columns.values()), strict=True))


def _with_unit(name):
    unit, _ = FURTHER[name]
    return name if unit == "1" else f"{name}_{unit}"


WRITERS = {"vts": write_vts, "nc": write_netcdf, "npz": write_npz, "csv": write_csv}
"""Format, which is also the file's ending: a function of path and `Solution`."""

OF_FRAMES = {"pvd": write_pvd}
"""The same of all instants of a run in time: a function of the file's own path."""

DEFAULT_NAME = "fields"


def targets(formats, directory, out=None):
    """{format: path}: `out`, to which a format adds its ending, or `fields` in the run's directory.

    A directory as `out` gets `fields`, too. Raises UserError where `out` has the ending of another
    format than the one that is written.
    """
    base = Path(out or directory)
    if not out or base.is_dir():
        base = base / DEFAULT_NAME
    ending = base.suffix.removeprefix(".")
    if ending not in WRITERS | OF_FRAMES:
        return {each: base.with_name(f"{base.name}.{each}") for each in formats}
    if formats != [ending]:
        raise UserError(f"--out {out}: its ending does not go with --to {','.join(formats)}; leave it out")
    return {ending: base}


def export(solution, paths, force=False):
    """Write `solution` to `paths`, {format: path}, over files that exist only with `force`. Raises
    OutputError where a file exists or cannot be written."""
    for path in paths.values():
        if path.exists() and not force:
            raise OutputError(f"{path} exists: add --force to replace it, or choose another with --out")
    for each, path in paths.items():
        with writing(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            if each in OF_FRAMES:
                OF_FRAMES[each](path, solution)
            else:
                with whole_file(path) as part:
                    WRITERS[each](part, solution)
