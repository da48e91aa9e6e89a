"""NetCDF files that are put together in memory."""

import h5netcdf
import pytest

from mgehl.output.memory_file import netcdf_file


def test_it_is_written_at_the_end(tmp_path):
    path = tmp_path / "a.nc"
    with netcdf_file(path) as file:
        file.attrs["word"] = "seen"
        assert not path.exists()
    with h5netcdf.File(path) as file:
        assert file.attrs["word"] == "seen"


def test_a_failure_leaves_the_file_before_it(tmp_path):
    path = tmp_path / "a.nc"
    path.write_text("mine")
    with pytest.raises(ZeroDivisionError), netcdf_file(path):
        raise ZeroDivisionError
    assert path.read_text() == "mine"
