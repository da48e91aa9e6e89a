"""The Python interface."""

import subprocess
import sys

import numpy as np
import pytest
from mpi4py import MPI

import mgehl
from mgehl.discretization.status import CONTACT, LUBRICATED

FILM = {"grid.nodes": 65, "motion.speed": "1 m/s", "solver.start": "film"}


@pytest.fixture(scope="module")
def film():
    return mgehl.solve(mgehl.load(None, FILM), MPI.COMM_SELF)


class TestLoad:
    def test_a_mapping_and_words_say_the_same(self):
        words = ["grid.nodes=65", "motion.speed=1 m/s", "solver.start=film"]
        assert mgehl.load(settings=words) == mgehl.load(settings=FILM)

    def test_the_file_is_read_and_overridden(self, tmp_path):
        path = tmp_path / "my.toml"
        path.write_text('[contact]\nload = "250 N"\n[grid]\nnodes = 129\n')
        config = mgehl.load(path, {"grid.nodes": 257})
        assert (config.contact.load, config.grid.nodes) == (250.0, 257)

    @pytest.mark.parametrize("name", ["nodes", "grid.", ".nodes", ""])
    def test_a_name_without_section_or_key_is_a_mistake(self, name):
        with pytest.raises(mgehl.ConfigError, match="section.key"):
            mgehl.load(settings={name: 65})

    def test_values_may_be_of_numpy(self):
        with pytest.raises(mgehl.ConfigError, match=r"grid\.nodes"):
            mgehl.load(settings={"grid.nodes": np.array([65])})


class TestSolution:
    def test_fields_are_those_of_the_summary(self, film):
        assert film.summary.converged
        j, i = 32, int(np.argmin(np.abs(film.x)))
        assert 1e9 * film.film[j, i] == pytest.approx(film.summary.central_film_nm, rel=1e-12)
        assert 1e9 * film.film.min() == pytest.approx(film.summary.minimum_film_nm, rel=1e-12)
        assert 1e-9 * film.pressure.max() == pytest.approx(film.summary.max_pressure_GPa, rel=1e-12)
        assert film.film.shape == film.pressure.shape == film.status.shape == (65, 65)
        assert (len(film.y), len(film.x)) == (65, 65)

    def test_pressure_balances_the_load(self, film):
        cell = (film.x[1] - film.x[0]) * (film.y[1] - film.y[0])
        assert film.pressure.sum() * cell == pytest.approx(800.0, rel=1e-7)

    def test_local_fields_of_one_rank_are_the_whole(self, film):
        np.testing.assert_array_equal(film.local.H, film.fields.H)
        assert film.first_line == 0

    def test_printed_it_says_whether_to_trust_it(self, film):
        assert str(film).startswith("CONVERGED")

    def test_a_solution_is_a_start_for_another_speed(self, film):
        slower = mgehl.load(None, FILM | {"motion.speed": "0.8 m/s"})
        again = mgehl.solve(slower, MPI.COMM_SELF, start=film)
        cold = mgehl.solve(slower, MPI.COMM_SELF)
        assert again.summary.converged
        assert again.summary.central_film_nm == pytest.approx(cold.summary.central_film_nm, rel=1e-6)
        assert again.summary.central_film_nm < film.summary.central_film_nm

    def test_contact_is_a_status(self):
        dry = mgehl.solve(mgehl.load(None, {"grid.nodes": 65}), MPI.COMM_SELF)
        assert (dry.status == CONTACT).sum() == dry.summary.contact.nodes > 1000
        assert dry.film[dry.status == LUBRICATED].min() > 0.0


def test_impossible_contacts_are_one_line():
    config = mgehl.load(None, {"contact.load": "1e8 N", "grid.nodes": 65})
    with pytest.raises(mgehl.ConfigError) as caught:
        mgehl.solve(config, MPI.COMM_SELF)
    assert "\n" not in str(caught.value)


def test_importing_does_not_wake_petsc():
    """PETSc takes the options of the command line, which are read after the import."""
    code = "import sys, mgehl; sys.exit('petsc4py.PETSc' in sys.modules or 'matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0
