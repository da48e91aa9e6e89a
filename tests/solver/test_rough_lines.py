"""Line contacts of rough bodies: no oil flows around a peak."""

from dataclasses import replace

import numpy as np
import pytest
from contacts import solved
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.grid.hierarchy import Hierarchy
from mgehl.kinds import case_of, contact_from
from mgehl.solver import beginning, recipe
from mgehl.solver.beginning import NOR, begin, begin_thick
from mgehl.solver.from_config import set_up
from mgehl.solver.gaps import gaps
from mgehl.solver.nested import nested_iteration
from mgehl.solver.outcome import Outcome
from mgehl.solver.problem import ContactProblem, State
from mgehl.solver.recipe import DRY, THICK_FILM, UNDER_FILM
from mgehl.solver.task import Task

ROLLER = {
    "contact": {"kind": "line", "radius_x": 18.5e-3, "reduced_modulus": 226e9, "load_per_length": 847e3,
                "boundary_film": 5e-9},
    "lubricant": {"viscosity": 0.0236, "pressure_viscosity": 16.7e-9},
    "motion": {"speed": 0.05},
    "surface": {"kind": "waviness", "amplitude": 200e-9, "wavelength_x": 44e-6},
    "grid": {"nodes": 257, "x": [-2.0, 1.5]},
    "solver": {"error": False},
}  # fmt: skip
"""Ridges across the motion, 1.3 GPa, lambda 0.3."""


def test_a_last_digit_of_the_pressures_changes_the_residual_by_what_rounding_may():
    """Flows answer to differences of pressures through gaps of 200 nm."""
    solution = solved(ROLLER)
    parts = set_up(case_of(solution.config))
    hierarchy = Hierarchy(parts.mesh, 33, parts.contact.kernel, MPI.COMM_SELF)
    problem = ContactProblem(
        hierarchy.grids[-1], hierarchy.deflections[-1], parts.contact, parts.settings.scheme
    )
    fields, signs = solution.fields, np.random.default_rng(1).choice([-1.0, 1.0], solution.fields.P.shape)
    state = State(fields.P, 0.0, fields.H, fields.status, fields.p, fields.filling)
    evaluation = problem.evaluate(state)
    moved = replace(state, p=state.p * (1.0 + np.finfo(float).eps * signs))
    change = problem.residual(problem.evaluate(moved), state.status)
    change -= problem.residual(evaluation, state.status)
    assert 0.1 < problem.rms(change) / problem.rounding(evaluation, state.status) < 1.0
    hierarchy.destroy()


def test_above_the_largest_direct_solve_the_grids_of_the_cycle_lead_to_the_same(monkeypatch):
    at_once = solved(ROLLER).result
    monkeypatch.setattr(recipe, "DIRECT", 65)
    solution = solved(ROLLER)
    result, rows = solution.result, solution.rows
    assert result.converged and max(row["linear_iterations"] for row in rows) > 1
    assert result.mixed.mean_gap_nm == pytest.approx(at_once.mixed.mean_gap_nm, rel=1e-5)


def test_the_recipe_begins_in_the_way_that_led_to_the_answer(monkeypatch):
    """The first way, or one of those that are tried where it fails."""
    ways = [solved(ROLLER).result.recipe["begins"]]
    solve, not_tried = beginning.nested_iteration, (None, Outcome(None, False, "not tried"))
    speed, failing = contact_from(config_from_tables(ROLLER)).speed, ["film"]

    def unless_failing(task):
        at_once = task.contact.speed == speed
        return not_tried if at_once and task.settings.start in failing else solve(task)

    monkeypatch.setattr(beginning, "nested_iteration", unless_failing)
    ways.append(solved(ROLLER).result.recipe["begins"])
    failing.append(DRY)
    ways.append(solved(ROLLER).result.recipe["begins"])
    assert ways == [UNDER_FILM, DRY, THICK_FILM]


class TestFromAThickFilm:
    @pytest.fixture
    def task(self, in_the_end):
        config = config_from_tables(ROLLER)
        parts = set_up(case_of(config))
        hierarchy = in_the_end(Hierarchy.destroy, parts.hierarchy(MPI.COMM_SELF))
        return Task(hierarchy, contact_from(config), parts.settings)

    def test_all_ways_lead_to_the_same_answer(self, task):
        ways = begin_thick, begin, lambda task: nested_iteration(task.but(start=DRY))
        found = [way(task) for way in ways]
        means = [gaps(problem, outcome.state.P, outcome.state.H)[0] for problem, outcome in found]
        assert means == pytest.approx(3 * means[:1], rel=1e-6)

    def test_where_both_fail_the_state_is_of_the_contact_s_own_speed(self, task):
        problem, outcome = begin(task.limited(max_steps=2))
        assert not outcome.converged and problem.contact.speed == task.contact.speed
        assert f"after 2 steps{NOR} the dry contact without oil: " in outcome.reason
        assert f"after 2 steps{NOR} a thick film: a stage on the way" in outcome.reason


def test_a_film_over_ridges_in_stiff_oil_is_found_in_a_few_steps():
    """Pressures of 6 p_h fall to a tenth within a cell. Steps that are linear in P led to less than nothing
    there, and 172 of them to an answer."""
    tables = {
        "contact": {"kind": "line", "radius_x": 0.01, "reduced_modulus": 226e9, "load_per_length": 1e5},
        "lubricant": {"viscosity": 0.05, "pressure_viscosity": 20e-9},
        "motion": {"speed": 0.5, "slide_to_roll": 2.0},
        "friction": {"model": "limiting", "limiting_coefficient": 0.05},
        "surface": {"kind": "waviness", "amplitude": 2e-7, "wavelength_x": 5e-5},
        "grid": {"nodes": 1025, "x": [-4.0, 2.0]},
        "solver": {"error": False, "max_steps": 40},
    }
    result = solved(tables).result
    assert result.converged and result.contact.nodes == 0 and result.max_pressure_GPa > 3.0
