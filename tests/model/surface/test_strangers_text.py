import re

import numpy as np
import pandas
import pytest
from told import refusal

from mgehl.model.surface.files import read_map
from mgehl.model.surface.map import SurfaceFileError

Z = np.array([[1.5, -2.25, 3.0, 4.0], [0.5, 1e-3, 7.0, 8.0], [9.0, 1.0, 2.0, 3.5], [4.0, 5.0, 6.0, 7.0]])


def matrix(separator, comma=".", form="{:g}"):
    return "".join(separator.join(form.format(z).replace(".", comma) for z in row) + "\n" for row in Z)


TEXTS = {
    "tabs": matrix("\t"),
    "semicolons": matrix(";"),
    "decimal commas between semicolons": matrix(";", ","),
    "decimal commas between tabs": matrix("\t", ","),
    "decimal commas between blanks": matrix("  ", ","),
    "quoted": matrix(";", ",", '"{:g}"'),
    "quoted decimal commas between commas": matrix(",", ",", '"{:g}"'),
    "decimal commas between commas and blanks": '"of a lens", "a"\n' + matrix(", ", ",", "{:.4f}"),
    "quoted between blanks": '"z"\n' + matrix(" ", ",", '"{:g}"'),
    "separators at the ends": matrix(",").replace("\n", ",\n"),
    "indented by tabs": "\t" + matrix("\t").strip().replace("\n", "\n\t"),
    "a heading of words and numbers": "Operator: N. N.\nDate=2024-02-01 10:11\nz\n" + matrix(";", ","),
    "a heading of an instrument": "Probe 3\nNumPoints = 4\n*\n" + matrix(" ") + "*\n< PartName > x\n",
}


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("name", TEXTS)
def test_separators_and_encodings(tmp_path, name, encoding):
    (tmp_path / "z.any").write_text(TEXTS[name], encoding=encoding)
    np.testing.assert_array_equal(read_map(tmp_path / "z.any").heights, Z)


@pytest.mark.parametrize("hole", ["Bad", "nan", "NaN", "No Data", "---", "#N/A", ""])
def test_holes_are_nan(tmp_path, hole):
    text = matrix(";", ",").replace("0,001", hole).replace("1,5", hole)
    (tmp_path / "z.csv").write_text(text)
    expected = Z.copy()
    expected[0, 0] = expected[1, 1] = np.nan
    np.testing.assert_array_equal(read_map(tmp_path / "z.csv").heights, expected)


def test_a_row_that_begins_with_a_hole_is_no_comment(tmp_path):
    (tmp_path / "z.csv").write_text("#N/A;1;2;3\n" + matrix(";"))
    np.testing.assert_array_equal(read_map(tmp_path / "z.csv").heights, np.vstack([[np.nan, 1, 2, 3], Z]))


def test_rows_of_holes_before_the_first_heights_are_rows(tmp_path):
    (tmp_path / "z.txt").write_text("z\nBad Bad Bad Bad\n---\nnan nan nan nan\n" + matrix(" "))
    found = read_map(tmp_path / "z.txt").heights
    np.testing.assert_array_equal(found, np.vstack([np.full((2, 4), np.nan), Z]))


HEADINGS = {
    "Gwyddion": ("# Width: 12.0 µm\n# Height: 20000 nm\n# Value units: nm\n", 3.0, 5.0, 1e-6, 1e-9),
    "Gwyddion in German": ("# Breite: 12,0 µm\n# Höhe: 20,0 µm\n# Value units: m\n", 3.0, 5.0, 1e-6, 1.0),
    "pixels": (
        "h=4 w=4\npixel size=3.5e-007 m\ndata unit=rad\nheight conversion factor (-> m)=6e-8\n",
        3.5e-7, 3.5e-7, 1.0, 6e-8,
    ),
    "SPIP": ("# x-length=8 ; y-length=4 ; x-unit=nm ; z-unit=pm\n", 2.0, 1.0, 1e-9, 1e-12),
    "another height": (
        "# Max height: 3.2 µm\n# Scan width = 12 um; Height = 20 um; Height: 1 um\n", 3.0, 5.0, 1e-6, None),
    "pixels in a line": ("# Pixel size: 2 nm\n# Width: 4 px\n# Height: 8.1 nm\n", 2.0, 2.0, 1e-9, None),
    "steps": ("# dx = 1.5 um, dy = 3 um\n# Z unit: nm\n", 1.5, 3.0, 1e-6, 1e-9),
    "steps in words": ("unit=nm\nx-spacing: 2 um\ny-spacing: 2000 nm\n", 2.0, 2.0, 1e-6, 1e-9),
    "no unit": ("# Width: 12\n# Height: 8\n", 3.0, 2.0, None, None),
}  # fmt: skip


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1", "utf-16"])
@pytest.mark.parametrize("heading, dx, dy, position, height", HEADINGS.values(), ids=HEADINGS)
def test_headings_tell_sizes_and_units(tmp_path, heading, dx, dy, position, height, encoding):
    (tmp_path / "z.txt").write_text(heading + matrix("\t"), encoding=encoding)
    found = read_map(tmp_path / "z.txt")
    assert (found.dx, found.dy) == pytest.approx((dx, dy))
    assert (found.position_unit, found.height_unit) == (position, height)
    np.testing.assert_array_equal(found.heights, Z)


