from dataclasses import replace
from types import SimpleNamespace

import pytest
from contacts import solved
from made_solution import make_result

from mgehl.discretization.contact_law import BoundaryFilm, UnifiedEquations
from mgehl.discretization.scheme import Scheme
from mgehl.output.film_error import from_grids, why_no_band, why_no_band_by
from mgehl.output.resolution import Resolution
from mgehl.output.result import ContactResult, Overlap
from mgehl.solver.films import GridFilm
from mgehl.solver.verification import Edge
from mgehl.studies.study import papers_grid

FILM = {"motion": {"speed": 1.0}, "grid": papers_grid(65), "discretization": {"couette": "2B"}}
NO_CONTACT = ContactResult(0, 0.0, 0.0, None, None, 0.0)

SMOOTH = SimpleNamespace(is_mixed=False)


def result_of(**changes):
    """That of a film's configuration with other keys."""
    film = FILM | ({"grid": {}} if "contact" in changes else {})
    tables = {name: film.get(name, {}) | changes.get(name, {}) for name in film | changes}
    return solved(tables).result


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


def test_the_smallest_film_in_the_middle_has_one_band():
    """Of a light load: it is the central film, and had another."""
    same = make_result(central_film_nm=40.0, minimum_film_nm=40.0, contact=NO_CONTACT)
    found = from_grids(same, grids(10.0, 10.4), 2)
    assert found.central_nm == found.minimum_nm > 10.0


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
            ({"resolution": Resolution(5.0, "resolved", surface="grid-determined", surface_nodes=2.5)},
             "waves that the grid does not show"),
        ],
    )  # fmt: skip
    def test_otherwise_it_is_said_why_not(self, film, changes, word):
        assert word in why_no_band(replace(film, **changes), SMOOTH)

    @pytest.mark.parametrize(
        "scheme, word",
        [
            (Scheme("2C"), "by 2C films alternate"),
            (Scheme("3B", contact_law=UnifiedEquations(0.011)), "thinner than discretization.unified_gap"),
            (Scheme("3B", contact_law=UnifiedEquations(0.009)), ""),
            (Scheme("3B", contact_law=BoundaryFilm(0.011)), ""),
        ],
    )
    def test_nor_by_a_scheme_that_alternates_or_a_gap_that_makes_the_film(self, film, scheme, word):
        """Of 10 nm, where a unit of H has a micrometre."""
        problem = SimpleNamespace(scheme=scheme, contact=SimpleNamespace(film_scale=1e-6))
        found = why_no_band_by(problem, film)
        assert word in found and bool(word) == bool(found)

    def test_where_the_next_grid_has_no_answer_there_is_none(self, film):
        error = from_grids(film, grids(10.0, 8.0, settled=False), 2)
        assert error.central_nm is None and error.minimum_nm is None and "65 nodes" in error.how


class TestOfRuns:
    @pytest.mark.parametrize(
        "couette, mean", [("1B", "arithmetic"), ("2B", "arithmetic"), ("3B", "logarithmic")]
    )
    def test_the_band_holds_the_limit_and_is_no_wall(self, couette, mean):
        """1 m/s: 378.1 and 136.3 nm. On 129 nodes."""
        how = {"couette": couette, "face_mobility": mean}
        result = result_of(grid={"nodes": 129}, discretization=how)
        off = abs(result.central_film_nm - 378.1), abs(result.minimum_film_nm - 136.3)
        assert off[0] <= result.error.central_nm < 3.0 * off[0]
        assert off[1] <= result.error.minimum_nm < 100.0
        assert [each.nodes for each in result.error.grids] == [129, 65, 33]
        assert result.error.convolutions < 0.35 * result.work.convolutions

    def test_solid_contact_has_none(self):
        result = result_of(motion={"speed": 5e-6}, solver={"start": "contact"})
        assert result.converged and "solid contact" in result.error.how
        assert result.error.convolutions == 0.0

    def test_a_line_contact_has_one(self):
        line = {"contact": {"kind": "line"}, "motion": {"speed": 0.5}}
        error = result_of(**line, grid={"nodes": 257, "x": [-1.9, 1.3]}).error
        assert error.central_order == pytest.approx(2.0, abs=0.2)
