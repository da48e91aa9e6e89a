"""Eq. 2 at the interface of contacts whose answer is known, grid by grid.

The dry contact of a ball, solved on each grid, carries what a fluid of one pressure around it leaves of the
load: its own pressure is then that of the fluid plus the dry one, on rough balls, too.
"""

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.model.surface.waviness import Waviness
from mgehl.solver.dry import carrying_pressure, solve_dry
from mgehl.solver.inequality import check_interface, check_pressure_inequality
from mgehl.solver.problem import State

NODES = (65, 129, 257)
PRESSURES = (0.01, 0.1, 0.5, 2.0)
"""Of the fluid, in p_h."""


@pytest.fixture
def dry(make_problem, paper_contact):
    """Function: problem and dry state of a ball on so many nodes a side, smooth or with waves of 500 nm."""

    def solved(nodes, is_wavy=False):
        waves = Waviness(5e-7, 2e-4, 2e-4) if is_wavy else None
        problem = make_problem(paper_contact(speed=0.0, surface=waves), nodes=nodes)
        guess = carrying_pressure(problem, problem.contact.guessed_pressure(problem.grid.X, problem.grid.Y))
        outcome = solve_dry(problem, guess, 1e-8, 60, lambda step: None)
        assert outcome.converged
        return problem, outcome.state

    return solved


def in_fluid(problem, dry, of_fluid, of_contact):
    """A dry state with this pressure in the gap around it, and that much more in contact."""
    pressed = dry.P > 0.0
    status = np.where(problem.boundary, BOUNDARY, np.where(pressed, CONTACT, LUBRICATED)).astype(np.int8)
    return State(np.where(pressed, dry.P + of_contact, of_fluid), dry.H0, dry.H, status)


@pytest.mark.parametrize("is_wavy", [False, True], ids=["smooth", "wavy"])
@pytest.mark.parametrize("nodes", NODES)
def test_a_ball_inside_fluid_of_one_pressure_breaks_nothing(dry, nodes, is_wavy):
    """At any grid: p0 + Hertz of the rest, p0 + the dry contact of rough bodies."""
    problem, state = dry(nodes, is_wavy)
    for pressure in PRESSURES:
        whole = in_fluid(problem, state, pressure, pressure)
        found = check_interface(problem, whole)
        assert found.checked > nodes / 2 and found.violations == 0


def held_closed(dry, p0):
    """Parts of the rim that are found, grid by grid, where fluid of a pressure would open a contact."""
    for nodes in NODES:
        problem, state = dry(nodes)
        found = check_interface(problem, in_fluid(problem, state, p0, 0.0))
        assert found.worst <= p0
        yield found.violations / found.checked


@pytest.mark.parametrize("p0, least", [(0.5, 0.7), (2.0, 1.0)])
def test_a_contact_held_closed_by_force_is_found_on_every_grid(dry, p0, least):
    shares = list(held_closed(dry, p0))
    assert min(shares) >= least and shares[-1] == 1.0


def test_the_finer_the_grid_the_weaker_the_force_that_is_found(dry):
    """Pressure rises as the root of the distance from the rim: a first node has as much as this fluid."""
    shares = list(held_closed(dry, 0.1))
    assert shares[0] == 0.0 and 0.0 < shares[1] < shares[2]


@pytest.mark.parametrize("nodes", NODES)
def test_a_pressure_that_falls_through_a_contact_breaks_nothing(dry, nodes):
    """Fluid of .4 p_h before a ball and none behind it, contact's pressure between them: no jump anywhere.

    At the nodes the same state breaks Eq. 2 wherever the pressure falls out of the fluid into contact.
    """
    problem, state = dry(nodes)
    falling = 0.4 * np.broadcast_to(1.0 / (1.0 + np.exp(4.0 * problem.grid.X)), state.P.shape)
    status = in_fluid(problem, state, 0.0, 0.0).status
    falls = State(falling, state.H0, state.H, status)
    assert check_interface(problem, falls).violations == 0
    assert check_pressure_inequality(problem, falls).violations
