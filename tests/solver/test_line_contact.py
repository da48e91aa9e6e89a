from functools import cache

import numpy as np
import pytest
from contacts import solved

from mgehl.discretization.axes import own
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.model.hertz import hertz_pressure
from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.solver.inequality import check_pressure_inequality
from mgehl.solver.verification import closed_face_flow, complementarity_error

LINE = {"ny": 1, "x": (-2.5, 1.5), "y": (0.0, 0.0)}


@cache
def film(nodes, couette="1B"):
    """The contact of configs/line_contact.toml: 2.26 GPa at 0.1 m/s."""
    tables = {
        "contact": {"kind": "line", "load_per_length": 1859e3},
        "motion": {"speed": 0.1},
        "grid": {"nodes": nodes, "x": [-2.5, 1.5]},
        "discretization": {"couette": couette, "face_mobility": "arithmetic"},
    }
    return solved(tables)


def line_contact(speed):
    lubricant = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())
    return LineContact(1859e3, 12.7e-3, 219.78e9, speed, lubricant)


@pytest.mark.parametrize("couette", sorted(SCHEMES))
def test_full_film_converges(couette):
    result = film(1025, couette).result
    assert result.converged
    assert result.residual <= 1e-8 and abs(result.load_error) <= 1e-8
    assert result.contact.nodes == 0 and result.overlap.nodes == 0
    assert result.contact.y_nodes is None


def test_film_against_the_formula():
    """At 2.26 GPa the central film is 23 % below the formula, which knows no compression (the density
    at p_h alone is 1.28); the minimum within 1 %."""
    result = film(4097).result
    formulas = result.formulas
    assert result.central_film_nm / formulas["dowson_higginson_central_nm"] == pytest.approx(0.77, abs=0.01)
    assert result.minimum_film_nm / formulas["dowson_higginson_minimum_nm"] == pytest.approx(1.0, abs=0.01)
    assert result.minimum_film_nm < result.central_film_nm


@pytest.mark.parametrize("nodes", [257, 1025])
def test_dry_limit(solve, nodes):
    """At 1 nm/s the cylinder carries the load as if it were dry; sqrt(1 - X^2) is steep at its edge."""
    solution = solve(line_contact(1e-9), nodes, start="contact", **LINE)
    assert solution.outcome.converged
    grid, state = solution.problem.grid, solution.outcome.state
    X = grid.mesh.X
    inside = np.abs(X) < 0.98
    np.testing.assert_allclose(state.P[0, inside], hertz_pressure(X, 0.0)[inside], rtol=0.0, atol=1e-3)
    np.testing.assert_array_equal((state.status == CONTACT)[0], np.abs(X) <= 1.0)
    assert grid.mesh.dX * state.P.sum() == pytest.approx(np.pi / 2.0, rel=1e-7)


# From a contact that hardly feels the fluid (p_f/p_d of 0.003) to one that is almost pried open (0.3).
@pytest.mark.parametrize("speed", [1e-4, 7.5e-3])
class TestBlockedInlet:
    @pytest.fixture
    def blocked(self, solve, speed):
        solution = solve(line_contact(speed), 257, start="contact", newton={"tolerance": 1e-10}, **LINE)
        assert solution.outcome.converged
        return solution.problem, solution.outcome.state

    def test_fluid_pressure_stays_below_contact_pressure(self, blocked):
        """[Liu eq. 25]: p_f <= p_d on both sides of the interface."""
        problem, state = blocked
        inequality = check_pressure_inequality(problem, state)
        assert inequality.violations == 0 and inequality.checked == 2
        i = int(np.flatnonzero(state.status[0] == CONTACT)[0])
        p_f, p_d = state.P[0, i - 1], state.P[0, i]
        assert 0.0 < p_f <= p_d
        assert inequality.largest_ratio == pytest.approx(p_f / p_d, rel=1e-12)

    def test_nothing_flows_through_any_face_of_the_inlet(self, blocked):
        """So that what the fluid carries in, the pressure drives back, face by face:
        (eps_i + eps_i+1)/2 (P_i+1 - P_i)/dX = rho_i H_i  [Liu eqs. 7, 31]."""
        problem, state = blocked
        mesh = problem.grid.mesh
        evaluation = problem.evaluate(state)
        first = int(np.flatnonzero(state.status[0] == CONTACT)[0])
        assert np.all(state.status[0, 1:first] == LUBRICATED)
        ((leaving, _),) = evaluation.flows
        carried = own(evaluation.fluid.rho) * state.H
        np.testing.assert_allclose(leaving.value[0, :first] / carried[0, :first], 0.0, atol=1e-7)
        eps, P = own(evaluation.fluid.eps)[0, :first], state.P[0, :first]
        back = 0.5 * (eps[:-1] + eps[1:]) * np.diff(P) / mesh.dX
        np.testing.assert_allclose(back, carried[0, : first - 1], rtol=1e-7)
        assert leaving.value[0, first - 1] == 0.0
        assert closed_face_flow(problem, evaluation) == 0.0

    def test_behind_it_there_is_a_cavity(self, blocked):
        problem, state = blocked
        last = int(np.flatnonzero(state.status[0] == CONTACT)[-1])
        assert np.all(state.status[0, last + 1 : -1] == CAVITATED)
        assert complementarity_error(problem, state, problem.evaluate(state)) <= 1e-9
