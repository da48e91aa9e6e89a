"""A light load on oil: its film is the same on domains of any size, for what is carried beyond counts."""

import pytest
from contacts import moes, solved

from mgehl.model.room import interval_on_nodes
from mgehl.studies.study import merged


@pytest.fixture(scope="module")
def central_film():
    """The central film in nm of M = 3, L = 2 on a domain that ends so far upstream; equal cells."""

    def found(end, **grid):
        x, y = interval_on_nodes(end, end / 8.0), (-end / 2.0, end / 2.0)
        tables = {"grid": {"nodes": int(4 * end) + 1, "x": x, "y": y, **grid}, "solver": {"error": False}}
        solution = solved(moes(3.0, 2.0), tables)
        assert solution.result.converged
        return solution.result.central_film_nm

    return found


def test_three_domains_have_one_film(central_film):
    """A quarter, an eighth, a sixteenth of the load is carried beyond; the film answers to its square."""
    small, larger, largest = (central_film(end) for end in (16.0, 32.0, 64.0))
    assert small == pytest.approx(largest, rel=0.004)
    assert larger == pytest.approx(largest, rel=0.002)


def test_a_domain_that_carries_all_of_the_load_has_less_film_the_smaller_it_is(central_film):
    small, larger = (central_film(end, load_beyond=False) for end in (16.0, 32.0))
    counted = central_film(32.0)
    assert small < 0.9 * larger < 0.8 * counted


def test_the_answer_says_how_much_is_carried_beyond():
    tables = merged(moes(3.0, 2.0), {"grid": {"nodes": 65}, "solver": {"error": False}})
    result = solved(tables).result
    assert 10.0 < result.resolution.load_beyond_percent < 30.0
    part = f"{result.resolution.load_beyond_percent:.1f} %"
    assert f"load: {part} of it is carried beyond the domain" in str(result)


@pytest.mark.parametrize("nodes", [65, 129])
def test_a_contact_thirty_times_as_wide_as_long_ends_within_its_domain(nodes):
    """Its pressure near the sides is below a hundredth of the largest."""
    wide = moes(10.0, 5.0, radius_x=5e-3, radius_y=0.15)
    result = solved(wide, {"grid": {"nodes": nodes}}).result
    assert result.converged and result.edge.pressure_ratio < 0.01


RIGID = 35.54
"""H_Moes M^2 of a rigid ball in thin oil, on a plane without end: the film of 8.88 um of 10 mm, 0.1 N, 0.05
Pa s and 0.5 m/s."""


@pytest.mark.parametrize(
    "M, L, film, nodes",
    [(0.2, 1.0, RIGID / 0.04, 65), (0.8, 0.3, RIGID / 0.64, 65), (3.0, 2.0, 4.313, 65),
     (6.0, 0.5, 1.951, 65), (7.5, 10.0, 4.737, 129)],
)  # fmt: skip
def test_light_films_are_those_of_another_code_on_a_domain_that_loses_nothing(M, L, film, nodes):
    """Central differences on nodes that are stretched to 3000 sqrt(2 R h), to the limit of fine grids.

    From rigid to elastic bodies, from thin oil to stiff.
    """
    result = solved(moes(M, L), {"grid": {"nodes": nodes}}).result
    assert result.converged and result.resolution.verdict == "resolved" and result.error.central_nm
    assert result.moes_film.central == pytest.approx(film, rel=0.01)
