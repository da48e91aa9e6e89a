"""Shear and rolling of states whose integrals are known.

Hertz's circle with a film of one thickness and Barus' law [derived, A = alpha p_h, B = eta_0 V/(h tau_0)]:
Newtonian F = (eta_0 V/h) pi a^2 2 [(A - 1) e^A + 1]/A^2, by Eyring's law
F = 2 pi a^2 tau_0 int_0^1 s asinh(B e^(A s)) ds.
"""

from dataclasses import replace
from math import exp, pi

import numpy as np
import pytest
from contacts import moes, solved
from scipy.integrate import quad

from mgehl.discretization.contact_law import BoundaryFilm, UnifiedEquations
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.hertz import hertz_pressure
from mgehl.model.rheology import Eyring, Friction, Limiting
from mgehl.model.scene import Moved
from mgehl.model.surface.waviness import Waviness
from mgehl.solver.problem import ContactProblem, Problem, State
from mgehl.solver.shear import film_shear, shear_of, solid_shear

SPEED, FILM, STRESS = 0.5, 100e-9, 5e6
SLIDING = 0.1
"""m/s: with `SPEED` a slide-to-roll of .2."""

MU_EYRING, MU_LIMITED = 0.080229, 0.049921
"""Of the paper's contact, by the integrals above."""

WAVES = Waviness(50e-9, 80e-6, 120e-6)
CLOSING = Scheme()
"""Contact closes its faces."""


@pytest.fixture
def make_problem(make_grid):
    def make(contact, nodes=65, scheme=CLOSING):
        mesh = Mesh(nodes, nodes, (-1.5, 1.5), (-1.5, 1.5), contact.k_e)
        return Problem(make_grid(mesh), contact, scheme)

    return make


def sliding(paper_contact, friction, **changes):
    return paper_contact(SPEED, friction=replace(friction, slide_to_roll=SLIDING / SPEED), **changes)


def uniform_film(problem, H=None):
    """Hertz's pressure and a film of one thickness within its circle, none beyond."""
    grid, contact = problem.grid, problem.contact
    P = np.array(np.broadcast_to(hertz_pressure(grid.X, grid.Y), grid.shape))
    status = np.where(P > 0.0, LUBRICATED, BOUNDARY).astype(np.int8)
    H = FILM / contact.film_scale if H is None else H
    return State(P, 0.0, np.full(grid.shape, H), status)


def test_newtonian_friction_of_a_uniform_film(paper_contact, make_problem):
    problem = make_problem(sliding(paper_contact, Friction()), 257)
    contact, A = problem.contact, 18.2e-9 * problem.contact.hertz.p_h
    exact = 0.096 * SLIDING / FILM * pi * contact.hertz.a**2 * 2.0 * ((A - 1.0) * exp(A) + 1.0) / A**2
    assert shear_of(problem, uniform_film(problem)).film_force == pytest.approx(exact, rel=1e-4)


def test_eyring_friction_of_a_uniform_film(paper_contact, make_problem):
    problem = make_problem(sliding(paper_contact, Friction(Eyring(STRESS))), 257)
    contact, A, B = problem.contact, 18.2e-9 * problem.contact.hertz.p_h, 0.096 * SLIDING / FILM / STRESS
    integral = quad(lambda s: s * np.arcsinh(B * np.exp(A * s)), 0.0, 1.0, epsabs=1e-12)[0]
    exact = 2.0 * pi * contact.hertz.a**2 * STRESS * integral / contact.load
    assert exact == pytest.approx(MU_EYRING, abs=5e-7)
    assert shear_of(problem, uniform_film(problem)).film_force / 800.0 == pytest.approx(exact, rel=1e-4)


def test_limited_friction_of_a_uniform_film(paper_contact, make_problem):
    problem = make_problem(sliding(paper_contact, Friction(Limiting(0.05, Eyring(STRESS)))), 257)
    found = shear_of(problem, uniform_film(problem)).film_force / 800.0
    assert found == pytest.approx(MU_LIMITED, rel=1e-4)


