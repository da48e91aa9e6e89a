import os
import sys
import zipfile

import numpy as np
import pytest
from told import refusal

from mgehl.errors import UserError
from mgehl.model.surface import Measured, Preparation
from mgehl.model.surface.map import SurfaceFileError

NY, NX = 21, 25
DX, DY = 2e-6, 3e-6
X, Y = DX * (np.arange(NX) - 12), DY * (np.arange(NY) - 10)
HEIGHTS = 1e-7 * np.cos(2 * np.pi * X[None, :] / 24e-6) + 2e-8 * np.sin(1e5 * Y[:, None])
GIVEN = Preparation(height_unit=1e-6, dx=DX, dy=DY)


def write(path, text):
    path.write_text(text)
    return str(path)


def refused(path, **told):
    message = refusal(lambda: Measured(str(path), Preparation(**told)).heights, error=SurfaceFileError)
    assert message.startswith(f"{path}: ") and issubclass(SurfaceFileError, UserError)
    return message


def matrix(path, separator=" ", head=""):
    lines = [separator.join(f"{1e6 * z:.12g}" for z in row) for row in HEIGHTS]
    return write(path, head + "\n".join(lines) + "\n")


def points(path, separator=" ", head="", keep=slice(None)):
    rows = [
        (1e6 * x + 100.0, 1e6 * y, 1e6 * z)
        for line, y in zip(HEIGHTS, Y, strict=True)
        for z, x in zip(line, X, strict=True)
    ]
    order = np.random.default_rng(0).permutation(len(rows))
    lines = [separator.join(f"{value:.12g}" for value in rows[k]) for k in order]
    return write(path, head + "\n".join(lines[keep]) + "\n")


def npy(path):
    np.save(path, 1e6 * HEIGHTS)
    return str(path)


def npz(path, **more):
    np.savez(path, heights=1e6 * HEIGHTS, **more)
    return str(path)


UM = 1e-6
READ = {
    "npy": lambda d: Measured(npy(d / "z.npy"), GIVEN),
    "npz": lambda d: Measured(npz(d / "z.npz"), GIVEN),
    "npz with all": lambda d: Measured(npz(d / "z.npz", x=1e6 * X, y=1e6 * Y, unit="um")),
    "npz with steps": lambda d: Measured(
        npz(d / "z.npz", dx=1e3 * DX, dy=1e3 * DY, height_unit="um", position_unit="mm")
    ),
    "matrix": lambda d: Measured(matrix(d / "z.txt", head="# heights\n\n"), GIVEN),
    "matrix of commas": lambda d: Measured(matrix(d / "z.csv", ","), GIVEN),
    "x y z": lambda d: Measured(points(d / "z.xyz"), Preparation(UM, UM)),
    "x,y,z with names": lambda d: Measured(points(d / "z.csv", ", ", "x, y, z\n"), Preparation(UM, UM)),
}  # fmt: skip


@pytest.mark.parametrize("made", READ.values(), ids=READ)
def test_every_format_gives_the_same_surface(tmp_path, made):
    surface = made(tmp_path)
    np.testing.assert_allclose(surface.heights.values, HEIGHTS, rtol=0, atol=1e-18)
    assert surface.heights.size == pytest.approx(((NX - 1) * DX, (NY - 1) * DY))
    nodes = surface.height(X[None, :], Y[:, None])
    np.testing.assert_allclose(nodes, HEIGHTS, rtol=0, atol=1e-18)
    between = surface.height(X[12] + 0.3 * DX, Y[10])
    assert between == pytest.approx(1e-7 * np.cos(2 * np.pi * 0.3 * DX / 24e-6), rel=3e-4)


PROFILES = {
    "x z": lambda order: "\n".join(f"{1e6 * X[i]} {1e6 * HEIGHTS[0, i]}" for i in order),
    "x z with units": lambda order: "\n".join(
        ["x [mm];z [nm]", *(f"{1e3 * X[i]};{1e9 * HEIGHTS[0, i]}" for i in order)]
    ),
}


@pytest.mark.parametrize("text", PROFILES.values(), ids=PROFILES)
@pytest.mark.parametrize("step", [1, -1])
def test_a_profile_is_the_same_all_along_y(tmp_path, text, step):
    written = write(tmp_path / "z.txt", text(range(NX)[::step]))
    has_units = text is PROFILES["x z with units"]
    surface = Measured(written, Preparation() if has_units else Preparation(UM, UM))
    assert surface.heights.is_profile and surface.heights.size_words.endswith("um long")
    for y in (0.0, 1.0, -1.0):
        np.testing.assert_allclose(surface.height(X, y), HEIGHTS[0], rtol=0, atol=1e-16)