def test_a_grid_of_maps_begins_in_the_north_and_tells_its_holes(tmp_path):
    heading = "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 2.5\nNODATA_value -9999\n"
    rows = matrix(" ").splitlines()
    rows[0] = " ".join(["-9999", *rows[0].split()[1:]])
    (tmp_path / "z.asc").write_text(heading + "\n".join(rows))
    found, expected = read_map(tmp_path / "z.asc"), Z[::-1].astype(float)
    expected[-1, 0] = np.nan
    np.testing.assert_array_equal(found.heights, expected)
    assert (found.dx, found.dy, found.position_unit) == (2.5, 2.5, None)


@pytest.mark.parametrize(
    ("heading", "columns", "units"),
    [("No.;X [mm];Z [um]", "kxz", (1e-3, 1e-6)), ("Z [um];X [mm]", "zx", (1e-3, 1e-6)),
     ("x (mm);height (um);quality", "xzk", (1e-3, 1e-6)), ("X (in);Z (uin)", "xz", (25.4e-3, 25.4e-9))],
)  # fmt: skip
def test_columns_of_a_profile_are_those_of_their_names(tmp_path, heading, columns, units):
    rows = [{"k": k, "x": 0.001 * k, "z": k % 3} for k in range(9)]
    lines = (";".join(f"{row[name]:g}" for name in columns) for row in rows)
    (tmp_path / "z.csv").write_text("\n".join([heading, *lines]))
    found = read_map(tmp_path / "z.csv")
    np.testing.assert_array_equal(found.heights[0], [k % 3 for k in range(9)])
    assert found.dx == pytest.approx(0.001)
    assert (found.position_unit, found.height_unit) == units


@pytest.mark.parametrize(
    "heading",
    ["x_um,y_um,z_um,I", "# Pixel size: 1 um\nI,y [um],x [um],z [um]"],
    ids=["units", "a size before"],
)
def test_points_are_those_of_their_names(tmp_path, heading):
    names = [re.sub(r"\W|_um|um", "", cell) for cell in heading.splitlines()[-1].split(",")]
    points = ({"x": i, "y": j, "z": Z[j, i], "I": 7} for j in range(4) for i in range(4))
    lines = (",".join(f"{point[name]:g}" for name in names) for point in points)
    (tmp_path / "z.csv").write_text("\n".join([heading, *lines]))
    found = read_map(tmp_path / "z.csv")
    np.testing.assert_array_equal(found.heights, Z)
    assert (found.dx, found.dy, found.position_unit, found.height_unit) == (1.0, 1.0, 1e-6, 1e-6)


def test_words_of_a_comment_are_no_names(tmp_path):
    points = "\n".join(f"{i} {j} {Z[j, i]}" for j in range(4) for i in range(4))
    (tmp_path / "z.txt").write_text("# Height along x\n" + points)
    np.testing.assert_array_equal(read_map(tmp_path / "z.txt").heights, Z)


@pytest.mark.parametrize("form", ["{:.5g}", "{:.4e}"])
def test_coordinates_of_five_digits_are_a_grid(tmp_path, form):
    """320 by 240 points .49261 um apart: of the largest coordinates steps are .49 or .5."""
    x, y = 0.49261 * np.arange(320), 0.49261 * np.arange(240)
    points = ((form.format(a), form.format(b), f"{a + 3 * b:.6f}") for b in y for a in x)
    (tmp_path / "z.xyz").write_text("\n".join(" ".join(point) for point in points))
    found = read_map(tmp_path / "z.xyz")
    np.testing.assert_allclose(found.heights, x + 3 * y[:, None], rtol=0, atol=5e-7)
    assert (found.dx, found.dy) == pytest.approx((0.49261, 0.49261), rel=1e-4)


