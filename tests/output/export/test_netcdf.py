from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
import xarray
from made_solution import SHAPES, make_solution

from mgehl.config import load_config
from mgehl.discretization.status import NAMES
from mgehl.output.export.netcdf import write_netcdf
from mgehl.version import VERSION

UNITS = {
    "x": "m", "y": "m", "x_scaled": "1", "y_scaled": "1", "pressure": "Pa", "film": "m", "P": "1",
    "H": "1", "status": "1", "speed": "m s-1",
}  # fmt: skip
LOADED = {
    "angle": "degree", "group_U": "1", "group_W": "1", "group_G": "1", "moes_M": "1", "moes_L": "1",
    "central_film_nm": "nm", "minimum_film_nm": "nm", "max_pressure_GPa": "GPa", "contact_area": "1",
    "convolutions": "1",
}  # fmt: skip
OF_A_KIND = {
    "point": LOADED | {"normal_load": "N"},
    "line": LOADED | {"normal_load": "N m-1"},
    "wedge": {"bearing_load_N": "N", "bearing_pressure_MPa": "MPa"},
}  # fmt: skip


every_kind = pytest.mark.parametrize("kind", SHAPES)


@pytest.fixture
def opened(tmp_path):
    """Function that writes a solution and returns it with the data set that xarray makes of it."""
    sets = []

    def write_and_open(kind):
        solution = make_solution(kind)
        write_netcdf(tmp_path / "a.nc", solution)
        sets.append(xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf"))
        return solution, sets[-1]

    yield write_and_open
    for each in sets:
        each.close()


@every_kind
def test_every_variable_has_its_unit_and_name(kind, opened):
    _, data = opened(kind)
    told = {name: variable.attrs["units"] for name, variable in data.variables.items()}
    assert told == UNITS | OF_A_KIND[kind]
    assert all(variable.attrs["long_name"] for variable in data.variables.values())


@every_kind
def test_fields_and_coordinates_to_the_bit(kind, opened):
    solution, data = opened(kind)
    assert set(data.coords) == {"x", "y", "x_scaled", "y_scaled"}
    for name, values in {
        "x": solution.x, "y": solution.y, "x_scaled": solution.mesh.X, "y_scaled": solution.mesh.Y,
        "pressure": solution.pressure, "film": solution.film, "P": solution.fields.P,
        "H": solution.fields.H, "status": solution.status,
    }.items():  # fmt: skip
        np.testing.assert_array_equal(data[name].values, values)
        assert data[name].dtype == values.dtype
    assert (data.film.dims, data.film.shape) == (("y", "x"), SHAPES[kind])
    assert (data.x.attrs["axis"], data.y.attrs["axis"]) == ("X", "Y")


def test_the_status_has_flags(opened):
    _, data = opened("point")
    flags = data.status.attrs
    assert flags["flag_values"].dtype == data.status.dtype
    meanings = dict(zip(flags["flag_values"].tolist(), flags["flag_meanings"].split(), strict=True))
    assert meanings == dict(enumerate(NAMES))


@pytest.mark.parametrize("kind", ["point", "line"])
def test_scalars_of_a_loaded_contact(kind, opened):
    solution, data = opened(kind)
    contact, result = solution.contact, solution.result
    assert float(data.speed) == contact.speed and float(data.normal_load) == contact.load
    for name in ("central_film_nm", "minimum_film_nm", "max_pressure_GPa"):
        assert float(data[name]) == getattr(result, name)
    for name in ("group_U", "group_W", "group_G", "moes_M", "moes_L"):
        assert float(data[name]) == getattr(contact.groups, name[-1])


def test_lambda_is_told_of_bodies_that_are_rough_by_a_number(tmp_path):
    smooth = make_solution("point")
    rough = replace(smooth, config=smooth.config.with_({"body_1.roughness": "50 nm"}))
    write_netcdf(tmp_path / "a.nc", rough)
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert float(data.lambda_ratio) == pytest.approx(rough.result.central_film_nm / 50.0)


@every_kind
def test_the_file_says_where_it_comes_from(kind, opened, tmp_path):
    solution, data = opened(kind)
    assert data.attrs["Conventions"] == "CF-1.8" and kind in data.attrs["title"]
    assert data.attrs["source"] == f"mgehl {VERSION}"
    written = datetime.fromisoformat(data.attrs["history"].split()[0])
    assert abs(datetime.now(UTC) - written) < timedelta(minutes=1)
    assert data.attrs["converged"] == "yes" and data.attrs["verdict"] == solution.result.reason
    (tmp_path / "again.toml").write_text(data.attrs["configuration"])
    assert load_config(tmp_path / "again.toml") == solution.config