class TestPlace:
    @pytest.fixture
    def path(self, tmp_path):
        return npy(tmp_path / "z.npy")

    def test_its_middle_is_where_it_is_put_and_it_is_turned(self, path):
        turned = Measured(path, GIVEN, x=1e-4, y=2e-4, angle=30.0)
        c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
        x, y = 1e-4 + c * X[5] - s * Y[3], 2e-4 + s * X[5] + c * Y[3]
        assert turned.height(x, y) == pytest.approx(HEIGHTS[3, 5], abs=1e-16)
        square = Measured(path, GIVEN, angle=90.0)
        np.testing.assert_allclose(square.height(-Y[None, :], X[:, None]), HEIGHTS.T, rtol=0, atol=1e-18)

    @pytest.mark.parametrize("how, column", [("none", NX - 1), ("mirror", NX - 3), ("periodic", 1)])
    def test_beyond_its_edge_it_goes_on(self, path, how, column):
        told = Preparation(height_unit=1e-6, dx=DX, dy=DY, continuation=how)
        surface = Measured(path, told)
        beyond = surface.height(X[-1] + 2.0 * DX, Y[4])
        assert beyond == pytest.approx(HEIGHTS[4, column], abs=1e-16)
        assert surface.reaches(X[-1] + 2.0 * DX, 0.0) == (how != "none")


class TestPreparation:
    def of(self, tmp_path, heights, **told):
        np.save(tmp_path / "z.npy", heights)
        given = {"height_unit": 1.0, "dx": 1e-6, "dy": 1e-6} | told
        return Measured(str(tmp_path / "z.npy"), Preparation(**given)).heights.values

    x, y = np.linspace(-1, 1, 40)[None, :], np.linspace(-1, 1, 30)[:, None]
    wave = 1e-8 * np.cos(2 * np.pi * np.arange(40) / 8)[None, :] + 0.0 * y

    @pytest.mark.parametrize(
        "remove, form",
        [("mean", 3.0), ("tilt", 3.0 + x - 2 * y),
         ("curvature", 3.0 + x - 2 * y + x**2 - x * y + 5 * y**2)],
    )  # fmt: skip
    def test_what_is_removed_is_gone(self, tmp_path, remove, form):
        found = self.of(tmp_path, form + 0.0 * self.wave, remove=remove)
        np.testing.assert_allclose(found, 0.0, rtol=0, atol=1e-13)
        kept = self.of(tmp_path, form + 0.0 * self.wave)
        np.testing.assert_array_equal(kept, form + 0.0 * self.wave)

    def test_the_tilt_is_that_of_the_nearest_plane(self, tmp_path):
        np.save(tmp_path / "z.npy", 3.0 + self.x - 2 * self.y + 0.0 * self.wave)
        for remove, tilt in (("nothing", 4.0), ("tilt", 0.0)):
            told = Preparation(height_unit=1.0, dx=1e-6, remove=remove)
            found = Measured(str(tmp_path / "z.npy"), told).heights.tilt
            assert found == pytest.approx(tilt, abs=1e-12)

    def test_half_of_a_wave_of_the_cut_off_s_length_is_left(self, tmp_path):
        told = {"continuation": "periodic"}
        short = self.of(tmp_path, self.wave, shortest_wavelength=8e-6, **told)
        np.testing.assert_allclose(short, 0.5 * self.wave, rtol=0, atol=2e-3 * 1e-8)
        long = self.of(tmp_path, 1.0 + self.wave, longest_wavelength=8e-6, **told)
        np.testing.assert_allclose(long, 0.5 * self.wave, rtol=0, atol=2e-3 * 1e-8)

    def test_a_changed_file_is_read_anew(self, tmp_path):
        assert self.of(tmp_path, self.wave).max() == pytest.approx(1e-8)
        np.save(tmp_path / "z.npy", 2.0 * self.wave)
        os.utime(tmp_path / "z.npy", (1, 1))
        assert self.of(tmp_path, 2.0 * self.wave).max() == pytest.approx(2e-8)


def holed(z):
    z = np.array(z)
    z[3, 4] = z[7, 1] = np.nan
    return z