THOUSANDS = '1;"1,234.56";3;4\n' * 4
REFUSED = {
    "thousands": (THOUSANDS, "line 1, column 2: '1,234.56' is no number"),
    "thousands below a row": ("1;2;3;4\n" + THOUSANDS, "line 2, column 2: '1,234.56' is no number"),
    "thousands below a heading": ("z\n" + THOUSANDS, "line 2, column 2: '1,234.56' is no number"),
    "thousands in the first row alone": ("1;1,234.56;3;4\n" + matrix(";"), "line 1, column 2: '1,234.56' "),
    "a cell of any length": ('"' + 200000 * "a" + ";b\n", "has no row of numbers"),
    "three columns that are heights, with a size": (
        "# Width: 1 um\n# Height: 1 um\n1 2 3\n4 5 6\n1 2 3\n4 5 6\n", "has 4 rows and 3 columns; must be"),
    "pixels of another size": (
        f"# Pixel size: 1 um\n# Width: 4 um\n# Height: 9 um\n{matrix(';')}",
        "its heading tells a size along y of 9e-06 m, but its pixels make 4e-06 m"),
    "a column too many": (
        f"ncols 3\nnrows 4\ncellsize 2\nNODATA_value -9\n{matrix(' ')}", "tells 3 columns, but it has 4"),
    "no heights": ("# Value units: V\n1 2 3 4\n4 5 6 7\n1 2 3 4\n", "in V, which are no heights"),
    "a line that is missing": (
        "\n".join(f"{a} {b} 1" for b in (0, 1, 2, 3, 5) for a in range(5)),
        "its spacing along y is not equal: 2 from y = 3 to 5"),
}  # fmt: skip
"""Numbers that are not understood are named, and none is left out."""


@pytest.mark.parametrize("text, words", REFUSED.values(), ids=REFUSED)
def test_what_is_refused(tmp_path, text, words):
    (tmp_path / "z.csv").write_text(text)
    assert words in refusal(read_map, tmp_path / "z.csv", error=SurfaceFileError)


POINTS = "".join(f"{x};{1000 * y};{x + y}\n" for y in range(4) for x in range(5))
UM, NM = 1e-6, 1e-9


@pytest.mark.parametrize(
    "heading, dy, position, height",
    [("x (um);y (nm);z (nm)", 1.0, UM, NM), ("X[mm];Y[mm];Height[um]", 1000.0, 1e-3, UM),
     ('"x / µm";"y / µm";"z / µm"', 1000.0, UM, UM),
     ("X;Y;Z\nµm;nm;pm", 1.0, UM, 1e-12), ("X Y Z\n[mm];[mm];[um]", 1000.0, 1e-3, UM),
     ("made on 1 May\n# x um; y um; z pm", 1000.0, UM, 1e-12), ("x;y;z (counts)", 1000.0, None, None)],
)  # fmt: skip
def test_headings_of_points_tell_units(tmp_path, heading, dy, position, height):
    (tmp_path / "z.csv").write_text(f"{heading}\n{POINTS}")
    found = read_map(tmp_path / "z.csv")
    assert (found.dx, found.dy) == pytest.approx((1.0, dy))
    assert (found.position_unit, found.height_unit) == (position, height)


def test_names_above_a_line_of_units_tell_the_columns(tmp_path):
    (tmp_path / "z.csv").write_text(f"Y;X;Z\nnm;µm;pm\n{POINTS}")
    found = read_map(tmp_path / "z.csv")
    assert (found.dx, found.dy) == pytest.approx((1000.0, 1e-3)) and found.position_unit == UM


def test_units_that_contradict_the_configuration_are_refused(tmp_path):
    (tmp_path / "z.csv").write_text(f"x (um);y (um);z (nm)\n{POINTS}")
    found = read_map(tmp_path / "z.csv")
    assert found.with_units(NM, UM, None, None).height_unit == NM
    with pytest.raises(SurfaceFileError, match='height_unit = "um", but the file itself says "nm"'):
        found.with_units(UM, None, None, None)
    with pytest.raises(SurfaceFileError, match='position_unit = "mm", but the file itself says "um"'):
        found.with_units(None, 1e-3, None, None)
    with pytest.raises(SurfaceFileError, match="spacing = 8e-06 m, but the file itself says 1e-06"):
        found.with_units(None, None, 8e-6, None)
    assert found.with_units(None, None, 1e-6, 1e-3).dx == 1e-6


def with_positions(corner, x, y, z):
    rows = [[corner, *x], *([b, *row] for b, row in zip(y, z, strict=True))]
    return "\n".join(";".join(map(str, row)) for row in rows)


