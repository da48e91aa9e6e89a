import json
from dataclasses import asdict

import numpy as np
import pytest
import xarray
from mpi4py import MPI
from places import CONFIGS, RUN_FILES, names_in
from told import rows_of

from mgehl.cli import main
from mgehl.config import config_from_tables, load_config
from mgehl.discretization.status import CONTACT
from mgehl.run import run, solve
from mgehl.studies.study import PAPERS_DOMAIN, papers_grid

FILM = {"motion": {"speed": "1 m/s"}, "grid": papers_grid(65)}

RESULT_KEYS = {
    "converged", "reason", "central_film_nm", "minimum_film_nm", "max_pressure_GPa", "residual",
    "load_error", "complementarity_error", "flux_imbalance", "contact", "overlap", "pressure_inequality",
    "cavitated_nodes", "resolution", "groups", "moes_film", "formulas", "work", "wall_s", "ranks",
    "versions", "edge",
}  # fmt: skip


def run_quietly(tables, directory):
    return run(config_from_tables(tables), directory, MPI.COMM_SELF)


def read_json(directory):
    return json.loads((directory / "result.json").read_text())


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    directory = tmp_path_factory.mktemp("film")
    return directory, run_quietly(FILM, directory)


def test_the_result_file_is_the_result(film):
    directory, result = film
    read = read_json(directory)
    assert RESULT_KEYS <= read.keys()
    assert read.pop("inputs")["motion.speed"] > 0.0
    whole = json.loads(json.dumps(asdict(result)))
    absent = whole.keys() - read.keys()  # parts of other kinds of contact
    assert read == {name: whole[name] for name in read} and all(whole[name] is None for name in absent)
    assert all(read["versions"].get(name) for name in ("mgehl", "petsc", "numpy", "mpi4py"))
    assert read["work"]["convolutions"] > 0.0 and read["wall_s"] > 0.0


def test_the_history_ends_with_the_result(film):
    directory, result = film
    rows = rows_of(directory / "history.csv")
    last = rows[-1]
    assert float(last["residual"]) == result.residual
    assert float(last["central_film_nm"]) == result.central_film_nm
    assert float(last["minimum_film_nm"]) == result.minimum_film_nm
    assert sum(1 for row in rows if int(row["step"]) > 0) == result.work.steps
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


def test_a_run_that_does_not_converge_still_leaves_everything(tmp_path):
    result = run_quietly({**FILM, "solver": {"max_steps": 1}}, tmp_path)
    assert not result.converged
    assert names_in(tmp_path) == RUN_FILES
    read = read_json(tmp_path)
    assert read["converged"] is False and "1 steps" in read["reason"]


