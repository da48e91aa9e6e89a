import numpy as np
import pytest
from told import refusal

from mgehl.model.surface.files import read_map

Z = np.random.default_rng(5).integers(-100, 100, (4, 6)).astype(float)
HEADER = """aISO-1.0
ManufacID = T*ST
ModDate =
NumPoints = 6
NumProfiles = 4
Xscale = 5.0E-6
Yscale = 6.0E-6
Zscale = 2.0E-9
DataType = 5
CheckType = 0
*
"""


@pytest.mark.parametrize("separator", [" ", "\n"])
def test_its_header_tells_size_and_units(tmp_path, separator):
    """It was read as a bare matrix, whose unit of heights the user was asked for."""
    rows = "\n".join(separator.join(f"{z:g}" for z in row) for row in Z)
    (tmp_path / "z.sdf").write_text(f"{HEADER}{rows}\n*\nchecksum\n")
    found = read_map(tmp_path / "z.sdf")
    np.testing.assert_array_equal(found.heights, Z)
    assert (found.dx, found.dy, found.height_unit, found.position_unit) == (5e-6, 6e-6, 2e-9, 1.0)


def test_a_bad_point_is_a_hole(tmp_path):
    (tmp_path / "z.sdf").write_text(HEADER + "BAD " + "1 " * 23 + "\n*\n")
    assert np.isnan(read_map(tmp_path / "z.sdf").heights[0, 0])


@pytest.mark.parametrize(
    "content, said",
    [
        (HEADER + "1 2 3\n*\n", "has 3 heights; its header tells 6 x 4 of them"),
        (HEADER.replace("Zscale", "Scale") + "1 " * 24, "its header does not tell zscale"),
        (HEADER + "x " * 24, "is no ASCII SDF"),
        (HEADER.replace("= 6\n", "= -6\n") + "1 " * 24, "its header tells -6 x 4"),
    ],
)
def test_what_is_wrong_is_said(tmp_path, content, said):
    (tmp_path / "z.sdf").write_text(content)
    assert said in refusal(read_map, tmp_path / "z.sdf")


def test_one_row_is_a_profile(tmp_path):
    (tmp_path / "z.sdf").write_text(
        HEADER.replace("NumProfiles = 4", "NumProfiles = 1") + "1 2 3 4 5 6\n*\n"
    )
    found = read_map(tmp_path / "z.sdf")
    assert found.is_profile and found.heights[0].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
