from dataclasses import replace

import numpy as np
import pytest
from contacts import moes

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.kinds import contact_from
from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, ConstantDensity, Lubricant
from mgehl.model.rheology import Eyring, Friction
from mgehl.solver.gaps import gaps, gaps_of, load_differences, loads
from mgehl.studies.study import merged


def test_the_mean_is_that_of_the_nodes_within_the_ellipse_or_a_line_s_width():
    """13 of 25 nodes, four of them on the ellipse, and by their pressure."""
    distance = np.hypot.outer(np.arange(-2, 3), np.arange(-2, 3))
    H = np.where(distance < 2.0, 2.0, np.where(distance == 2.0, 15.0, 9.0))
    P = np.zeros((5, 5))
    P[2, 2], P[0, 2], P[0, 0] = 3.0, 1.0, 7.0
    found = gaps_of(Mesh(5, 5, (-1.0, 1.0), (-1.0, 1.0)), P, H)
    assert found == ((9 * 2.0 + 4 * 15.0) / 13, (3.0 * 2.0 + 15.0) / 4.0)
    line = Mesh(5, 1, (-2.0, 2.0), (-2.0, 2.0))
    assert gaps_of(line, np.ones((1, 5)), np.array([[9.0, 1.0, 2.0, 3.0, 9.0]]))[0] == 2.0


@pytest.mark.parametrize("share, reach", [(1.0, 1.0), (8.0, 2.0), (0.125, 0.5)])
def test_an_instant_has_the_load_and_the_ellipse_of_its_own(make_problem, paper_contact, share, reach):
    """Of another load than the contact's: axes grow with its third root, a part of it is of that load."""
    problem = make_problem(paper_contact(1.0), nodes=65, scheme=Scheme())
    mesh, contact = problem.grid.mesh, problem.contact
    problem.turn_to(contact, contact.under(share))
    P = np.where(problem.boundary, 0.0, 1.0)
    state = problem.state(P, 0.5, np.where(problem.boundary, BOUNDARY, CONTACT))
    assert loads(problem, state).contact == pytest.approx(problem.load(P) / (share * contact.load_integral))
    hertz = problem.hertz
    assert (hertz.reach, hertz.area) == pytest.approx((reach, reach**2 * contact.contact_area))
    inside = np.hypot(mesh.X[None, :], mesh.Y[:, None]) <= hertz.reach
    assert gaps(problem, P, state.H)[0] == pytest.approx(state.H[inside].mean(), rel=1e-12)


def test_an_instant_slides_and_loses_load_beyond_the_domain_as_fast_as_it_moves(make_problem):
    """Load carried beyond the domain was that of the first load and the largest speed, and shear did not
    thin the oil where the speed changes."""
    tables = merged(moes(3.0, 2.0), {"grid": {"nodes": 65}})
    contact = contact_from(config_from_tables(tables))
    contact = replace(contact, friction=Friction(Eyring(5e6), 0.5, thins=True))
    problem = make_problem(contact, nodes=65, scheme=Scheme())
    nothing = np.zeros(problem.grid.shape)
    beyond = contact.share_beyond(*contact.ends(problem.grid.mesh))
    assert -problem.load_deficit(nothing) == pytest.approx((1.0 - beyond) * contact.load_integral)
    assert beyond > 0.01
    for there in (contact.under(30.0), contact.at_speed(0.0)):  # pressed flat, and at rest: all is within
        problem.turn_to(contact, there)
        share = there.load / contact.load
        assert -problem.load_deficit(nothing) == pytest.approx(share * contact.load_integral)
        slower = there.speed / contact.speed
        assert problem.flowing.thinning == pytest.approx(slower * contact.thinning)


def test_a_line_grows_with_the_root_of_its_load():
    lubricant = Lubricant(Barus(0.1, 2e-8), ConstantDensity())
    contact = LineContact(1e5, 0.01, 2e11, 1.0, lubricant)
    hertz = contact.hertz_under(4.0)
    assert (hertz.reach, hertz.area, hertz.integral) == pytest.approx((2.0, 4.0, 2.0 * np.pi))
    assert contact.hertz_under(1.0).contact is contact


@pytest.mark.parametrize("height, crest", [(2.9, 0.95), (1.5, 0.025)])
def test_a_spike_counts_where_it_may_be_the_largest(make_problem, paper_contact, height, crest):
    """A node that stands out of 1, beside a paraboloid that bends by .025 in a cell and is 4 high."""
    problem = make_problem(paper_contact(1.0), nodes=17, scheme=Scheme())
    i, j = np.arange(17.0)[None, :], np.arange(17.0)[:, None]
    P = np.maximum(4.0 - 0.05 * ((i - 6.0) ** 2 + (j - 6.0) ** 2), 1.0)
    P[14, 14] = height
    status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    assert loads(problem, problem.state(P, 0.5, status, P)).crest == pytest.approx(crest)


def test_loads_and_their_differences_from_a_finer_grid_s(make_problem, paper_contact):
    """Two nodes of contact on either grid, one of them common; solids carry half of it."""
    problem = make_problem(paper_contact(1.0), nodes=9, scheme=Scheme())
    mesh, contact = problem.grid.mesh, problem.contact
    P = np.where(problem.boundary, 0.0, 1.0)
    P[4, 4] = 4.0
    status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    finer = status.copy()
    status[4, [4, 5]], finer[4, [4, 3]] = CONTACT, CONTACT
    p = np.where(status == CONTACT, 0.5 * P, P)
    state = problem.state(P, 0.5, status, p)
    cell = mesh.dX * mesh.dY / contact.load_integral
    found = loads(problem, state)
    assert found.crest == 0.125 * 2 * (8.0 - 2 * 1.0)
    assert (found.largest, found.contact, found.solids) == pytest.approx((4.0, 5 * cell, 2.5 * cell))
    apart = load_differences(problem, state, P + 0.25, np.where(finer == CONTACT, 0.5 * P, P), finer)
    assert apart.largest == pytest.approx(0.25)
    assert apart.contact == pytest.approx((0.25 + 1.0 + 1.25) * cell)
    assert apart.solids == pytest.approx((0.25 + 0.5 + 0.75) * cell)
