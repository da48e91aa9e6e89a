import zipfile

import numpy as np
import pytest

from mgehl.model.surface import Measured, Preparation
from mgehl.model.surface.doubts import MOST_HOLES, harmonic, jumped, outstanding, repeated
from mgehl.model.surface.files import read_map
from mgehl.model.surface.map import SurfaceFileError

X, Y = np.meshgrid(np.arange(40.0), np.arange(30.0))
NOISE = np.random.default_rng(7).normal(0.0, 1e-7, X.shape)
STEP = 2e-6


def test_holes_of_a_plane_are_filled_to_the_plane():
    """A plane is harmonic on any grid, and x^2 - y^2 exactly by five points."""
    dx, dy = 2.0, 3.0
    for known in (3.0 + X - 2.0 * Y, (dx * X) ** 2 - (dy * Y) ** 2):
        z = known.copy()
        z[5:12, 7:19] = z[20, 3] = z[25, 30:33] = np.nan
        np.testing.assert_allclose(harmonic(z, dx, dy), known, rtol=0, atol=1e-9)


@pytest.mark.parametrize("bent", [0.0, 0.1])
def test_a_file_s_holes_are_filled_to_its_form_where_that_is_asked(tmp_path, bent):
    """One within, one at the edge, of a plane and of a ball's cap; without its form it is flat."""
    whole = 3.0 + X - 2.0 * Y + bent * (X**2 + Y**2)
    z = whole.copy()
    z[5:8, 5:8] = z[20:24, :3] = np.nan
    np.save(tmp_path / "z.npy", z)
    told = {"height_unit": 1e-9, "dx": STEP}
    found = Measured(str(tmp_path / "z.npy"), Preparation(**told, holes="interpolate")).heights
    np.testing.assert_allclose(found.values, 1e-9 * whole, rtol=0, atol=1e-19)
    assert found.filled == 21
    remove = "curvature" if bent else "tilt"
    flat = Measured(
        str(tmp_path / "z.npy"), Preparation(**told, holes="interpolate", remove=remove)
    ).heights
    np.testing.assert_allclose(flat.values, 0.0, rtol=0, atol=1e-19)
    with pytest.raises(SurfaceFileError, match='21 of 1200 points are .*; holes = "interpolate" fills'):
        _ = Measured(str(tmp_path / "z.npy"), Preparation(**told)).heights


def test_too_many_holes_are_not_filled(tmp_path):
    z = np.ones(X.shape)
    z.ravel()[: round(MOST_HOLES * z.size) + 1] = np.nan
    np.save(tmp_path / "z.npy", z)
    told = Preparation(height_unit=1e-9, dx=STEP, holes="interpolate")
    with pytest.raises(SurfaceFileError, match="301 of 1200 points are holes; at most 25 % of all points"):
        _ = Measured(str(tmp_path / "z.npy"), told).heights


FORMS = {
    "noise": NOISE,
    "a ball's cap with noise": 50.0 * ((X - 20) ** 2 + (Y - 15) ** 2) * STEP**2 + NOISE,
    "a tilt": 1e-6 * X + NOISE,
    "a smooth bump": 1e-6 * np.exp(-((X - 20) ** 2 + (Y - 15) ** 2) / 50),
    "pockets with steep walls": np.where((X % 10 < 4) & (Y % 10 < 4), -3e-6, 0.0) + NOISE,
}


@pytest.mark.parametrize("z", FORMS.values(), ids=FORMS)
def test_a_pixel_of_20_um_stands_out_and_a_good_map_does_not(z):
    assert outstanding(z, STEP)[0] == 0
    for row, column, height in ((12, 17, 20e-6), (0, 39, -20e-6), (29, 3, -32768e-6)):
        wrong = z.copy()
        wrong[row, column] += height
        count, point = outstanding(wrong, STEP)
        assert (count, point.row, point.column) == (1, row + 1, column + 1)
        assert point.height == pytest.approx(height, rel=0.2)


@pytest.mark.parametrize("z", FORMS.values(), ids=FORMS)
def test_a_scan_line_that_jumps_is_told_and_a_texture_is_not(z):
    assert jumped(z)[1] == []
    wrong = z.copy()
    wrong[11] += 2e-6
    assert jumped(wrong)[:2] == ("row", [12]) and jumped(wrong.T)[:2] == ("column", [12])


def test_a_point_of_a_profile_stands_out():
    good = NOISE.reshape(1, -1)
    wrong = good.copy()
    wrong[0, 17] += 20e-6
    count, point = outstanding(wrong, STEP)
    assert (count, point.row, point.column) == (1, 1, 18) and outstanding(good, STEP)[0] == 0


def test_a_height_for_missing_ones_is_apart_from_all_others():
    wrong = NOISE.copy()
    wrong[3:6, 8:11] = -32768e-9
    count, point = repeated(wrong)
    assert (count, point.row, point.column, point.height) == (9, 4, 9, -32768e-9)
    assert repeated(-wrong)[0] == 9
    for good in (NOISE, np.zeros(X.shape), np.where(X < 3, -1e-6, 0.0), np.minimum(NOISE, 1e-7)):
        assert repeated(good) == (0, None)


def test_of_an_archive_only_what_is_asked_for_is_unpacked(tmp_path):
    """A second array whose content is damaged is no matter, nor is one that is too large."""
    np.savez_compressed(tmp_path / "z.npz", heights=NOISE, dx=STEP, dy=STEP, unit="m")
    head = np.lib.format.header_data_from_array_1_0(np.zeros(1)) | {"shape": (2**40,)}
    with zipfile.ZipFile(tmp_path / "z.npz", "a") as archive, archive.open("bomb.npy", "w") as member:
        np.lib.format.write_array_header_1_0(member, head)
    np.testing.assert_array_equal(read_map(tmp_path / "z.npz").heights, NOISE)


@pytest.mark.parametrize("name", ["z.npy", "z.npz"])
def test_an_array_that_is_too_large_is_not_read(tmp_path, name):
    head = np.lib.format.header_data_from_array_1_0(np.zeros((1, 1))) | {"shape": (2**20, 2**20)}
    with open(tmp_path / "z.npy", "wb") as file:
        np.lib.format.write_array_header_1_0(file, head)
    with zipfile.ZipFile(tmp_path / "z.npz", "w") as archive:
        archive.write(tmp_path / "z.npy", "heights.npy")
    with pytest.raises(SurfaceFileError, match=r"has 8\.8e\+12 bytes; must be at most 2\.15e\+09"):
        read_map(tmp_path / name)
