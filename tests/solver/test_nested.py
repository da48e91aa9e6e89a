"""Whole solutions by nested iteration, against numbers that were calculated independently."""

import numpy as np
import pytest
from contacts import contact_of, moes

import mgehl
from mgehl.discretization.status import CONTACT
from mgehl.model.hertz import hertz_pressure
from mgehl.model.point import LOAD
from mgehl.solver.inequality import check_pressure_inequality

MOES_DOMAIN = {"x": (-4.5, 1.5), "y": (-3.0, 3.0)}


def test_full_film_at_one_metre_per_second(solve, paper_contact):
    solution = solve(paper_contact(), 129)
    assert solution.outcome.converged
    assert solution.films == (pytest.approx(407.620, rel=1e-5), pytest.approx(130.083, rel=1e-5))
    assert solution.finest_steps <= 15
    assert not np.any(solution.outcome.state.status == CONTACT)


def test_the_papers_film_takes_few_convolutions():
    """513 nodes, 7.5 mm/s: led there at once, the first step closed 150 nodes; 487 convolutions for 70."""
    asked = {"grid.nodes": 513, "solver.error": False}
    summary = mgehl.solve(mgehl.load("configs/full_film.toml", asked)).summary
    assert summary.converged and summary.work.convolutions < 140.0
    assert summary.central_film_nm == pytest.approx(12.2545, rel=1e-5)


def test_the_film_is_symmetric(solve, paper_contact):
    state = solve(paper_contact(), 65).outcome.state
    np.testing.assert_allclose(state.P, state.P[::-1], rtol=0.0, atol=1e-8)
    np.testing.assert_array_equal(state.status, state.status[::-1])


@pytest.mark.parametrize(
    "M, couette, nodes, central, minimum",
    [(20, "2B", 65, 4.65234, 2.88452), (20, "2B", 129, 4.76528, 2.94626),
     (200, "2B", 65, 3.25298, 1.31632), (20, "1B", 65, 5.11010, None), (200, "1B", 65, 4.79300, None)],
)  # fmt: skip
def test_moes_films(solve, M, couette, nodes, central, minimum):
    """Incompressible full films with L = 10, by another program on the same grid (tests/README.md)."""
    contact = contact_of(moes(M, 10.0))
    assert contact.groups.M == pytest.approx(M) and contact.groups.L == pytest.approx(10)
    solution = solve(contact, nodes, couette=couette, **MOES_DOMAIN)
    assert solution.outcome.converged
    scale = 1e-9 * contact.moes_scale
    films = [film * scale for film in solution.films]
    assert films[0] == pytest.approx(central, rel=1e-4)
    if minimum:
        assert films[1] == pytest.approx(minimum, rel=1e-4)


@pytest.mark.parametrize("nodes", [65, 129])
def test_full_contact(solve, paper_contact, nodes):
    """0.005 mm/s: all of the Hertz circle in contact, Eq. 2 at every node of its edge."""
    solution = solve(paper_contact(5e-6), nodes, start="contact")
    problem, state = solution.problem, solution.outcome.state
    assert solution.outcome.converged
    grid, contact = problem.grid, state.status == CONTACT
    radius = np.sqrt(grid.X**2 + grid.Y**2)
    assert np.all(contact[radius <= 1.0 - grid.mesh.dX])
    assert not np.any(contact[radius > 1.0 + grid.mesh.dX])
    nm = 1e9 * problem.contact.film_scale
    assert np.abs(state.H[contact]).max() * nm < 1e-3
    assert state.P[contact].min() >= 0.0
    inequality = check_pressure_inequality(problem, state)
    assert inequality.violations == 0 and inequality.checked > 50
    load = grid.mesh.dX * grid.mesh.dY * state.P.sum()
    assert load == pytest.approx(LOAD, rel=1e-7)


def test_dry_limit_of_an_elliptical_contact(solve, paper_contact):
    """At 0.001 mm/s the ellipse carries the load as if it were dry."""
    contact = paper_contact(1e-6, radius_y=2 * 12.7e-3)
    assert contact.hertz.b > 1.5 * contact.hertz.a
    solution = solve(contact, 129, start="contact")
    assert solution.outcome.converged
    grid, P = solution.problem.grid, solution.outcome.state.P
    inside = grid.X**2 + grid.Y**2 < 0.9**2
    np.testing.assert_allclose(P[inside], np.broadcast_to(hertz_pressure(grid.X, grid.Y), P.shape)[inside],
                               rtol=0.0, atol=1e-2)  # fmt: skip
    hertz, mesh = contact.hertz, grid.mesh
    newton = P.sum() * hertz.p_h * (mesh.dX * hertz.a) * (mesh.dY * hertz.b)
    assert newton == pytest.approx(800.0, rel=1e-7)


def test_cavities_and_steps_do_not_take_turns_for_ever(solve, paper_contact):
    """3 m/s on 65 nodes: relaxed in a gap held fixed, 40 nodes went to and fro until the steps ran out."""
    solution = solve(paper_contact(3.0), 65)
    assert solution.outcome.converged and solution.finest_steps <= 18
