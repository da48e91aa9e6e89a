"""How well a grid resolves the inlet, and which one does."""

import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.resolution import expectation, resolution, resolving_nodes


def film(nodes=257):
    return load_config(settings={"grid.nodes": nodes, "motion.speed": 0.0075, "solver.start": "film"})


def test_the_recommended_grid_is_the_first_that_resolves():
    config = film()
    contact = contact_from(config)
    nodes = resolving_nodes(contact, mesh_from(config, contact))
    fine, coarse = film(nodes=nodes), film(nodes=(nodes + 1) // 2)
    verdicts = [
        resolution(contact_from(each), mesh_from(each, contact_from(each))).verdict
        for each in (fine, coarse)
    ]
    assert verdicts == ["resolved", "coarse"]


@pytest.mark.parametrize(
    "cells, begins_closed, words",
    [
        (4.0, False, "resolves"),
        (2.0, True, "changes with the grid"),
        (1.0, False, "side by side"),
        (0.5, False, "side by side"),
        (0.5, True, "full contact"),
    ],
)
def test_what_is_expected_follows_from_cells_and_start(cells, begins_closed, words):
    assert words in expectation(cells, begins_closed)


@pytest.mark.parametrize("cells, begins_closed", [(0.5, False), (0.5, True), (5.0, False)])
def test_where_peaks_reach_through_the_film_the_grid_does_not_decide(cells, begins_closed):
    words = expectation(cells, begins_closed, is_mixed=True)
    assert "peaks" in words and "grid" not in words