def test_a_rigid_slider_without_pressure_is_exact(paper_contact, make_problem):
    """The integral of eta V/h over nodes: of one gap it is eta V/h times their area, to rounding."""
    problem = make_problem(sliding(paper_contact, Friction()))
    state = uniform_film(problem)
    state.P[:], state.p[:], state.status[:] = 0.0, 0.0, LUBRICATED
    area = state.P.size * problem.grid.mesh.dX**2 * problem.contact.hertz.a**2
    found = shear_of(problem, state)
    assert found.film_force == pytest.approx(0.096 * SLIDING / FILM * area, rel=1e-13)
    assert found.rolling_force == 0.0


def test_a_cavity_resists_as_far_as_it_is_filled(paper_contact, make_problem):
    problem = make_problem(sliding(paper_contact, Friction()))
    state = uniform_film(problem)
    state.status[30, 30], state.p[30, 30], state.filling[30, 30] = CAVITATED, 0.0, 0.25
    assert film_shear(problem, state)[30, 30] == pytest.approx(0.25 * 0.096 * SLIDING / FILM)


@pytest.mark.parametrize("law, carried", [(CLOSING.contact_law, 0.8), (BoundaryFilm(1e-6), 0.3)])
def test_solids_resist_by_what_they_carry(paper_contact, make_problem, law, carried):
    """P where contact closes its faces, P - p where the fluid in it has a pressure of its own."""
    sliding_contact = sliding(paper_contact, Friction(boundary_coefficient=0.1))
    problem = make_problem(sliding_contact, 65, Scheme(contact_law=law))
    state = uniform_film(problem)
    state.status[30, 30], state.P[30, 30], state.p[30, 30], state.H[30, 30] = CONTACT, 0.8, 0.5, 0.0
    stress = solid_shear(problem, state)
    assert stress[30, 30] == pytest.approx(0.1 * carried * problem.contact.hertz.p_h)
    assert np.count_nonzero(stress) == 1


def test_oil_in_layers_resists_as_their_film_by_the_part_that_it_carries(paper_contact, make_problem):
    """All of it where contact opens; where contact closes its faces there is none. No oil resists by more
    than the limit's part of its own pressure."""
    friction, layers = (
        Friction(Limiting(0.05, Eyring(STRESS)), boundary_coefficient=0.1),
        BoundaryFilm(1e-6),
    )
    found = []
    for law, p in ((layers, 0.5), (layers, 0.8), (CLOSING.contact_law, 0.5)):
        problem = make_problem(sliding(paper_contact, friction), 65, Scheme(contact_law=law))
        state = uniform_film(problem)
        state.status[30, 30], state.P[30, 30], state.p[30, 30] = CONTACT, 0.8, p
        state.H[30, 30] = law.contact_gap
        found.append(film_shear(problem, state)[30, 30] / problem.contact.hertz.p_h)
    assert found == pytest.approx([0.05 * 0.5, 0.05 * 0.8, 0.0])


def test_bodies_that_overlap_resist_as_solids(paper_contact, make_problem):
    law = UnifiedEquations()
    problem = make_problem(sliding(paper_contact, Friction()), 65, Scheme(contact_law=law))
    state = uniform_film(problem)
    state.H[30, 30] = -0.1
    stress = solid_shear(problem, state)
    assert stress[30, 30] == pytest.approx(0.1 * state.P[30, 30] * problem.contact.hertz.p_h)
    assert np.count_nonzero(stress) == 1


