import json

import numpy as np
import pytest
import xarray
from made_solution import make_solution

from mgehl.output.export.export import export


@pytest.fixture
def solution():
    solution = make_solution("point")
    random = np.random.default_rng(3)
    fields = solution.fields
    fields.p, fields.filling, fields.heights = random.random((3, *fields.P.shape))
    return solution


def read(path):
    if path.suffix == ".nc":
        with xarray.open_dataset(path, engine="h5netcdf") as data:
            return {name: data[name].values for name in data.variables}
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return dict(arrays)
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")
    return {name: table[name] for name in table.dtype.names}


@pytest.mark.parametrize("form, units", [("nc", ("", "")), ("npz", ("", "")), ("csv", ("_Pa", "_m"))])
def test_they_read_back_to_the_bit(solution, tmp_path, form, units):
    export(solution, {form: tmp_path / f"a.{form}"})
    found = read(tmp_path / f"a.{form}")
    pressure = solution.fields.p * solution.contact.pressure_scale
    np.testing.assert_array_equal(found[f"fluid_pressure{units[0]}"].ravel(), pressure.ravel())
    np.testing.assert_array_equal(found["filling"].ravel(), solution.fields.filling.ravel())
    np.testing.assert_array_equal(found[f"heights{units[1]}"].ravel(), solution.heights.ravel())
    for name, unit in (("pressure", units[0]), ("film", units[1])):
        np.testing.assert_array_equal(found[f"{name}{unit}"].ravel(), getattr(solution, name).ravel())


def test_a_table_has_a_row_for_each_node_and_an_archive_the_units_of_X_and_the_result(solution, tmp_path):
    """What of the result is no number is null: valid JSON."""
    object.__setattr__(solution.result, "residual", np.nan)
    export(solution, {form: tmp_path / f"a.{form}" for form in ("csv", "npz")})
    table, archive = (read(tmp_path / f"a.{form}") for form in ("csv", "npz"))
    x, y = np.meshgrid(solution.x, solution.y)
    np.testing.assert_array_equal([table["x_m"], table["y_m"]], [x.ravel(), y.ravel()])
    for name in ("P", "H", "status"):
        np.testing.assert_array_equal(archive[name], getattr(solution.fields, name))
    assert archive["status_names"][archive["status"]].ravel().tolist() == table["status"].tolist()
    assert json.loads(str(archive["result"]), parse_constant=pytest.fail)["residual"] is None


def test_paraview_has_them(solution, tmp_path):
    export(solution, {"vts": tmp_path / "a.vts"})
    content = (tmp_path / "a.vts").read_bytes()
    assert b'Name="fluid_pressure' in content and b'Name="filling' in content
    assert b'Name="heights' in content
