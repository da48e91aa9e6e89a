"""Coarse grids see a surface without the waves that they cannot show; the finest one sees all of it."""

import numpy as np
import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.model.surface import Surface, Waviness
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import SolverSettings
from mgehl.solver.task import Task

A = 0.4108333e-3
CELL = 3.2 / 128 * A


class Waves(Surface):
    """The same waves as `Waviness`, of which nothing is known."""

    def height(self, x, y):
        return 2e-8 * np.cos(2 * np.pi * np.asarray(x) / (6.0 * CELL)) + 0.0 * np.asarray(y)


@pytest.mark.parametrize("surface", [Waviness(2e-8, 6.0 * CELL, None), Waves()], ids=["known", "unknown"])
def test_the_finest_grid_s_film_is_one_whatever_coarse_ones_see(paper_contact, make_hierarchy, surface):
    """From coarse grids and from the finest alone: the same film of the same surface."""
    contact = paper_contact(1.0, surface=surface)
    films = []
    for first_nodes in (33, 129):
        settings = SolverSettings(scheme=Scheme("3B", "linear-gap"), first_nodes=first_nodes)
        problem, outcome = nested_iteration(Task(make_hierarchy(contact, 129), contact, settings))
        assert outcome.converged and problem.contact.surface == surface
        films.append(outcome.state.H)
    np.testing.assert_allclose(*films, rtol=1e-6)
