"""A film that is squeezed out between rigid bodies: exact, h = h_i exp(-F t/(6 pi eta R^2)) of a sphere."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.grid.hierarchy import Hierarchy
from mgehl.model.course import Constant
from mgehl.model.lubricant import Barus, ConstantDensity, Lubricant
from mgehl.model.point import PointContact
from mgehl.model.scene import Scene
from mgehl.solver.march import March
from mgehl.solver.on_grid import newton_on
from mgehl.solver.problem import ContactProblem
from mgehl.solver.recipe import recipe_in_time
from mgehl.solver.settings import SolverSettings, TimeSettings

R, F, ETA, FILM = 12.5e-3, 1e-3, 0.25, 1e-6
RATE = F / (6.0 * np.pi * ETA * R**2)


def measured(wide, nodes=65, end=0.5):
    """The rate at which the film falls, by runs in time in which it falls to e^(-end), over the exact one.

    The domain is `wide` times sqrt(2 R h) on each side.
    """
    lubricant = Lubricant(Barus(ETA, 1e-10), ConstantDensity())
    contact = PointContact(F, R, R, 1e12, 1e-3, lubricant, load_beyond=False)
    half = wide * np.sqrt(2.0 * R * FILM) / contact.x_scale
    hierarchy = Hierarchy(
        Mesh(nodes, nodes, (-half, half), (-half, half)), 33, contact.kernel, MPI.COMM_SELF
    )
    law = BoundaryFilm(1e-11 / contact.film_scale)
    scheme = Scheme(face_mobility="linear-gap", contact_law=law)
    recipe, level = recipe_in_time(SolverSettings(scheme=scheme), contact), len(hierarchy.grids) - 1
    problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, recipe.scheme)
    scene = Scene(contact, Constant(0.0), Constant(F), (), end / RATE)
    grid, films = problem.grid, []
    r2 = (grid.X**2 + grid.Y**2) * contact.x_scale**2
    P = F / (2.0 * np.pi * R * FILM) / (1.0 + r2 / (2.0 * R * FILM)) ** 2 / contact.pressure_scale
    state = problem.state(P, FILM / contact.film_scale, np.full(grid.shape, LUBRICATED))
    settings = TimeSettings(end / RATE / 40.0, 1e-4, 1e-8)

    def told(instant, standing, _problem):
        films.append((instant.t, instant.newton.cycles[-1].minimum))
        return ""

    try:
        with newton_on(hierarchy, level, problem, recipe) as newton:
            outcome = March(scene, problem, newton, settings, told).run(state)
    finally:
        hierarchy.destroy()
    assert outcome.converged, outcome.reason
    t, h = np.array(films)[5:].T
    return -np.polyfit(t, np.log(h), 1)[0] / RATE


def test_a_sphere():
    """The load beyond the domain falls with the square of its width: what two widths lead to is exact."""
    assert (4.0 * measured(14.0) - measured(7.0)) / 3.0 == pytest.approx(1.0, abs=1e-3)
