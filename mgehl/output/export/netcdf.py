"""Fields of a run as NetCDF-4 after the CF conventions, which xarray and other programs know."""

from datetime import UTC, datetime
from functools import partial

import numpy as np
import tomli_w

from mgehl.discretization import status
from mgehl.output.export.further import further_fields
from mgehl.output.laws import portable
from mgehl.output.memory_file import netcdf_file
from mgehl.version import VERSION

CONVENTIONS = "CF-1.8"

PLANE = ("y", "x")

FURTHER = {
    "fluid_pressure": {
        "units": "Pa",
        "long_name": "pressure of the fluid, under contact of that in the layers",
    },
    "filling": {"units": "1", "long_name": "part of the gap above the layers that holds fluid"},
    "shear": {"units": "Pa", "long_name": "shear stress of film and solids by sliding"},
    "flash_1": {"units": "K", "long_name": "rise of the surface of body 1 by friction"},
    "flash_2": {"units": "K", "long_name": "rise of the surface of body 2 by friction"},
    "heights": {"units": "m", "long_name": "heights of the bodies over smooth ones, a peak positive"},
}
"""What `further_fields` are called."""


def write_netcdf(path, solution):
    """Write fields and coordinates, results as scalars, the configuration as an attribute."""
    with netcdf_file(path) as file:
        file.attrs.update(_global_attributes(solution))
        file.dimensions = {"y": solution.mesh.ny, "x": solution.mesh.nx}
        put = partial(_put, file)
        _put_coordinates(put, solution)
        _put_fields(put, solution)
        for name, (value, unit, meaning) in solution.config.kind.scalars(solution).items():
            put(name, (), np.float64(value), units=unit, long_name=meaning)


def _global_attributes(solution):
    """Those that CF asks for, the verdict, and the configuration as `mgehl run` reads it."""
    return {
        "Conventions": CONVENTIONS,
        "title": f"{solution.config.kind.content} {solution.config.kind.noun}",
        "source": f"mgehl {VERSION}",
        "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} mgehl export",
        "converged": "yes" if solution.result.converged else "no",
        "verdict": solution.result.reason,
        "configuration": tomli_w.dumps(portable(solution.config)),
    }


def _put_coordinates(put, solution):
    """x and y in metres; beside them the same over their units, as auxiliary coordinates."""
    mesh, contact = solution.mesh, solution.contact
    put("x", ("x",), solution.x, units="m", long_name="distance along x", axis="X")
    put("y", ("y",), solution.y, units="m", long_name="distance along y", axis="Y")
    put("x_scaled", ("x",), mesh.X, units="1", long_name=f"x over {contact.x_scale:.9g} m")
    put("y_scaled", ("y",), mesh.Y, units="1", long_name=f"y over {contact.y_scale:.9g} m")


def _put_fields(put, solution):
    contact, fields = solution.contact, solution.fields
    put = partial(put, dimensions=PLANE, coordinates="x_scaled y_scaled")
    put("pressure", values=solution.pressure, units="Pa", long_name="fluid or contact pressure")
    put("film", values=solution.film, units="m", long_name="film thickness or gap")
    for name, values in further_fields(solution).items():
        put(name, values=values, **FURTHER[name])
    put("P", values=fields.P, units="1", long_name=f"pressure over {contact.pressure_scale:.9g} Pa")
    put("H", values=fields.H, units="1", long_name=f"film over {contact.film_scale:.9g} m")
    put(
        "status",
        values=fields.status,
        units="1",
        long_name="what the node is",
        flag_values=np.arange(len(status.NAMES), dtype=fields.status.dtype),
        flag_meanings=" ".join(status.names(solution.is_dry)),
    )


def _put(file, name, dimensions, values, **attributes):
    compression = {"compression": "gzip", "compression_opts": 1} if values.ndim == 2 else {}
    variable = file.create_variable(name, dimensions, values.dtype, data=values, **compression)
    variable.attrs.update(attributes)
