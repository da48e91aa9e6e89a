"""A run in time: what is kept of each step, and the fields of some instants.

series.nc    a number of each step over time, CF; written anew with every checkpoint and at the end
frames.nc    pressure, film and status of some instants, CF
"""

from copy import copy
from dataclasses import dataclass, replace
from functools import partial

import h5netcdf
import numpy as np

from mgehl.discretization.status import CONTACT, names
from mgehl.output.memory_file import netcdf_file
from mgehl.output.whole_file import whole_file
from mgehl.solver.shear import shear_of
from mgehl.version import VERSION

COLUMNS = {
    "step": ("1", "number of the step"),
    "step_s": ("s", "length of the step"),
    "speed_mm_s": ("mm s-1", "entrainment speed"),
    "load_share": ("1", "load over that at the beginning"),
    "path_um": ("um", "way that the mean surface has gone"),
    "central_film_nm": ("nm", "film at the centre of the contact"),
    "minimum_film_nm": ("nm", "smallest film"),
    "mean_gap_nm": ("nm", "mean gap within the Hertz ellipse"),
    "max_pressure_GPa": ("GPa", "largest pressure"),
    "load_on_contact": ("1", "part of the load on contact nodes"),
    "load_on_solids": ("1", "part of the load that solids carry"),
    "friction": ("1", "shear of film and solids over the load"),
    "rolling": ("1", "what drags each body against the motion, over the load"),
    "contact_nodes": ("1", "nodes in contact"),
    "cavitated_nodes": ("1", "nodes of cavities"),
    "residual": ("1", "residual that the step leaves"),
    "load_error": ("1", "error of the load"),
    "stored_oil": ("1", "oil in the domain, in units of H, X and Y"),
    "closure": ("1", "what the account of the oil is off in the step, over what is stored"),
    "newton_steps": ("1", "Newton steps of the step"),
    "halvings": ("1", "times that the step was halved"),
    "convolutions": ("1", "fine-grid convolutions until then"),
    "seconds": ("s", "seconds of work until then"),
}
"""What history.csv and series.nc have of each step beside time_s: unit and meaning."""


def row_of(instant, standing, problem, convolutions, seconds):
    """What is kept of an `Instant` after which the run stands there (collective)."""
    state, contact, grid = standing.state, problem.contact, problem.grid
    nm, last = 1e9 * contact.film_scale, instant.newton.cycles[-1]
    touching = state.status == CONTACT
    carried = contact.load_integral * instant.load
    inside = np.broadcast_to(grid.X**2 + (0.0 if grid.mesh.is_line else grid.Y**2) <= 1.0, grid.shape)
    return {
        "time_s": instant.t,
        "step": instant.number,
        "step_s": instant.step,
        "grid": grid.mesh.nx,
        "speed_mm_s": 1e3 * instant.speed,
        "load_share": instant.load,
        "path_um": 1e6 * standing.path,
        "central_film_nm": last.central * nm,
        "minimum_film_nm": last.minimum * nm,
        "mean_gap_nm": problem.mean(state.H, inside) * nm,
        "max_pressure_GPa": 1e-9 * contact.pressure_scale * grid.max(state.P),
        "load_on_contact": problem.load(np.where(touching, state.P, 0.0)) / carried,
        "load_on_solids": problem.load(np.where(touching, state.P - state.p, 0.0)) / carried,
        **_resistance(instant, state, problem),
        "contact_nodes": last.contact_nodes,
        "cavitated_nodes": last.cavitated_nodes,
        "residual": last.residual,
        "load_error": last.load_error,
        "stored_oil": instant.stored,
        "closure": instant.closure,
        "newton_steps": len(instant.newton.cycles) - 1,
        "halvings": instant.halvings,
        "convolutions": convolutions,
        "seconds": seconds,
    }


