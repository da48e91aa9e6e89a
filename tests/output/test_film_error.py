"""Bands about the films of runs: when there are any, and of what."""

from dataclasses import replace
from math import hypot
from types import SimpleNamespace

import pytest
from mpi4py import MPI
from test_files import make_result

from mgehl.config import config_from_tables
from mgehl.output.film_error import from_grids, why_no_band
from mgehl.output.resolution import Resolution
from mgehl.output.result import ContactResult, Overlap
from mgehl.run import solve
from mgehl.solver.films import GridFilm
from mgehl.solver.richardson import SAFETY, SPREADS_OF_TWO, UNSEEN, UNSEEN_UNLIKE, WIDER
from mgehl.solver.verification import Edge
from mgehl.studies.study import papers_grid

FILM = {"motion": {"speed": 1.0}, "grid": papers_grid(65), "discretization": {"couette": "2B"}}
NO_CONTACT = ContactResult(0, 0.0, 0.0, None, None, 0.0)


class SMOOTH:
    """A contact's surface."""

    is_mixed = False


def solved(**changes):
    """The result of a film's configuration."""
    film = FILM | ({"grid": {}} if "contact" in changes else {})
    tables = {name: film.get(name, {}) | changes.get(name, {}) for name in film | changes}
    return solve(config_from_tables(tables), MPI.COMM_SELF).result


def grids(*films, contact=0, settled=True):
    """Films of grids from 129 nodes down, central four times the minimum; `contact` on the second.

    They differ by 12 nm around the centre, by 0.9 nm more or less around the smallest gap.
    """
    return tuple(
        GridFilm(128 // 2**k + 1, 4.0 * film, film, contact if k == 1 else 0, settled or k != 1, 12.0, 0.9)
        for k, film in enumerate(films)
    )


@pytest.fixture
def film():
    """A result of a film of nodes, 40 and 10 nm."""
    return make_result(central_film_nm=40.0, minimum_film_nm=10.0, contact=NO_CONTACT)


class TestWhetherThereIsOne:
    def test_of_a_film_there_is_but_not_on_a_rough_surface(self, film):
        assert why_no_band(film, SMOOTH) == ""
        assert "rough surface says little" in why_no_band(film, SimpleNamespace(is_mixed=True))

    @pytest.mark.parametrize(
        "changes, word",
        [
            ({"settled": False}, "not settled"),
            ({"contact": replace(NO_CONTACT, nodes=3)}, "solid contact"),
            ({"overlap": Overlap(2, 0.1)}, "overlap"),
            ({"edge": Edge(0.2, 0, 0.0, 41, 43)}, "the domain cuts the contact"),
            ({"resolution": Resolution(0.7, "grid-determined")}, "less than a cell"),
            (
                {"resolution": Resolution(5.0, "resolved", surface="grid-determined", surface_nodes=2.5)},
                "waves that the grid does not show",
            ),
        ],
    )
    def test_otherwise_it_is_said_why_not(self, film, changes, word):
        assert word in why_no_band(replace(film, **changes), SMOOTH)

    def test_where_the_next_grid_has_no_answer_there_is_none(self, film):
        error = from_grids(film, grids(10.0, 8.0, settled=False), 2)
        assert error.central_nm is None and error.minimum_nm is None and "65 nodes" in error.how


class TestHowWideItIs:
    def test_two_grids(self, film):
        error = from_grids(film, grids(10.0, 7.0), 2)
        assert error.central_nm == pytest.approx(hypot(1.0, UNSEEN) * 4.0)
        assert error.minimum_nm == pytest.approx(hypot(1.0 + SAFETY, SPREADS_OF_TWO * 0.3))
        assert error.central_order is None and error.order == 2 and "65 nodes" in error.how

    def test_contact_on_the_next_grid_makes_it_wider_and_is_said(self, film):
        error = from_grids(film, grids(10.0, 7.0, contact=4), 2)
        assert (
            error.central_nm == pytest.approx(hypot(1.0, UNSEEN_UNLIKE) * 4.0)
            and "touches at 4" in error.how
        )
        assert error.minimum_nm == pytest.approx(hypot(1.0 + SAFETY, WIDER * SPREADS_OF_TWO * 0.3))

    def test_so_does_an_inlet_that_has_less_than_a_cell_there(self, film):
        coarse = replace(film, resolution=Resolution(1.5, "coarse"))
        assert "on 65 nodes the inlet has less than a cell" in from_grids(coarse, grids(10.0, 7.0), 2).how
        assert "wider" not in from_grids(film, grids(10.0, 7.0), 2).how


class TestOfRuns:
    @pytest.mark.parametrize(
        "couette, mean", [("1B", "arithmetic"), ("2B", "arithmetic"), ("3B", "logarithmic")]
    )
    def test_the_band_holds_the_limit_and_is_no_wall(self, couette, mean):
        """1 m/s: 378.1 and 136.3 nm. On 129 nodes."""
        how = {"couette": couette, "face_mobility": mean}
        result = solved(grid={"nodes": 129}, discretization=how)
        off = abs(result.central_film_nm - 378.1), abs(result.minimum_film_nm - 136.3)
        assert off[0] <= result.error.central_nm < 3.0 * off[0]
        assert off[1] <= result.error.minimum_nm < 100.0
        assert [each.nodes for each in result.error.grids] == [129, 65, 33]
        assert result.error.convolutions < 0.35 * result.work.convolutions

    def test_solid_contact_has_none(self):
        dry = {"motion": {"speed": 5e-6}, "solver": {"start": "contact"}}
        result = solved(**dry)
        assert result.converged and "solid contact" in result.error.how
        assert result.error.convolutions == 0.0

    def test_a_line_contact_has_one(self):
        line = {
            "contact": {"kind": "line"},
            "motion": {"speed": 0.5},
            "grid": {"nodes": 257, "x": [-1.9, 1.3]},
        }
        error = solved(**line).error
        assert error.central_order == pytest.approx(2.0, abs=0.2)
