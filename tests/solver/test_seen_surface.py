"""Coarse grids see a surface without the waves that they cannot show; the finest one sees all of it."""

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.model.surface import Surface, Waviness
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import SolverSettings
from mgehl.solver.task import Task

A = 0.4108333e-3
FINEST = Mesh(129, 129, (-1.9, 1.3), (-1.5, 1.5))
MESHES = [FINEST.coarsened().coarsened(), FINEST.coarsened(), FINEST]
CELL = 3.2 / 128 * A


class Waves(Surface):
    """The same waves as `Waviness`, of which nothing is known."""

    def height(self, x, y):
        return 2e-8 * np.cos(2 * np.pi * np.asarray(x) / (6.0 * CELL)) + 0.0 * np.asarray(y)


def test_each_grid_sees_what_it_can_show(paper_contact):
    """Waves of six finest cells: three of the next grid, one and a half of the one below."""
    contact = paper_contact(surface=Waviness(2e-8, 6.0 * CELL, None))
    assert contact.seen_by(FINEST, FINEST) is contact
    for mesh in MESHES[:2]:
        assert contact.seen_by(mesh, FINEST).roughness == 0.0
    long = paper_contact(surface=Waviness(2e-8, 16.0 * CELL, None))
    assert all(long.seen_by(mesh, FINEST) is long for mesh in MESHES)
    smooth = paper_contact()
    assert smooth.seen_by(MESHES[0], FINEST) is smooth


def test_what_is_not_known_wave_by_wave_is_smoothed(paper_contact):
    contact = paper_contact(surface=Waves())
    for mesh, left in zip(MESHES[:2], (0.01, 0.3), strict=True):
        x, y = mesh.X[None, :] * A, mesh.Y[:, None] * A
        heights = contact.seen_by(mesh, FINEST).surface.height(x, y)
        assert heights.shape == (mesh.ny, mesh.nx)
        assert np.abs(heights[4:-4, 4:-4]).max() < left * 2e-8


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