def _resistance(instant, state, problem):
    """What resists the motion at an instant, over its load (collective)."""
    contact, there = problem.contact, copy(problem)
    there.contact = replace(contact, speed=abs(instant.speed))
    shear, load = shear_of(there, state), instant.load * contact.load
    sliding = shear.film_force + shear.solid_force
    return {"friction": sliding / load, "rolling": shear.rolling_force / load}


def write_series(path, rows, title):
    """series.nc of the rows of a history. Raises OSError."""
    with whole_file(path) as part, netcdf_file(part) as file:
        file.attrs.update({"Conventions": "CF-1.8", "title": title, "source": f"mgehl {VERSION}"})
        file.dimensions = {"time": len(rows)}
        write = partial(put, file)
        write("time", ("time",), _column(rows, "time_s"), units="s", long_name="time", axis="T")
        for name, (unit, meaning) in COLUMNS.items():
            write(name, ("time",), _column(rows, name), units=unit, long_name=meaning)


def _column(rows, name):
    return np.array([row[name] for row in rows], dtype=float)


def put(file, name, dimensions, values, **attributes):
    """Write a variable with its attributes to an `h5netcdf.File`."""
    variable = file.create_variable(name, dimensions, values.dtype, data=values)
    variable.attrs.update(attributes)


@dataclass
class Frames:
    """Fields of some instants, on rank 0: kept in a folder until the end, or in memory without one."""

    every: float
    """Seconds from one to the next."""
    folder: object = None

    def __post_init__(self):
        self._kept = {}

    def take(self, t, step, fields):
        """Keep `fields`, {name: a function that gathers (ny, nx)}, where it is time for it (collective)."""
        number = int(t / self.every * (1.0 + 1e-9))
        if number == int(max(t - step, 0.0) / self.every * (1.0 + 1e-9)) and t > step:
            return
        found = {name: gathered() for name, gathered in fields.items()}
        if found["film"] is None:
            return
        if self.folder is None:
            self._kept[number] = (t, found)
            return
        with whole_file(self.folder / f"frame-{number:06d}.npz") as part:
            np.savez(part, t=t, **found)

    def all(self):
        """(Time, {name: array}) of the instants, in order."""
        if self.folder is None:
            yield from (self._kept[number] for number in sorted(self._kept))
            return
        for path in sorted(self.folder.glob("frame-*.npz")):
            with np.load(path) as file:
                yield float(file["t"]), {name: file[name] for name in file.files if name != "t"}


class StoredFrames:
    """The frames of a finished run, in its frames.nc."""

    def __init__(self, path):
        self._path = path

    def all(self):
        """(Time, {name: array}) of the instants, in order."""
        with h5netcdf.File(self._path, "r") as file:
            for number, t in enumerate(file["time"][:]):
                yield float(t), {name: file[name][number] for name in FIELDS}


FIELDS = {
    "pressure": ("Pa", "fluid or contact pressure"),
    "film": ("m", "film thickness or gap"),
    "status": ("1", ", ".join(f"{k} {name}" for k, name in enumerate(names(False)))),
}


def write_frames(path, frames, x, y, title):
    """frames.nc of (time, {name: (ny, nx)}) in order, with x and y in m. Raises OSError."""
    frames = list(frames)
    with whole_file(path) as part, netcdf_file(part) as file:
        file.attrs.update({"Conventions": "CF-1.8", "title": title, "source": f"mgehl {VERSION}"})
        file.dimensions = {"time": len(frames), "y": len(y), "x": len(x)}
        write = partial(put, file)
        write("time", ("time",), np.array([t for t, _ in frames]), units="s", long_name="time", axis="T")
        write("x", ("x",), x, units="m", long_name="distance along x", axis="X")
        write("y", ("y",), y, units="m", long_name="distance along y", axis="Y")
        for name, (unit, meaning) in FIELDS.items():
            values = np.stack([fields[name] for _, fields in frames])
            how = {"chunks": (1, len(y), len(x)), "compression": "gzip", "compression_opts": 1}
            variable = file.create_variable(name, ("time", "y", "x"), values.dtype, data=values, **how)
            variable.attrs.update({"units": unit, "long_name": meaning})