KINDS = {
    "point": (FILM, (65, 65)),
    "line": ({"contact": {"kind": "line"}, "motion": {"speed": 0.3},
              "grid": {"nodes": 257, "x": PAPERS_DOMAIN["x"]}}, (1, 257)),
    "wedge": ({"contact": {"kind": "wedge"}, "grid": {"nodes": 65}}, (65, 65)),
    "relaxed point": (FILM | {"solver": {"method": "relaxation"}, "relaxation": {"max_sweeps": 5}},
                      (65, 65)),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_solving_writes_nothing_and_returns_the_solution(kind, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tables, shape = KINDS[kind]
    config = config_from_tables(tables)
    solution = solve(config, MPI.COMM_SELF)
    assert solution.result.converged == (kind != "relaxed point")
    assert solution.config is config
    assert (solution.mesh.ny, solution.mesh.nx) == shape
    assert all(array.shape == shape for array in solution.fields.named.values())
    assert solution.rows and all(row.keys() == solution.rows[0].keys() for row in solution.rows)
    assert capsys.readouterr().out == "" and not list(tmp_path.iterdir())


WEDGES = ("wedge_blocked_exit", "wedge_open", "wedge_square_pillar", "wedge_cylindrical_pillar")


@pytest.mark.parametrize("name", WEDGES)
def test_wedge_of_the_repository(name, tmp_path):
    here = tmp_path / "here"
    assert main(["run", str(CONFIGS / f"{name}.toml"), "--quiet", "--out", str(here)]) == 0
    assert names_in(here) == RUN_FILES | {"centerline.csv"}
    read = read_json(here)
    assert read["converged"] is True and read["residual"] <= 1e-10 and read["closed_face_flow"] == 0.0
    # p dx dy in newtons, P dX dY in mm: eta u/(m^2 mm) mm^2 of 0.096 Pa s, 1 m/s and a slope of 1e-3.
    assert read["load_N"] == pytest.approx(96.0 * read["load"], rel=1e-12)
    assert (read["solid_nodes"] > 0) == (name != "wedge_open")
    with xarray.open_dataset(here / "fields.h5", engine="h5netcdf") as data:
        assert data["P"].shape == (129, 129)
        assert float(data["P"].max()) == read["max_P"] and float(data["P"].min()) == read["min_P"]
        assert np.count_nonzero(data["status"] == CONTACT) == read["solid_nodes"]
        # The first node lies half a cell outside of the pad.
        x = data["x"].values
        assert x[0] < 20e-3 < x[1] and x[-1] == pytest.approx(50e-3)
        np.testing.assert_allclose(data["film"][0, 1:-1], 1e-3 * x[1:-1], rtol=1e-12)
        cell = float(data["X"][1] - data["X"][0]) * float(data["Y"][1] - data["Y"][0])
        assert cell * float(data["P"].sum()) == pytest.approx(read["load"], rel=1e-12)
        middle = data["P"].sel(y=0.0, method="nearest").values
    rows = rows_of(here / "centerline.csv")
    X, P = ([float(row[key]) for row in rows] for key in ("X_mm", "P"))
    # From edge to edge of the pad; the node outside of a blocked exit is no part of it.
    blocked = name == "wedge_blocked_exit"
    assert len(rows) == 129 - blocked
    assert X[-1] == 50.0 and (X[0] > 20.0 if blocked else X[0] == 20.0)
    solid = np.isnan(P)
    assert solid.any() == ("pillar" in name)
    np.testing.assert_array_equal(np.array(P)[~solid], middle[int(blocked) :][~solid])
    assert not middle[int(blocked) :][solid].any()
    assert load_config(here / "configuration.toml") == load_config(CONFIGS / f"{name}.toml")


def test_pocket_of_the_repository(tmp_path):
    """One line of nodes from the inlet to half a cell beyond the exit, with its own density law."""
    here = tmp_path / "here"
    assert main(["run", str(CONFIGS / "pocket.toml"), "--quiet", "--out", str(here)]) == 0
    assert names_in(here) == RUN_FILES | {"centerline.csv", "laws"}
    read = read_json(here)
    assert read["converged"] is True and read["mass"]["largest_node"] < 1e-8 * read["mass"]["enters"]
    assert read["max_pressure_MPa"] == pytest.approx(41.898, rel=1e-3)
    assert read["cavitated_nodes"] > 100 and read["torn_filling"] == pytest.approx(0.74, abs=0.01)
    with xarray.open_dataset(here / "fields.h5", engine="h5netcdf") as data:
        assert data["P"].shape == (1, 2049)
        pressure, x = data["pressure"][0].values, data["x"].values
        assert pressure[0] == pytest.approx(1e5) and pressure[-1] == pytest.approx(1e5)
        # Of a pad of 10 mm: what is above the ambient pressure.
        load = 10e-3 * float(x[1] - x[0]) * (pressure - 1e5).sum()
        assert load == pytest.approx(read["load_N"], rel=1e-12)
        assert float(data["filling"].max()) == 1.0 and float(data["filling"].min()) > 0.7
    X = [float(row["X_mm"]) for row in rows_of(here / "centerline.csv")]
    assert (X[0], X[-1]) == (0.0, 20.0)
    assert load_config(here / "configuration.toml").wedge == load_config(CONFIGS / "pocket.toml").wedge


@pytest.mark.parametrize(
    "grid, start, said",
    [({"x": [-20, 1.01], "y": [-1.5, 1.5]}, "contact", "the bodies overlap at 13 nodes"),
     ({"x": [-1.9, 1.3], "y": [-1.01, 30]}, "contact", "the bodies overlap at 15 nodes"),
     ({"x": [-1.9, 1.3], "y": [-1.01, 1.5]}, "film", "near the domain's boundary is 12 %"),
     ({"x": [-60, 60], "y": [-1.5, 1.5]}, "contact", "1 nodes wide along x"),
     ({"x": [-20, 20], "y": [-20, 20]}, "contact", "3 nodes wide along x")],
)  # fmt: skip
def test_in_a_domain_that_cuts_the_contact_it_is_not_converged(grid, start, said):
    speed = 1.0 if start == "film" else 5e-6
    tables = {"grid": {"nodes": 65} | grid, "motion": {"speed": speed}}
    tables["solver"] = {"start": start, "error": False}
    result = solve(config_from_tables(tables), MPI.COMM_SELF).result
    assert result.settled and not result.converged
    assert said in result.reason
