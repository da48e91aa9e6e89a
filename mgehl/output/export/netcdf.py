"""Fields of a run as NetCDF-4 after the CF conventions, which xarray and other programs know."""

from datetime import UTC, datetime
from functools import partial
from math import isnan

import numpy as np
import tomli_w

from mgehl.output.files import FURTHER, further_fields, plain_result
from mgehl.output.laws import portable
from mgehl.output.netcdf import PLANES, flags, netcdf_file, put
from mgehl.output.quantities import Told, numbers_and_bands

GROUPS = {
    "group_U": "speed parameter U",
    "group_W": "load parameter W",
    "group_G": "material parameter G",
    "moes_M": "load number M of Moes",
    "moes_L": "material number L of Moes",
}
"""Those of a lubricated contact that moves."""


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
        for name, value, unit, meaning in _scalars(solution):
            if not isnan(value):
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


def _scalars(solution):
    """(Name, value, unit, meaning) of what drives the contact, in time at its end, and of its numbers."""
    yield from _driving(solution.at_the_end, solution)
    told = Told(solution.config.as_toml_tables(), plain_result(solution.result))
    of_the_end = " at the end" if solution.config.is_in_time else ""
    for name, unit, meaning, path in numbers_and_bands():
        yield name, told.number(path), unit, meaning + of_the_end


def _driving(contact, solution):
    """The same of load, speed, direction and groups; `contact` is that of the end."""
    last = solution.last
    speed = 1e-3 * last["speed_mm_s"] if last else contact.speed
    if not contact.is_loaded:
        yield "speed", speed, "m s-1", "speed of the plate"
        return
    yield "normal_load", contact.load, solution.config.kind.load_unit.replace("/m", " m-1"), "normal load"
    if solution.result.groups:  # neither of dry bodies nor of those that stand still
        groups = contact.unheated.at_speed(abs(speed) or contact.speed).groups
        yield from ((name, getattr(groups, name[-1]), "1", meaning) for name, meaning in GROUPS.items())
    if not solution.is_dry:
        yield "speed", speed, "m s-1", "entrainment speed, negative where it has turned"
        yield "angle", contact.angle, "degree", "direction of the motion, from +x towards +y"
