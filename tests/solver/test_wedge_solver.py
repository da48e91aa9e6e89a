from functools import cache

import numpy as np
import pytest
from contacts import solved

from mgehl.config import config_from_tables
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.kinds import contact_from, mesh_from
from mgehl.model.wedge_series import WedgeSeries
from mgehl.output.centre_line import centre_pressure
from mgehl.solver.from_config import scheme_from
from mgehl.solver.verification import complementarity_error, flux_imbalance
from mgehl.solver.wedge import solve_wedge
from mgehl.studies.limits import order_of_errors
from mgehl.studies.study import merged
from mgehl.studies.wedge import PLACES, case, relative_errors

SHAPES = ("blocked exit", "no blockage")
PILLARS = ("square pillar", "cylindrical pillar")


def film_on_centre_line(solved):
    """X, counted from where the gap would close, and P of the fluid on Y = 0."""
    X, P = centre_pressure(solved.mesh, solved.fields)
    if solved.contact.turned:
        X, P = -X[::-1], P[::-1]
    return X[~np.isnan(P)], P[~np.isnan(P)]


@cache
def solution(shape, nodes=65, couette="1B", interface="closed", turned=False, pillar_y=0.0):
    tables = case(shape, nodes, couette, interface, turned)
    moved = {"wedge": {"pillar_y": pillar_y}} if pillar_y else {}
    return solved(tables, moved)


@pytest.fixture
def solve_tables(make_grid):
    def run(tables, tolerance=1e-10, max_steps=60):
        config = config_from_tables(tables)
        bearing = contact_from(config)
        grid, scheme = make_grid(mesh_from(config, bearing)), scheme_from(config, bearing)
        return solve_wedge(grid, bearing, scheme, tolerance, max_steps)

    return run


@cache
def exact(shape):
    """The series at `PLACES` on the centre line, and its load."""
    series = WedgeSeries(20.0, 50.0, 20.0, shape == "blocked exit")
    return (*series.pressure(np.array(PLACES)), series.load())


def errors_and_orders(shape, couette, turned=False):
    """Relative errors on 129 nodes, and by which power of dX they fell from 65."""
    coarse, fine = (
        relative_errors(solution(shape, nodes, couette, turned=turned), exact(shape)) for nodes in (65, 129)
    )
    return fine, [order_of_errors(*pair) for pair in zip(coarse, fine, strict=True)]


# Measured on 129 nodes: 0.45 % by 1B at the blocked exit, 0.02 % by the others, 0.1 % at the open one.
@pytest.mark.parametrize(
    "shape, couette, largest, order",
    [("blocked exit", "1B", 5e-3, 1), ("blocked exit", "2B", 2.5e-4, 2), ("blocked exit", "2C", 2.5e-4, 2),
     ("no blockage", "1B", 1e-3, 2), ("no blockage", "2B", 1e-3, 2), ("no blockage", "2C", 1e-3, 2)],
)  # fmt: skip
def test_convergence_to_the_series(shape, couette, largest, order):
    """1B takes the gap of a face half a cell upstream: first order at a wall. Between open ends the
    gap is linear, so that the mistake is a constant flow and drops out: second order."""
    errors, orders = errors_and_orders(shape, couette)
    assert max(map(abs, errors)) < largest
    assert orders == pytest.approx([order] * 4, abs=0.1)


def test_1b_knows_the_blocked_exit_from_the_other_side_too():
    """Turned by 180 degrees the gap is taken half a cell on the other side: same order, other errors."""
    errors, orders = errors_and_orders("blocked exit", "1B", turned=True)
    assert max(map(abs, errors)) < 5e-3
    assert orders == pytest.approx([1] * 4, abs=0.1)
    assert errors[0] > 0.0 > errors_and_orders("blocked exit", "1B")[0][0]


