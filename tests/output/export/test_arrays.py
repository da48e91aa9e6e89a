"""NumPy's archive and the table of text: read back by what reads them."""

import json

import numpy as np
import pytest
from made_solution import SHAPES, make_solution

from mgehl.config import config_from_tables
from mgehl.discretization.status import NAMES
from mgehl.output.export.export import write_csv, write_npz
from mgehl.output.files import plain_result

every_kind = pytest.mark.parametrize("kind", SHAPES)


@every_kind
def test_the_archive_holds_every_bit_and_no_pickle(kind, tmp_path):
    solution = make_solution(kind)
    write_npz(tmp_path / "a.npz", solution)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as read:
        arrays = {
            "x": solution.x, "y": solution.y, "pressure": solution.pressure, "film": solution.film,
            "P": solution.fields.P, "H": solution.fields.H, "status": solution.status,
        }  # fmt: skip
        assert set(read) == {*arrays, "status_names", "result", "configuration"}
        for name, values in arrays.items():
            np.testing.assert_array_equal(read[name], values)
            assert read[name].dtype == values.dtype
        assert read["status_names"].tolist() == list(NAMES)
        assert json.loads(str(read["result"])) == json.loads(json.dumps(plain_result(solution.result)))
        assert config_from_tables(json.loads(str(read["configuration"]))) == solution.config


def test_numbers_of_the_result_that_are_not_finite_stay_valid_json(tmp_path):
    solution = make_solution("wedge")
    object.__setattr__(solution.result, "residual", np.nan)
    write_npz(tmp_path / "a.npz", solution)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as read:
        assert json.loads(str(read["result"]))["residual"] is None


@every_kind
def test_the_table_reads_back_to_the_bit(kind, tmp_path):
    solution = make_solution(kind)
    write_csv(tmp_path / "a.csv", solution)
    read = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert read.dtype.names == ("x_m", "y_m", "pressure_Pa", "film_m", "status")
    shape = SHAPES[kind]
    np.testing.assert_array_equal(read["x_m"].reshape(shape), np.broadcast_to(solution.x, shape))
    np.testing.assert_array_equal(read["y_m"].reshape(shape), np.broadcast_to(solution.y[:, None], shape))
    np.testing.assert_array_equal(read["pressure_Pa"].reshape(shape), solution.pressure)
    np.testing.assert_array_equal(read["film_m"].reshape(shape), solution.film)
    assert [NAMES.index(name) for name in read["status"]] == solution.status.ravel().tolist()
