"""NetCDF-4 files that are put together in memory: HDF5 crashes where the disk is full."""

from contextlib import contextmanager
from io import BytesIO

import h5netcdf
import numpy as np

from mgehl.discretization import status
from mgehl.version import VERSION

PLANES = {
    "pressure": ("Pa", "fluid or contact pressure"),
    "film": ("m", "film thickness or gap"),
    "status": ("1", "what the node is"),
}
"""Unit and meaning of the fields that every run has."""


def flags(is_dry):
    """Attributes that say, after CF, what the numbers of a status mean."""
    values = np.arange(len(status.NAMES), dtype=np.int8)
    return {"flag_values": values, "flag_meanings": " ".join(status.names(is_dry))}


@contextmanager
def netcdf_file(path, title=None, **options):
    """An `h5netcdf.File` to write to, whose bytes go to `path` at the end, if nothing failed; one with a
    `title` has the attributes of CF. Where HDF5 itself cannot write, the process ends with a segmentation
    fault; a write of plain bytes raises OSError."""
    memory = BytesIO()
    with h5netcdf.File(memory, "w", **options) as file:
        if title:
            file.attrs.update({"Conventions": "CF-1.8", "title": title, "source": f"mgehl {VERSION}"})
        yield file
    path.write_bytes(memory.getbuffer())


def put(file, name, dimensions, values, packed=None, **attributes):
    """Write a variable with its attributes to an `h5netcdf.File`; `packed` is how HDF5 stores it."""
    variable = file.create_variable(name, dimensions, values.dtype, data=values, **(packed or {}))
    variable.attrs.update(attributes)
