"""Films that are squeezed out between rigid bodies by a load that stays, exact by Reynolds' equation.

h = h_i exp(-F t/(6 pi eta R^2)) of a sphere; 1/sqrt(h) = 1/sqrt(h_i) + F' t/(6 sqrt2 pi eta R^(3/2)) of a
cylinder.
"""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.grid.hierarchy import Hierarchy
from mgehl.model.course import Constant
from mgehl.model.line import LineContact
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
"""Of a sphere, per s."""

F_LINE = 1.0
RATE_LINE = F_LINE / (6.0 * np.sqrt(2.0) * np.pi * ETA * R**1.5)
"""Of a cylinder under this load in N/m: that of 1/sqrt(h)."""

OIL = Lubricant(Barus(ETA, 1e-10), ConstantDensity())


def sphere(counted=None):
    """The contact, and the largest pressure with which its film begins. Whether the load that is squeezed
    out beyond the domain is `counted`."""
    return PointContact(F, R, R, 1e12, 1e-3, OIL, load_beyond=counted), F / (2.0 * np.pi * R * FILM)


def cylinder():
    return LineContact(F_LINE, R, 1e12, 1e-3, OIL), F_LINE / (0.5 * np.pi * np.sqrt(2.0 * R * FILM))


def films(contact, largest, mesh, end, steps=40):
    """(time, minimum film) in SI units over a run in time of `end` s, in even `steps` or in its own."""
    hierarchy = Hierarchy(mesh, 33, contact.kernel, MPI.COMM_SELF)
    law = BoundaryFilm(1e-11 / contact.film_scale)
    scheme = Scheme(face_mobility="linear-gap", contact_law=law)
    recipe = recipe_in_time(SolverSettings(scheme=scheme), contact)
    problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, recipe.scheme)
    scene = Scene(contact, Constant(0.0), Constant(contact.load), (), end, Constant(0.0))
    grid, found = problem.grid, []
    r2 = (grid.X**2 + (0.0 if mesh.is_line else grid.Y**2)) * contact.x_scale**2
    P = largest / contact.pressure_scale / (1.0 + r2 / (2.0 * R * FILM)) ** 2
    P = np.broadcast_to(P, grid.shape).copy()
    state = problem.state(P, FILM / contact.film_scale, np.full(grid.shape, LUBRICATED))
    settings = TimeSettings(end / steps if steps else None, 1e-4, 1e-8)

    def told(instant, standing, _problem):
        found.append((instant.t, instant.newton.cycles[-1].minimum * contact.film_scale))
        return ""

    try:
        with newton_on(hierarchy, problem, recipe) as newton:
            outcome = March(scene, problem, newton, settings, told).run(state)
    finally:
        hierarchy.destroy()
    assert outcome.converged, outcome.reason
    return np.array(found)[5:].T


def half_width(contact, wide):
    return wide * np.sqrt(2.0 * R * FILM) / contact.x_scale


def rate_of_a_sphere(wide, counted, nodes=65, end=0.5):
    """At which the film falls, in a run in which it falls to e^(-end), over the exact one."""
    contact, largest = sphere(counted)
    half = half_width(contact, wide)
    mesh = Mesh(nodes, nodes, (-half, half), (-half, half))
    t, h = films(contact, largest, mesh, end / RATE)
    return -np.polyfit(t, np.log(h), 1)[0] / RATE


def rate_of_a_cylinder(wide, steps, nodes=257, end=0.3):
    """The same, of 1/sqrt(h): it rises by the part `end`."""
    contact, largest = cylinder()
    half = half_width(contact, wide)
    mesh, end = Mesh(nodes, 1, (-half, half), (0.0, 0.0)), end / RATE_LINE / FILM**0.5
    t, h = films(contact, largest, mesh, end, steps)
    return np.polyfit(t, h**-0.5, 1)[0] / RATE_LINE


def test_a_sphere_in_its_domain_alone():
    """The load beyond the domain falls with the square of its width: what two widths lead to is exact."""
    narrow, wide = (rate_of_a_sphere(each, counted=False) for each in (7.0, 14.0))
    assert narrow > 1.02 and (4.0 * wide - narrow) / 3.0 == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("wide", [3.5, 7.0])
def test_a_sphere_whose_oil_is_squeezed_out_beyond_its_domain(wide):
    """The load there is counted: a tenth of it, and 3 %."""
    assert rate_of_a_sphere(wide, counted=None) == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("steps, part", [(40, 1e-3), (None, 1.2e-3)])
def test_a_cylinder(steps, part):
    """The load beyond the domain falls with the cube of its width."""
    assert rate_of_a_cylinder(14.0, steps) == pytest.approx(1.0, abs=part)
