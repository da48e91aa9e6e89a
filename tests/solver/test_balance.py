"""Runs make no oil: their files are asked by a checker that shares nothing with the program."""

import h5py
import pytest
from balance import balance
from places import ROUGH

import mgehl
from mgehl.discretization.status import CAVITATED


def run_of(path, **sections):
    config = mgehl.load(ROUGH, {"grid.nodes": 65, "solver.error": False, **sections})
    solution = mgehl.solve(config)
    fields = solution.fields
    assert solution.result.converged and (fields.filling[fields.status != CAVITATED] == 1.0).all()
    return solution.save(path)


@pytest.mark.parametrize("couette", ["1B", "3L"])
@pytest.mark.parametrize(
    ("layers", "seed", "speed"), [("2 nm", 60501, 0.01), ("2 nm", 60502, 1e-6), (0.0, 60503, 0.01)]
)
def test_no_node_of_a_rough_run_makes_oil(tmp_path, couette, layers, seed, speed):
    more = {"discretization.couette": couette, "contact.boundary_film": layers, "surface.seed": seed}
    run = run_of(tmp_path / "run", **more, **{"motion.speed": speed})
    found = balance(run)
    assert found.pop("leaves") == pytest.approx(1.0, abs=1e-8)
    assert all(abs(made) < 1e-8 for made in found.values()), found


def test_the_checker_sees_a_cavity_that_is_filled_out_of_nothing(tmp_path):
    run = run_of(tmp_path / "run")
    before = balance(run)
    with h5py.File(run / "fields.h5", "r+") as file:
        filling = file["filling"][:]
        filling[file["status"][:] == 2] = 1.0
        file["filling"][:] = filling
    after = balance(run)
    assert abs(before["cavity"]) < 1e-8 and abs(after["cavity"]) > 1e-3