ARRAYS = {
    "holes": (holed(HEIGHTS), "2 of 525 points are holes, the first in row 4, column 5"),
    "infinite": (HEIGHTS / (Y[:, None] != 0.0), "25 of 525 points are holes, the first in row 11"),
    "text": (np.array([["a", "b"], ["c", "d"]]), "holds text, not numbers"),
    "complex": (1j * HEIGHTS, "holds values of type complex128, not numbers"),
    "three axes": (HEIGHTS[None], "; must be a matrix, rows along x"),
    "one number": (HEIGHTS[0, 0], "; must be a matrix, rows along x"),
    "three rows": (HEIGHTS[:3], "has 3 rows and 25 columns; must be at least 4 of each"),
    "nothing": (np.zeros((0, 0)), "is empty"),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value")
@pytest.mark.parametrize("heights, words", ARRAYS.values(), ids=ARRAYS)
def test_what_is_no_matrix_of_heights(tmp_path, heights, words):
    np.save(tmp_path / "z.npy", heights)
    assert words in refused(tmp_path / "z.npy", height_unit=1.0, dx=1e-6)


def text_of(points):
    return "\n".join(" ".join(map(str, point)) for point in points)


SQUARE = [(x, y, 1) for x in range(5) for y in range(5)]
TEXTS = {
    "nothing": ("", "is empty: it must hold heights"),
    "comments alone": ("# heights\n", "is empty: it must hold numbers"),
    "words": ("1 2 3 4\n1 2 oops 4\n", "line 2, column 3: 'oops' is no number"),
    "a matrix of text": ("a b c d\ne f g h\n", "has no row of numbers: line 1 is 'a b c d'"),
    "an empty cell": ("1,2,3,4\n1,,3,4\n" * 2, "2 of 16 points are holes, the first in row 2, column 2"),
    "too many holes": ("1,2,,4\n1,,,4\n" * 2, "6 of 16 points are holes; at most 25 % of all points"),
    "a profile with a point twice": ("0 1\n1 2\n" * 4, "size along x is zero, or its x do not rise"),
    "a short profile": ("0 1\n1 2\n2 1\n", "has 3 points along a line; must be at least 4"),
    "an uneven profile": ("0 1\n1 2\n2 1\n4 1\n5 1\n", "is not equal: 2 from x = 2 to 4"),
    "a profile without a place": ("0 1\n1 2\nnan 1\n4 1\n5 1\n", "line 3: x is no number"),
    "a short line": ("1 2 3 4\n1 2 3\n", "line 2 has 3 numbers, line 1 has 4"),
    "nan": ("\n".join(4 * ["1 2 nan 4"]), "4 of 16 points are holes, the first in row 1, column 3"),
    "too few": ("1 2 3 4\n1 2 3 4\n", "has 2 rows and 4 columns; must be at least 4 of each"),
    "a matrix of three columns": ("1 2 3\n" * 8, "has three columns, x y z of points, but"),
    "a profile": ("\n".join(f"{x} 0 1" for x in range(9)), "9 points with 9 different x and 1 different y"),
    "scattered": ("\n".join(f"{x**1.5} {x**1.7} 1" for x in range(9)), "fill no rectangle"),
    "a hole in x y z": (text_of([*SQUARE[:12], (2, 2, "nan"), *SQUARE[13:]]), "1 of 25 points are holes"),
    "x y z twice": (text_of([*SQUARE, (2, 2, 1)]), "x = 2, y = 2 is there more than once"),
    "x y z not full": (text_of([*SQUARE[:13], *SQUARE[14:]]), "1 of 25 points are holes"),
    "unequal": (text_of((x + (x > 2), y, z) for x, y, z in SQUARE), "is not equal: 2 from x = 2 to 4"),
}  # fmt: skip


@pytest.mark.parametrize("name", TEXTS)
def test_what_is_no_text_of_heights(tmp_path, name):
    text, words = TEXTS[name]
    write(tmp_path / "z.txt", text)
    spacing = {} if "x y z" in name or name == "unequal" else {"dx": 1e-6}
    assert words in refused(tmp_path / "z.txt", height_unit=1e-6, position_unit=1e-6, **spacing)


UNTOLD = {
    "no unit of height": (npy, {"dx": 1e-6}, "does not tell the unit of its heights"),
    "no spacing": (npy, {"height_unit": 1e-6}, "does not tell how far apart its points are"),
    "no unit of positions": (points, {"height_unit": 1e-6}, "does not tell the unit of its positions"),
}


@pytest.mark.parametrize("made, told, words", UNTOLD.values(), ids=UNTOLD)
def test_what_the_file_does_not_tell_must_be_given(tmp_path, made, told, words):
    assert words in refused(made(tmp_path / ("z.npy" if made is npy else "z.xyz")), **told)


NPZ = {
    "x of another length": ({"x": X[1:], "y": Y}, "has 24 values of x for 25 points along x"),
    "x alone": ({"x": X}, "tells dx alone"),
    "unequal": ({"x": X**3, "y": Y}, "its spacing along x is not equal"),
    "zero size": ({"x": 0.0 * X, "y": Y}, "its size along x is zero"),
    "zero steps": ({"dx": 0.0, "dy": 1.0}, "dx = 0: its size is zero"),
    "an unknown unit": ({"unit": "furlong"}, "height_unit = 'furlong': must be one of m, mm"),
}


@pytest.mark.parametrize("more, words", NPZ.values(), ids=NPZ)
def test_what_is_no_archive_of_heights(tmp_path, more, words):
    assert words in refused(npz(tmp_path / "z.npz", **more))


def test_no_matrix_no_file_and_no_text(tmp_path):
    np.savez(tmp_path / "z.npz", a=X, b=Y)
    assert "has no array named 'heights'; its arrays are a, b" in refused(tmp_path / "z.npz")
    assert "cannot be read: No such file" in refused(tmp_path / "none.npy")
    (tmp_path / "z.dat").write_bytes(b"\x00\x81\xff\xfe" * 9)
    assert "z.dat: is no text" in refused(tmp_path / "z.dat")


X3P = f"""<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1><Revision>ISO5436 - 2000</Revision>
<FeatureType>SUR</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{DX}</Increment><Offset>0</Offset></CX>
<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{DY}</Increment><Offset>0</Offset></CY>
<CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1>
<Record3><MatrixDimension><SizeX>{NX}</SizeX><SizeY>{NY}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>"""


class TestInstruments:
    def test_without_the_library_it_says_what_to_install(self, tmp_path, monkeypatch):
        monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
        (tmp_path / "z.x3p").write_bytes(bytes(9))
        assert "pip install mgehl[surfaces]" in refused(tmp_path / "z.x3p")

    @pytest.fixture
    def library(self):
        return pytest.importorskip("SurfaceTopography")

    def test_heights_sizes_and_units_are_the_file_s_own(self, library, tmp_path):
        """What the library can write: NetCDF. Its arrays are (nx, ny), a size that of nx steps."""
        made = library.Topography(1e9 * HEIGHTS.T, (1e9 * NX * DX, 1e9 * NY * DY), unit="nm", periodic=True)
        made.to_netcdf(str(tmp_path / "z.nc"))
        found = Measured(str(tmp_path / "z.nc")).heights
        np.testing.assert_allclose(found.values, HEIGHTS, rtol=0, atol=1e-15)
        assert (found.dx, found.dy) == pytest.approx((DX, DY))

    def test_a_profile(self, library, tmp_path):
        made = library.UniformLineScan(1e9 * HEIGHTS[0], 1e9 * NX * DX, unit="nm", periodic=True)
        made.to_netcdf(str(tmp_path / "z.nc"))
        found = Measured(str(tmp_path / "z.nc")).heights
        assert found.is_profile and found.dx == pytest.approx(DX)
        np.testing.assert_allclose(found.values[2], HEIGHTS[0], rtol=0, atol=1e-15)

    def test_an_x3p_file(self, library, tmp_path):
        with zipfile.ZipFile(tmp_path / "z.x3p", "w") as archive:
            archive.writestr("main.xml", X3P)
            archive.writestr("bindata/data.bin", HEIGHTS.astype("<f8").tobytes())
        found = Measured(str(tmp_path / "z.x3p")).heights
        np.testing.assert_array_equal(found.values, HEIGHTS)
        assert (found.dx, found.dy) == pytest.approx((DX, DY))

    def test_what_it_cannot_read_is_one_line(self, library, tmp_path):
        write(tmp_path / "z.x3p", "no archive")
        assert "'no archive', and no format that SurfaceTopography reads" in refused(tmp_path / "z.x3p")

    def test_what_a_reader_prints_is_not_on_standard_output(self, library, tmp_path, monkeypatch, capsys):
        library.Topography(HEIGHTS.T, (1.0, 1.0), unit="m").to_netcdf(str(tmp_path / "z.nc"))
        reader, opened = library.IO.NCReader, library.IO.NCReader.topography

        def loud(self, **told):
            print("loud")
            return opened(self, **told)

        monkeypatch.setattr(reader, "topography", loud)
        _ = Measured(str(tmp_path / "z.nc")).heights
        assert capsys.readouterr() == ("", "loud\n")