@pytest.mark.parametrize("waves, slip", [(None, 0), (Moved(WAVES, (2e-5, 0.0), 2), 0.3), (WAVES, 2)])
def test_rolling_of_a_full_film_is_the_load_upstream(paper_contact, make_hierarchy, waves, slip):
    """int h dp/dx = -int p dh/dx, int p d(K p)/dx = 0: int p x/R is left. Heights take no more of both."""
    contact = paper_contact(SPEED, surface=waves, friction=Friction(slide_to_roll=slip))
    hierarchy = make_hierarchy(contact, 65)
    grid = hierarchy.grids[-1]
    problem = ContactProblem(grid, hierarchy.deflections[-1], contact, Scheme())
    P = np.array(hertz_pressure(1.05 * grid.X + 0.04, grid.Y + 0.1 * grid.X))
    state = problem.state(P, 0.5, np.full(grid.shape, LUBRICATED))
    moment = grid.mesh.dX * grid.mesh.dY * float((state.P * grid.X).sum()) * contact.hertz.p_h
    exact = -0.5 * moment * contact.hertz.a**3 / contact.radius_x
    found = shear_of(problem, state)
    assert found.rolling_force == pytest.approx(exact, rel=1e-11)
    assert (found.rolling[0] == pytest.approx(exact, rel=1e-11)) == (waves is None)


def film_of(speed, **changes):
    tables = {"contact": {"load": 100.0}, "motion": {"speed": speed}, "grid": {"nodes": 65}}
    return solved(tables, {"solver": {"start": "film", "error": False}}, changes).summary


def test_shear_thins_a_film_by_newton_s_own_steps():
    """The same film where the Eyring stress is large, a thinner one in about as many steps where not."""
    slides, eyring = {"slide_to_roll": 2.0}, {"model": "eyring", "eyring_stress": 1e9}
    thick, stiff = film_of(0.5), film_of(0.5, motion=slides, friction=eyring)
    assert stiff.central_film_nm == pytest.approx(thick.central_film_nm, rel=1e-3)
    thin = film_of(0.5, motion=slides, friction=eyring | {"eyring_stress": 2e6})
    assert thin.converged and thin.work.steps <= thick.work.steps + 5
    assert 0.6 < thin.central_film_nm / thick.central_film_nm < 0.9


def test_a_film_that_is_thinned_severalfold_has_fewer_cells_in_its_inlet_and_tells_both_films():
    """By a formula's film they were 4.8, "resolved", where the film was a third off a finer grid's."""
    slides, eyring = {"slide_to_roll": 2.0}, {"model": "eyring", "eyring_stress": 1e5}
    plain = film_of(2.0)
    thin = film_of(2.0, motion=slides, friction=eyring, solver={"start": "film", "error": True})
    share = thin.central_film_nm / plain.central_film_nm
    assert share < 0.3 and thin.friction.unthinned_film_nm == pytest.approx(plain.central_film_nm, rel=1e-5)
    cells = [each.resolution.inlet_cells for each in (thin, plain)]
    assert cells[0] / cells[1] == pytest.approx(share ** (2 / 3), rel=0.15)


def test_a_film_along_y_is_thinned_as_one_along_x():
    slides = {"slide_to_roll": 1.0}
    eyring = {"model": "eyring", "eyring_stress": 2e6}
    ways = (slides | {"angle": angle} for angle in (0.0, 90.0))
    along_x, along_y = (film_of(0.5, motion=way, friction=eyring) for way in ways)
    assert along_y.central_film_nm == pytest.approx(along_x.central_film_nm, rel=1e-12)
    assert along_y.friction.coefficient == pytest.approx(along_x.friction.coefficient, rel=1e-12)


def test_rolling_within_and_beyond_the_domain_does_not_depend_on_the_domain():
    """Within it half as much again on twice the domain; both together change by less than 2 %."""
    found = []
    for end, nodes in ((5.0, 65), (10.0, 129)):
        grid = {"nodes": nodes, "x": [-end, 2.0], "y": [-end, end]}
        found.append(solved(moes(8.0, 8.0), {"grid": grid, "solver": {"error": False}}).summary.friction)
    near, far = found
    assert far.rolling_coefficient > 1.4 * near.rolling_coefficient
    both = [each.rolling_coefficient + each.rolling_beyond for each in found]
    assert both[1] == pytest.approx(both[0], rel=0.02)
