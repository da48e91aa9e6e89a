from dataclasses import replace

import contacts
import numpy as np
import pytest
from mpi4py import MPI
from places import ROUGH

import mgehl
from mgehl.config import load_config
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.kinds import case_of
from mgehl.output.result import Making, Work
from mgehl.output.summary import summarise
from mgehl.solver.beginning import begin
from mgehl.solver.from_config import set_up
from mgehl.solver.mass import CLOSED, mass_account
from mgehl.solver.task import Task

TOLERANCE = 1e-8


@pytest.fixture(scope="module")
def solved():
    """Problem and outcome of the rough ball on 65 nodes: film, cavities that feed it, and contact."""
    parts = set_up(case_of(load_config(ROUGH, {"grid.nodes": 65, "solver.error": False})))
    hierarchy = parts.hierarchy(MPI.COMM_SELF)
    yield begin(Task(hierarchy, parts.contact, parts.settings))
    hierarchy.destroy()


def copy_of(solved):
    problem, outcome = solved
    return problem, replace(outcome, state=outcome.state.copy())


def account(problem, state):
    return mass_account(problem, state, problem.evaluate(state))


def verdict(problem, outcome):
    return summarise(problem, outcome, TOLERANCE, Making(Work(1.0, 1), 1.0, {}))


def test_what_flows_in_counts_from_whatever_side_it_comes():
    """Motion along Y is that along X, turned."""
    film = {"grid.nodes": 65, "motion.speed": 1.0, "solver.start": "film", "solver.error": False}
    turned = {"motion.angle": 90.0, "grid.x": (-1.5, 1.5), "grid.y": (-1.9, 1.3)}
    along, across = (mgehl.solve(mgehl.load(settings=film | more)).result for more in ({}, turned))
    assert along.mass.carried_in > 2.0 * along.mass.enters > 0.0
    assert across.mass.carried_in == pytest.approx(along.mass.carried_in, rel=1e-6)


def test_a_solved_state_makes_no_oil(solved):
    problem, outcome = solved
    mass = account(problem, outcome.state)
    assert mass.enters == pytest.approx(mass.leaves, rel=1e-7) and mass.enters > 0.0
    assert mass.made_share < 1e-8 and mass.largest_node < 1e-8 * mass.enters
    assert verdict(problem, outcome).converged


def test_what_enters_and_leaves_is_what_nodes_within_make(solved):
    """Whatever the state: the account of the ellipse is the sum of the nodes' own."""
    problem, outcome = copy_of(solved)
    rng, state = np.random.default_rng(3), outcome.state
    state.p *= rng.uniform(0.9, 1.1, state.p.shape)
    evaluation, mesh = problem.evaluate(state), problem.grid.mesh
    mass = mass_account(problem, state, evaluation)
    X, Y = np.meshgrid(mesh.X, mesh.Y)
    unit = problem.contact.speed * problem.contact.film_scale * problem.contact.y_scale
    within = evaluation.inflow[X**2 + Y**2 <= 1.0].sum() * unit * mesh.dX * mesh.dY
    assert mass.enters - mass.leaves == pytest.approx(within, rel=1e-9)


def spoiled_filling(state, problem):
    """A cavity passes on more than it gets; the next one, which passes on less, makes up for it."""
    node = problem.feeding(state.status) & (state.filling > 0.1) & (state.filling < 0.8)
    node[:, :-1] &= (state.status == CAVITATED)[:, 1:]
    state.filling[tuple(np.argwhere(node)[0])] += 0.1
    return "largest_node"


def spoiled_leak(state, _):
    """The fluid under a patch is pressed less than it was."""
    node = (state.status == CONTACT) & (state.p < state.P)
    state.p[node] *= 0.5
    return "made_by_contact"


@pytest.mark.parametrize("spoil", [spoiled_filling, spoiled_leak])
def test_oil_that_is_made_is_found_and_told(solved, spoil):
    problem, outcome = copy_of(solved)
    kind = spoil(outcome.state, problem)
    mass = account(problem, outcome.state)
    assert mass.made_share > CLOSED and abs(getattr(mass, kind)) > CLOSED * mass.enters
    result = verdict(problem, outcome)
    assert not result.converged
    if result.settled:
        assert "oil" in result.reason


@pytest.mark.parametrize("sides", ["open", "closed"])
def test_a_parallel_pad_takes_in_what_the_plate_drags(sides):
    """The half cells along open sides were left out: a 64th of the oil on 65 nodes."""
    pad = {
        "contact": {"kind": "wedge"},
        "wedge": {"length": 20e-3, "inlet_film": 10e-6, "exit_film": 10e-6, "width": 10e-3, "sides": sides},
        "motion": {"speed": 2.0},
    }
    mass = contacts.solved(pad, {"grid": {"nodes": 65}}).result.mass
    assert mass.enters == pytest.approx(0.5 * 2.0 * 10e-6 * 10e-3, rel=1e-9)
    assert mass.leaves == pytest.approx(mass.enters, rel=1e-9)


def test_what_passes_a_side_beyond_a_pocket_counts_too():
    """A pocket over the whole width lets oil in and out through both sides."""
    pad = {
        "contact": {"kind": "wedge"},
        "wedge": {"length": 20e-3, "inlet_film": 10e-6, "exit_film": 10e-6, "width": 10e-3,
                  "pocket_depth": 1e-4, "pocket_from": 5e-3, "pocket_to": 15e-3, "pocket_width": 10e-3},
        "motion": {"speed": 2.0},
    }  # fmt: skip
    coarse, fine = (contacts.solved(pad, {"grid": {"nodes": n}}).result.mass for n in (65, 129))
    assert coarse.enters == pytest.approx(fine.enters, rel=2e-3)
