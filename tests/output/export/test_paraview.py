"""Fields for ParaView: read back by the text of VTK's format alone."""

from xml.etree import ElementTree

import numpy as np
import pytest
from made_solution import SHAPES, make_solution

from mgehl.output.export.paraview import write_vts

NAMES = ("pressure_Pa", "film_m", "P", "H", "status")

every_kind = pytest.mark.parametrize("kind", SHAPES)


def values_of(solution):
    fields = solution.fields
    values = solution.pressure, solution.film, fields.P, fields.H, fields.status
    return dict(zip(NAMES, values, strict=True))


def places_of(solution):
    x, y = np.meshgrid(solution.x, solution.y)
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)


def read_plainly(path):
    """Extent of the grid and its arrays by name, by the text of VTK's format alone."""
    header, data = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    root = ElementTree.fromstring(header + b"</VTKFile>")
    order = {"LittleEndian": "<", "BigEndian": ">"}[root.get("byte_order")]
    length = np.dtype(order + {"UInt32": "u4", "UInt64": "u8"}[root.get("header_type")])
    arrays = {}
    for each in root.iter("DataArray"):
        assert (each.get("type"), each.get("format")) == ("Float64", "appended")
        offset = int(each.get("offset"))
        size = int(np.frombuffer(data, length, 1, offset)[0])
        arrays[each.get("Name")] = np.frombuffer(data, order + "f8", size // 8, offset + length.itemsize)
    return root.find("StructuredGrid").get("WholeExtent"), arrays


@every_kind
def test_every_value_is_in_the_file(kind, tmp_path):
    solution = make_solution(kind)
    write_vts(tmp_path / "a.vts", solution)
    extent, arrays = read_plainly(tmp_path / "a.vts")
    ny, nx = SHAPES[kind]
    assert extent == f"0 {nx - 1} 0 {ny - 1} 0 0"
    assert tuple(arrays) == ("Position", *NAMES)
    np.testing.assert_array_equal(arrays["Position"].reshape(-1, 3), places_of(solution))
    for name, field in values_of(solution).items():
        np.testing.assert_array_equal(arrays[name], field.ravel())
