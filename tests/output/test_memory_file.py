"""NetCDF files that are put together in memory."""

import h5netcdf
import numpy as np
import pytest
from full_disk import files_of_at_most
from made_solution import make_solution

from mgehl.output.files import write_fields
from mgehl.output.memory_file import netcdf_file
from mgehl.output.whole_file import whole_file


def test_it_is_written_at_the_end(tmp_path):
    path = tmp_path / "a.nc"
    with netcdf_file(path) as file:
        file.attrs["word"] = "seen"
        assert not path.exists()
    with h5netcdf.File(path) as file:
        assert file.attrs["word"] == "seen"


def test_a_full_disk_raises_an_error(tmp_path):
    """HDF5 writing to the file itself would end this process."""
    with files_of_at_most(1000), pytest.raises(OSError), netcdf_file(tmp_path / "a.nc") as file:
        file.dimensions = {"x": 1000}
        file.create_variable("x", ("x",), float, data=np.arange(1000.0))


def test_the_fields_of_a_run_do_not_crash_on_a_full_disk(tmp_path):
    with files_of_at_most(1000), pytest.raises(OSError):
        with whole_file(tmp_path / "fields.h5") as part:
            write_fields(part, make_solution("point"), {})
    assert not list(tmp_path.iterdir())