NOISE = np.random.default_rng(3).normal(0.0, 30.0, (6, 9)).round(3)
RIGHT, DOWN = 2.0 * np.arange(9), 3.0 * np.arange(6)
RAMP = np.add.outer(DOWN, RIGHT)


@pytest.mark.parametrize("corner", ['"x\\y"', "", "0"])
def test_a_first_row_and_column_of_positions_are_no_heights(tmp_path, corner):
    text = with_positions(corner, 100.0 * RIGHT, 100.0 * DOWN + 500.0, NOISE)
    (tmp_path / "z.csv").write_text(text)
    found = read_map(tmp_path / "z.csv")
    np.testing.assert_array_equal(found.heights, NOISE)
    assert (found.dx, found.dy, found.doubt) == (200.0, 300.0, "")


DOUBTFUL = {
    "heights go on as they begin": with_positions(0, RIGHT[1:], DOWN[1:], RAMP[1:, 1:]),
    "they fall": with_positions("", 100.0 * RIGHT[::-1], 100.0 * DOWN, NOISE),
}


@pytest.mark.parametrize("text", DOUBTFUL.values(), ids=DOUBTFUL)
def test_where_that_is_not_certain_they_stay_heights_and_it_is_said(tmp_path, text):
    (tmp_path / "z.csv").write_text(text)
    found = read_map(tmp_path / "z.csv")
    assert len(found.heights) == text.count("\n") + 1 and found.dx is None
    assert found.doubt.startswith("the first row and column are evenly spaced, as positions are")


@pytest.mark.parametrize("corner", ["0", "name"])
def test_rough_heights_below_a_zero_or_a_heading_are_heights(tmp_path, corner):
    (tmp_path / "z.csv").write_text(with_positions(corner, RIGHT, NOISE[:, 0], NOISE))
    found = read_map(tmp_path / "z.csv")
    assert found.heights.shape == (7 if corner == "0" else 6, 10) and found.dx is None
    assert found.doubt.startswith("the first row is evenly spaced") == (corner == "0")


@pytest.mark.parametrize("rows, columns", [(True, False), (False, True), (True, True)])
def test_numbers_of_rows_and_columns_are_no_heights(tmp_path, rows, columns):
    """As pandas writes them: the rms of heights of 80 nm was 700."""
    heights = np.vstack([NOISE, NOISE[::-1]])
    pandas.DataFrame(heights).to_csv(tmp_path / "z.csv", index=rows, header=columns)
    found = read_map(tmp_path / "z.csv")
    np.testing.assert_array_equal(found.heights, heights)
    assert "counts from 0 on" in found.doubt or (rows and columns and found.dx == found.dy == 1.0)


def test_few_heights_that_count_are_heights(tmp_path):
    few = np.vstack([np.arange(5.0), NOISE[:4, :5]])
    np.savetxt(tmp_path / "z.txt", few)
    np.testing.assert_array_equal(read_map(tmp_path / "z.txt").heights, few)


@pytest.mark.parametrize("shape", [(1, 54), (54, 1)])
def test_one_row_or_column_is_a_profile(tmp_path, shape):
    np.savetxt(tmp_path / "z.txt", NOISE.reshape(shape))
    np.save(tmp_path / "z.npy", NOISE.ravel())
    np.save(tmp_path / "column.npy", NOISE.reshape(shape))
    np.savez(tmp_path / "z.npz", heights=NOISE.reshape(shape), x=3.0 * np.arange(54))
    for name in ("z.txt", "z.npy", "column.npy", "z.npz"):
        found = read_map(tmp_path / name)
        assert found.is_profile and found.dx == (3.0 if name == "z.npz" else None)
        np.testing.assert_array_equal(found.heights[0], NOISE.ravel())


def test_a_spacing_keeps_the_shape_of_positions_without_a_unit(tmp_path):
    y, x = np.meshgrid(3.0 * np.arange(6), 2.0 * np.arange(9), indexing="ij")
    np.savetxt(tmp_path / "z.txt", np.column_stack([x.ravel(), y.ravel(), NOISE.ravel()]))
    told = read_map(tmp_path / "z.txt").with_units(1e-9, None, 4e-6, None)
    assert (told.dx, told.dy) == pytest.approx((4e-6, 6e-6))


def test_rows_whose_positions_fall_are_turned(tmp_path):
    """The first row of a `Map` is at its lowest y."""
    (tmp_path / "z.csv").write_text(with_positions("", 100.0 * RIGHT, 100.0 * DOWN[::-1], NOISE))
    found = read_map(tmp_path / "z.csv")
    np.testing.assert_array_equal(found.heights, NOISE[::-1])
    assert (found.dx, found.dy, found.doubt) == (200.0, 300.0, "")
