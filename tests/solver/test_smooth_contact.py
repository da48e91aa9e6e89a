"""Smooth bodies whose film the grid hardly sees: contact closes continuously but by the paper's mean."""

import pytest
from contacts import solved

from mgehl.config import config_from_tables
from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions
from mgehl.kinds import case_of
from mgehl.output.advice import beside_bands
from mgehl.solver.from_config import set_up
from mgehl.solver.recipe_words import NAMES


def law(**tables):
    return set_up(case_of(config_from_tables(tables))).settings.scheme.contact_law


def test_the_paper_s_mean_alone_shuts_the_faces_of_contact():
    """It lets half of a node's flow through to a closed neighbour; that of every other mean vanishes."""
    arithmetic = {"face_mobility": "arithmetic"}
    assert isinstance(law(discretization=arithmetic), InterfaceConditions)
    assert isinstance(law(discretization=arithmetic, contact={"boundary_film": 1e-9}), BoundaryFilm)
    assert isinstance(law(discretization=arithmetic, time={"end": 1e-3}), BoundaryFilm)
    for mean in ("linear-gap", "logarithmic", "geometric", "harmonic"):
        assert isinstance(law(discretization={"face_mobility": mean}), BoundaryFilm)


@pytest.mark.parametrize("speed", [15e-3, 1e-3])
def test_both_starts_find_one_film_that_conserves_oil(speed):
    """0.3 and 0.06 cells in the inlet on 65 nodes."""
    tables = {"motion": {"speed": speed}, "grid": {"nodes": 65}}
    films = []
    for start in ("film", "contact"):
        solver = {"start": start, "error": False}
        result = solved(tables | {"solver": solver}).result
        assert result.converged and result.mass.made_share < 1e-7
        films.append((result.central_film_nm, result.minimum_film_nm))
    assert films[0] == pytest.approx(films[1], rel=1e-5)


def test_shut_faces_hold_on_one_side_alone_and_the_other_start_finds_it():
    """At 1 m/s contact tears, and from a film there is an answer; at 2 mm/s it is the other way."""
    paper = {"face_mobility": "arithmetic", "couette": "1B", "film_threshold": 0.02e-9}
    tables = {"discretization": paper, "grid": {"nodes": 65, "x": (-1.9, 1.3), "y": (-1.5, 1.5)}}
    for speed, start, begins in ((1.0, "contact", "film"), (2e-3, "film", "contact")):
        solution = solved(tables | {"motion": {"speed": speed}, "solver": {"start": start, "error": False}})
        assert solution.result.converged and solution.result.recipe["begins"] == begins
        assert (solution.result.central_film_nm > 100.0) == (begins == "film")
        told = f"start: from {NAMES[start]} there was no answer; this one is from {NAMES[begins]}"
        assert told in list(beside_bands(solution))
