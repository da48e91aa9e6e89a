"""Fields of a run as NetCDF-4 after the CF conventions: xarray and its like know what they read."""

from datetime import UTC, datetime
from functools import partial

import numpy as np
import tomli_w

from mgehl.discretization import status
from mgehl.output.memory_file import netcdf_file
from mgehl.version import VERSION

CONVENTIONS = "CF-1.8"

PLANE = ("y", "x")


def write_netcdf(path, solution):
    """Write fields and coordinates, results as scalars, the configuration as an attribute."""
    with netcdf_file(path) as file:
        file.attrs.update(_global_attributes(solution))
        file.dimensions = {"y": solution.mesh.ny, "x": solution.mesh.nx}
        put = partial(_put, file)
        _put_coordinates(put, solution)
        _put_fields(put, solution)
        for name, (value, unit, meaning) in scalars(solution).items():
            put(name, (), np.float64(value), units=unit, long_name=meaning)


def scalars(solution):
    """What a run comes to, {name: (value, unit, meaning)}; a wedge has no groups and no central film."""
    contact, result = solution.contact, solution.result
    speed = {"speed": (contact.speed, "m s-1", "entrainment speed")}
    if _is_wedge(solution):
        return speed | {
            "normal_load": (result.load_N, "N", "load that the pressure carries"),
            "maximum_pressure": (1e6 * result.max_pressure_MPa, "Pa", "largest pressure"),
        }
    load_unit, groups = "N m-1" if solution.mesh.is_line else "N", contact.groups
    return speed | {
        "normal_load": (contact.load, load_unit, "normal load"),
        "central_film": (1e-9 * result.central_film_nm, "m", "film at the centre of the contact"),
        "minimum_film": (1e-9 * result.minimum_film_nm, "m", "smallest film"),
        "maximum_pressure": (1e9 * result.max_pressure_GPa, "Pa", "largest pressure"),
        "group_U": (groups.U, "1", "speed parameter U"),
        "group_W": (groups.W, "1", "load parameter W"),
        "group_G": (groups.G, "1", "material parameter G"),
        "moes_M": (groups.M, "1", "load number M of Moes"),
        "moes_L": (groups.L, "1", "material number L of Moes"),
    }


def _is_wedge(solution):
    return solution.config.contact.kind == "wedge"


def _global_attributes(solution):
    """Those that CF asks for, the verdict, and the configuration as `mgehl run` reads it."""
    kind = "wedge bearing" if _is_wedge(solution) else f"{solution.config.contact.kind} contact"
    return {
        "Conventions": CONVENTIONS,
        "title": f"Pressure and film of a lubricated {kind}",
        "source": f"mgehl {VERSION}",
        "history": f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ} mgehl export",
        "converged": "yes" if solution.result.converged else "no",
        "verdict": solution.result.reason,
        "configuration": tomli_w.dumps(solution.config.as_toml_tables()),
    }


def _put_coordinates(put, solution):
    """x and y in metres; beside them the same over their units, as auxiliary coordinates."""
    mesh, contact = solution.mesh, solution.contact
    put("x", ("x",), solution.x, units="m", long_name="distance along the motion", axis="X")
    put("y", ("y",), solution.y, units="m", long_name="distance across the motion", axis="Y")
    put("x_scaled", ("x",), mesh.X, units="1", long_name=f"x over {contact.x_scale:.9g} m")
    put("y_scaled", ("y",), mesh.Y, units="1", long_name=f"y over {contact.y_scale:.9g} m")


def _put_fields(put, solution):
    contact, fields = solution.contact, solution.fields
    put = partial(put, dimensions=PLANE, coordinates="x_scaled y_scaled")
    put("pressure", values=solution.pressure, units="Pa", long_name="fluid or contact pressure")
    put("film", values=solution.film, units="m", long_name="film thickness or gap")
    put("P", values=fields.P, units="1", long_name=f"pressure over {contact.pressure_scale:.9g} Pa")
    put("H", values=fields.H, units="1", long_name=f"film over {contact.film_scale:.9g} m")
    put(
        "status",
        values=fields.status,
        units="1",
        long_name="what the node is",
        flag_values=np.arange(len(status.NAMES), dtype=fields.status.dtype),
        flag_meanings=" ".join(status.NAMES),
    )


def _put(file, name, dimensions, values, **attributes):
    compression = {"compression": "gzip", "compression_opts": 1} if values.ndim == 2 else {}
    variable = file.create_variable(name, dimensions, values.dtype, data=values, **compression)
    variable.attrs.update(attributes)
