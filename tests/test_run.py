"""One run from a configuration to its directory."""

import csv
import json
from dataclasses import asdict

import numpy as np
import pytest
import xarray
from mpi4py import MPI

from mgehl.config import config_from_tables, load_config
from mgehl.discretization.status import CONTACT
from mgehl.run import run

FILES = {"configuration.toml", "fields.h5", "history.csv", "picture.png", "result.json"}
FILM = {"motion": {"speed": "1 m/s"}, "grid": {"nodes": 65}}
DRY = {"motion": {"speed": "0.005 mm/s"}, "grid": {"nodes": 65}, "solver": {"start": "contact"}}
RESULT_KEYS = {
    "converged", "reason", "central_film_nm", "minimum_film_nm", "max_pressure_GPa", "residual",
    "load_error", "complementarity_error", "flux_imbalance", "contact", "pressure_inequality",
    "cavitated_nodes", "resolution", "groups", "moes_film", "formulas", "work", "wall_s", "ranks",
    "versions",
}  # fmt: skip


def run_quietly(tables, directory):
    return run(config_from_tables(tables), directory, MPI.COMM_SELF, speak=False)


def read_json(directory):
    return json.loads((directory / "result.json").read_text())


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """Directory and result of a film at 1 m/s."""
    directory = tmp_path_factory.mktemp("film")
    return directory, run_quietly(FILM, directory)


def test_all_files_are_written(film):
    directory, result = film
    assert result.converged
    assert {path.name for path in directory.iterdir()} == FILES
    assert (directory / "picture.png").read_bytes().startswith(b"\x89PNG")


def test_the_result_file_is_the_result(film):
    directory, result = film
    read = read_json(directory)
    assert RESULT_KEYS <= read.keys()
    assert read == json.loads(json.dumps(asdict(result)))
    assert all(read["versions"].get(name) for name in ("mgehl", "petsc", "numpy", "mpi4py"))
    assert read["work"]["convolutions"] > 0.0 and read["wall_s"] > 0.0


def test_the_history_ends_with_the_result(film):
    directory, result = film
    with (directory / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    last = rows[-1]
    assert float(last["residual"]) == result.residual
    assert float(last["central_film_nm"]) == result.central_film_nm
    assert float(last["minimum_film_nm"]) == result.minimum_film_nm
    assert sum(1 for row in rows if int(row["step"]) > 0) == result.work.newton_steps
    work = [float(row["convolutions"]) for row in rows]
    assert work == sorted(work) and work[-1] <= result.work.convolutions


def test_the_fields_hold_the_films(film):
    directory, result = film
    with xarray.open_dataset(directory / "fields.h5", engine="h5netcdf") as data:
        assert data["film"].shape == (65, 65)
        assert 1e9 * float(data["film"].min()) == pytest.approx(result.minimum_film_nm)
        centre = data["film"].sel(x=0.0, y=0.0, method="nearest")
        assert 1e9 * float(centre) == pytest.approx(result.central_film_nm)
        assert 1e-9 * float(data["pressure"].max()) == pytest.approx(result.max_pressure_GPa)


def test_the_configuration_runs_again_to_the_same_films(film, tmp_path):
    directory, result = film
    config = load_config(directory / "configuration.toml")
    again = run(config, tmp_path, MPI.COMM_SELF, speak=False)
    assert again.central_film_nm == pytest.approx(result.central_film_nm, rel=1e-12)
    assert again.minimum_film_nm == pytest.approx(result.minimum_film_nm, rel=1e-12)


def test_contact(tmp_path):
    result = run_quietly(DRY, tmp_path)
    assert result.converged
    assert result.contact.area_fraction == pytest.approx(1.0, abs=0.05)
    assert result.contact.largest_gap_nm < 1e-3
    assert result.pressure_inequality.violations == 0
    with xarray.open_dataset(tmp_path / "fields.h5", engine="h5netcdf") as data:
        contact = data["status"].values == CONTACT
    assert np.count_nonzero(contact) == result.contact.nodes
    line = np.flatnonzero(contact[32]) + 1
    assert (line[0], line[-1]) == result.contact.x_nodes
    column = np.flatnonzero(contact[:, np.abs(np.linspace(-1.9, 1.3, 65)).argmin()]) + 1
    assert (column[0], column[-1]) == result.contact.y_nodes


def test_a_run_that_does_not_converge_still_leaves_everything(tmp_path):
    result = run_quietly({**FILM, "solver": {"max_steps": 1}}, tmp_path)
    assert not result.converged
    assert {path.name for path in tmp_path.iterdir()} == FILES
    read = read_json(tmp_path)
    assert read["converged"] is False and "1 steps" in read["reason"]


def test_it_says_what_it_does_and_whether_to_trust_it(tmp_path, capsys):
    run(config_from_tables(FILM), tmp_path, MPI.COMM_SELF)
    out = capsys.readouterr().out
    assert "grid    65" in out
    assert "\nCONVERGED" in out
    assert str(tmp_path) in out.splitlines()[-1]


def test_a_quiet_one_says_nothing(film, tmp_path, capsys):
    run_quietly({**FILM, "solver": {"max_steps": 1}}, tmp_path)
    assert capsys.readouterr().out == ""


def test_moes_numbers_give_the_reference_film(tmp_path):
    """references.md: M = 20, L = 10, 2B, 65 nodes."""
    tables = {
        "moes": {"M": 20, "L": 10},
        "lubricant": {"density_law": "constant"},
        "grid": {"nodes": 65, "x": [-4.5, 1.5], "y": [-3.0, 3.0]},
        "discretization": {"couette": "2B"},
    }
    result = run_quietly(tables, tmp_path)
    assert result.converged
    assert result.moes_film.central == pytest.approx(4.65234, rel=1e-4)
    assert result.moes_film.minimum == pytest.approx(2.88452, rel=1e-4)
