import csv
import json
import tomllib

import numpy as np
import pytest

from mgehl.config import config_from_tables
from mgehl.output import files
from mgehl.output.result import ContactResult, Overlap, Resolution, Result, Work
from mgehl.output.solution import Solution
from mgehl.solver.inequality import Inequality


def make_result(**changes):
    values = {
        "converged": True, "reason": "all holds", "central_film_nm": 12.0, "minimum_film_nm": 1.0,
        "max_pressure_GPa": 2.3, "residual": 1e-9, "load_error": -1e-10, "complementarity_error": 0.0,
        "settled": True, "contradictions": [], "flux_imbalance": 1e-11,
        "contact": ContactResult(3, 0.01, 0.02, (4, 6), None, 0.0),
        "overlap": Overlap(0, 0.0),
        "pressure_inequality": Inequality(8, 1, 0.25, 1.5, [{"i": 6, "j": 3, "size": 0.25}]),
        "other_inequality": Inequality(8, 0, 0.0, 0.0, [], "at the interface"),
        "cavitated_nodes": 100, "groups": {"U": 1e-12},
        "resolution": Resolution(5.0, "resolved", "sufficient", 0.1),
        "moes_film": {"central": 4.0}, "formulas": {"grubin_nm": 10.0}, "work": Work(80.5, 14),
        "wall_s": 2.0, "ranks": 1, "versions": {"mgehl": "0"},
    }  # fmt: skip
    return Result(**(values | changes))


@pytest.mark.parametrize(
    "tables",
    [{"grid": {"nodes": 129, "x": [-2.0, 1.5]}, "motion": {"speed": "7.5 mm/s"}},
     {"moes": {"M": 20, "L": 10}, "lubricant": {"density_law": "constant"}}],
)  # fmt: skip
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
