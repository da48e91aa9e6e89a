"""A sweep as arrays: every number of `QUANTITIES` and its band, with a dimension for each key."""

from functools import partial
from math import nan

import numpy as np

from mgehl.config import KEYS
from mgehl.output.netcdf import netcdf_file, put
from mgehl.output.quantities import QUANTITIES
from mgehl.output.study_directory import RUNS
from mgehl.output.whole_file import whole_file, writing
from mgehl.studies.points import WAYS
from mgehl.version import VERSION


def write_arrays(path, axes, points, runs):
    """Write netCDF by CF of the `Told` runs of all points; nan where there is no answer."""
    both = points[-1].way == 1
    names = (["way"] if both else []) + [axis.name for axis in axes]
    with writing(path), whole_file(path) as part, netcdf_file(part) as file:
        file.attrs.update({"Conventions": "CF-1.8", "title": "sweep", "source": f"mgehl {VERSION}"})
        shape = *((2,) if both else ()), *(len(axis.values) for axis in axes)
        file.dimensions = dict(zip(names, shape, strict=True))
        _write_coordinates(partial(put, file), axes, both)
        for name, unit, meaning, values in _variables(points, runs):
            array = np.full(shape, nan)
            for point, value in zip(points, values, strict=True):
                array[(point.way, *point.place) if both else point.place] = value
            put(file, name, tuple(names), array, units=unit, long_name=meaning)


def _write_coordinates(write, axes, both):
    if both:
        write("way", ("way",), np.arange(2), units="1", flag_values=np.arange(2),
              flag_meanings=" ".join(WAYS), long_name="way along the keys")  # fmt: skip
    for axis in axes:
        text = KEYS[axis.key].metadata["help"]
        write(axis.name, (axis.name,), np.array(axis.values, float), units=axis.unit, long_name=text,
              key=axis.key)  # fmt: skip


def _variables(points, runs):
    """(Name, unit, meaning, number of each point)."""

    def numbers(path):
        return [run.number(path) if run.settled else nan for run in runs]

    for name, (path, unit, meaning, band) in QUANTITIES.items():
        yield name, unit, meaning, numbers(path)
        if band:
            yield f"{name}_band", unit, f"half-width of the band about the {meaning}", numbers(band)
    yield "converged", "1", "whether all checks hold", [float(run.converged) for run in runs]
    yield "run", "1", f"number of its directory in {RUNS}/", [float(point.number) for point in points]
