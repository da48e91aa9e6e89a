"""Fields of a run as NetCDF-4 after the CF conventions, which xarray and other programs know."""

from datetime import UTC, datetime
from functools import partial

import numpy as np
import tomli_w

from mgehl.output.files import FURTHER, further_fields
from mgehl.output.laws import portable
from mgehl.output.netcdf import PLANES, flags, netcdf_file, put


def write_netcdf(path, solution):
    """Write fields and coordinates, results as scalars, the configuration as an attribute."""
    title = f"{solution.config.kind.content} {solution.config.kind.noun}"
    with netcdf_file(path, title) as file:
        # The verdict, and the configuration as `mgehl run` reads it.
        file.attrs.update({
            "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} mgehl export",
            "converged": "yes" if solution.result.converged else "no",
            "verdict": solution.result.reason,
            "configuration": tomli_w.dumps(portable(solution.config)),
        })  # fmt: skip
        file.dimensions = {"y": solution.mesh.ny, "x": solution.mesh.nx}
        write = partial(put, file)
        _write_coordinates(write, solution)
        _write_fields(write, solution)
        for name, (value, unit, meaning) in solution.config.kind.scalars(solution).items():
            write(name, (), np.float64(value), units=unit, long_name=meaning)


def _write_coordinates(write, solution):
    """x and y in metres; beside them the same over their units, as auxiliary coordinates."""
    for axis in "xy":
        scaled = getattr(solution.mesh, axis.upper())
        name, scale = f"{axis} over", getattr(solution.contact, f"{axis}_scale")
        along = {"units": "m", "long_name": f"distance along {axis}", "axis": axis.upper()}
        write(axis, (axis,), getattr(solution, axis), **along)
        write(f"{axis}_scaled", (axis,), scaled, units="1", long_name=f"{name} {scale:.9g} m")


def _write_fields(write, solution):
    contact, fields = solution.contact, solution.fields
    planes = {
        "pressure": (solution.pressure, *PLANES["pressure"]),
        "film": (solution.film, *PLANES["film"]),
        **{name: (values, *FURTHER[name]) for name, values in further_fields(solution).items()},
        "P": (fields.P, "1", f"pressure over {contact.pressure_scale:.9g} Pa"),
        "H": (fields.H, "1", f"film over {contact.film_scale:.9g} m"),
        "status": (fields.status, *PLANES["status"]),
    }
    for name, (values, unit, meaning) in planes.items():
        told = {"coordinates": "x_scaled y_scaled", "units": unit, "long_name": meaning}
        told |= flags(solution.is_dry) if name == "status" else {}
        write(name, ("y", "x"), values, {"compression": "gzip", "compression_opts": 1}, **told)