@pytest.mark.parametrize("shape", [*SHAPES, *PILLARS])
def test_turned_bearing_gives_the_mirror_image_by_central_differences(shape):
    here, turned = (solution(shape, couette="2C", turned=turned) for turned in (False, True))
    np.testing.assert_array_equal(turned.fields.status, here.fields.status[::-1, ::-1])
    np.testing.assert_allclose(turned.fields.P, here.fields.P[::-1, ::-1], rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("couette", ["1B", "2B", "2C"])
@pytest.mark.parametrize("shape", [*SHAPES, *PILLARS])
def test_residual_flux_and_walls(shape, couette):
    result = solution(shape, couette=couette).result
    assert result.converged
    assert result.residual <= 1e-10
    assert result.flux_imbalance <= 1e-12
    assert result.closed_face_flow == 0.0


@pytest.mark.parametrize("shape", PILLARS)
class TestUntreatedCouetteFlow:
    """Figure 10: "NTCF" with 1B lets Couette flow cross an interface that has film on its left."""

    @pytest.mark.parametrize("turned", [False, True])
    def test_it_flows_through_the_pillar(self, shape, turned):
        """1B: rho H of the film on its left, through every face there; the balance does not notice."""
        solved = solution(shape, interface="untreated", turned=turned)
        result, solid = solved.result, solved.fields.status == CONTACT
        assert result.converged and result.residual <= 1e-10 and result.flux_imbalance <= 1e-12
        left = solid[:, 1:] & ~solid[:, :-1]
        gaps = np.abs(np.broadcast_to(solved.mesh.X[:-1], left.shape)[left])
        assert result.closed_face_flow == pytest.approx(gaps.max(), rel=1e-12)


def test_pressures_at_the_inlet_are_in_the_order_of_figure_9():
    """ "Greater for the square-pillar blockage, followed by the cylinder-pillar, the exit, and none"."""
    at_45 = [np.interp(45.0, *film_on_centre_line(solution(shape))) for shape in (*PILLARS, *SHAPES)]
    assert at_45 == sorted(at_45, reverse=True)


def test_cavitation_leaves_no_tension(solve_tables):
    """Behind the pillar the film tears: P >= 0, P = 0 in the cavity, and as much flows out of it as in."""
    tables = merged(case("square pillar", 65), {"discretization": {"cavitation": True}})
    problem, outcome = solve_tables(tables)
    state = outcome.state
    assert outcome.converged
    assert state.P.min() == 0.0
    cavity = state.status == CAVITATED
    assert cavity.any() and np.all(np.abs(problem.evaluate(state).inflow[cavity]) <= 1e-10)
    assert np.all((state.filling[cavity] >= 0.0) & (state.filling[cavity] <= 1.0))
    assert np.all(state.P[state.status == LUBRICATED] > 0.0)
    assert complementarity_error(problem, state, problem.evaluate(state)) <= 1e-12
    assert flux_imbalance(problem, problem.evaluate(state)) <= 1e-12
    # Only the side of the exit is torn, where the pressure was below zero.
    X = np.broadcast_to(problem.grid.X, cavity.shape)
    assert X[cavity].max() < 39.0
    assert solution("square pillar", 65).result.min_P < -0.01


@pytest.mark.parametrize("shape", PILLARS)
def test_pillar_off_the_centre(shape):
    """The film on both sides of it differs; mirrored along Y the pillar mirrors the film."""
    here, there = (solution(shape, pillar_y=y) for y in (3e-3, -3e-3))
    assert here.result.converged and here.result.flux_imbalance <= 1e-12
    P = here.fields.P
    np.testing.assert_allclose(there.fields.P, P[::-1], rtol=0.0, atol=1e-14)
    assert np.abs(P - P[::-1]).max() > 0.1 * P.max()
    # Turned by 180 degrees it is the mirror image along X and along Y.
    central, turned = (solution(shape, couette="2C", turned=t, pillar_y=3e-3) for t in (False, True))
    np.testing.assert_allclose(turned.fields.P, central.fields.P[::-1, ::-1], rtol=0.0, atol=1e-14)


def test_too_few_steps_are_not_converged(solve_tables):
    """What is asked for is beyond rounding."""
    _, outcome = solve_tables(case("blocked exit"), 1e-18, 1)
    assert not outcome.converged and "residual" in outcome.reason


def test_behind_walls_all_around_nothing_flows():
    """What rounding makes there was told as hundreds of times what flows through."""
    walls = {"contact": {"kind": "wedge"}, "wedge": {"blocked_exit": True, "sides": "closed"}}
    result = solved(walls, {"grid": {"nodes": 65}}).result
    assert result.converged and result.flux_imbalance == 0.0
    assert result.mass.enters < 1e-6 * result.mass.carried_in and result.mass.made_share < 1e-6
