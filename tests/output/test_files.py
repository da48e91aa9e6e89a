"""The files of a run directory."""

import csv
import json
import tomllib

import numpy as np
import pytest
import xarray

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.output import files
from mgehl.output.result import ContactResult, InequalityResult, Overlap, Resolution, Result, Work
from mgehl.output.solution import Fields, Solution


def make_result(**changes):
    values = {
        "converged": True, "reason": "all holds", "central_film_nm": 12.0, "minimum_film_nm": 1.0,
        "max_pressure_GPa": 2.3, "residual": 1e-9, "load_error": -1e-10, "complementarity_error": 0.0,
        "settled": True, "contradictions": [], "flux_imbalance": 1e-11,
        "contact": ContactResult(3, 0.01, 0.02, (4, 6), None, 0.0),
        "overlap": Overlap(0, 0.0),
        "pressure_inequality": InequalityResult(8, 1, 0.25, 1.5, [{"i": 6, "j": 3, "size": 0.25}]),
        "other_inequality": InequalityResult(8, 0, 0.0, 0.0, [], "at the interface"),
        "cavitated_nodes": 100, "groups": {"U": 1e-12},
        "resolution": Resolution(5.0, "resolved", "sufficient", 0.1),
        "moes_film": {"central": 4.0}, "formulas": {"grubin_nm": 10.0}, "work": Work(80.5, 14),
        "wall_s": 2.0, "ranks": 1, "versions": {"mgehl": "0"},
    }  # fmt: skip
    return Result(**(values | changes))


@pytest.mark.parametrize(
    "tables",
    [
        {"grid": {"nodes": 129, "x": [-2.0, 1.5]}, "motion": {"speed": "7.5 mm/s"}},
        {"moes": {"M": 20, "L": 10}, "lubricant": {"density_law": "constant"}},
    ],
)
def test_texts_read_back(tables, paper_contact):
    config, result = config_from_tables(tables), make_result(residual=np.nan, flux_imbalance=np.inf)
    rows = [{"grid": 65, "step": 0, "residual": 0.1}, {"grid": 65, "step": 1, "residual": 1.25e-9}]
    texts = files.texts_of(Solution(config, paper_contact(), None, None, rows, result))
    assert config_from_tables(tomllib.loads(texts["configuration.toml"])) == config
    read = list(csv.DictReader(texts["history.csv"].splitlines()))
    assert [{k: float(v) for k, v in row.items()} for row in read] == rows

    def refuse(constant):
        raise AssertionError(f"{constant} is not JSON")

    read = json.loads(texts["result.json"], parse_constant=refuse)
    assert read["residual"] is None and read["flux_imbalance"] is None
    assert read["contact"]["x_nodes"] == [4, 6] and read["contact"]["y_nodes"] is None
    assert "hertz" not in read and read["mixed"] is None
    assert read.keys() == {*files.plain_result(result), "inputs"}
    assert read["inputs"] == config.inputs


class TestFields:
    @pytest.fixture
    def mesh(self, paper_contact):
        contact = paper_contact(radius_y=25.4e-3)
        return Mesh(5, 3, (-1.9, 1.3), (-1.5, 1.5), contact.k_e)

    @pytest.fixture
    def contact(self, paper_contact):
        return paper_contact(radius_y=25.4e-3)

    @pytest.fixture
    def fields(self):
        P = np.arange(15.0).reshape(3, 5) / 15.0
        return Fields(P, 1.0 + P, (np.arange(15).reshape(3, 5) % 4).astype(np.int8))

    @pytest.fixture
    def data(self, tmp_path, mesh, contact, fields):
        solution = Solution(None, contact, mesh, fields, [], None, H0=-0.5)
        files.write_fields(tmp_path / "fields.h5", solution, {"history.csv": "a"})
        with xarray.open_dataset(tmp_path / "fields.h5", engine="h5netcdf") as data:
            yield data

    def test_every_field_is_there_with_unit_and_name(self, data):
        assert set(data.variables) == {"x", "y", "X", "Y", "pressure", "film", "P", "H", "status"}
        assert dict(data.sizes) == {"y": 3, "x": 5}
        for name, unit in {"x": "m", "y": "m", "pressure": "Pa", "film": "m", "P": "1", "H": "1"}.items():
            assert data[name].attrs["units"] == unit
            assert data[name].attrs["long_name"]

    def test_values(self, data, mesh, contact, fields):
        hertz = contact.hertz
        np.testing.assert_array_equal(data["P"], fields.P)
        np.testing.assert_array_equal(data["H"], fields.H)
        np.testing.assert_array_equal(data["status"], fields.status)
        np.testing.assert_allclose(data["pressure"], fields.P * hertz.p_h, rtol=1e-15)
        np.testing.assert_allclose(data["film"], fields.H * hertz.a**2 / 12.7e-3, rtol=1e-12)
        np.testing.assert_allclose(data["x"], mesh.X * hertz.a, rtol=1e-15)
        np.testing.assert_allclose(data["y"], mesh.Y * hertz.b, rtol=1e-15)
