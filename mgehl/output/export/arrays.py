"""Fields of a run for programs without NetCDF: NumPy's archive and a table of text."""

import csv
import json
from io import BytesIO

import numpy as np

from mgehl.discretization import status
from mgehl.output.export.further import further_fields
from mgehl.output.files import finite, plain_result
from mgehl.output.laws import portable

COLUMNS = ("x_m", "y_m", "pressure_Pa", "film_m", "status")
FURTHER = {"fluid_pressure": "fluid_pressure_Pa", "filling": "filling", "heights": "heights_m"}
"""Columns of `further_fields`, after the others."""


def write_npz(path, solution):
    """Write x, y, pressure and film in SI, P, H, status and its names, `further_fields`, and two texts.

    The texts `result` and `configuration` are strings of JSON; nothing in the file is pickled.
    """
    fields = solution.fields
    memory = BytesIO()  # zipfile complains at length where the disk is full
    np.savez_compressed(
        memory,
        x=solution.x,
        y=solution.y,
        pressure=solution.pressure,
        film=solution.film,
        P=fields.P,
        H=fields.H,
        status=fields.status,
        **further_fields(solution),
        status_names=np.array(status.names(solution.is_dry)),
        result=json.dumps(finite(plain_result(solution.result)), allow_nan=False),
        configuration=json.dumps(portable(solution.config)),
    )
    path.write_bytes(memory.getbuffer())


def write_csv(path, solution):
    """Write a row for each node, x running fastest; numbers read back to the last bit."""
    x, y = np.meshgrid(solution.x, solution.y)
    numbers = [each.ravel().tolist() for each in (x, y, solution.pressure, solution.film)]
    known = status.names(solution.is_dry)
    names = [known[k] for k in solution.status.ravel().tolist()]
    fluid = further_fields(solution)
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow((*COLUMNS, *(FURTHER[name] for name in fluid)))
        writer.writerows(
            zip(*numbers, names, *(each.ravel().tolist() for each in fluid.values()), strict=True)
        )
