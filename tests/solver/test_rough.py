"""Rough balls in mixed lubrication: film between peaks, contact where the film would be thinner."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.model.surface import Surface
from mgehl.solver.inequality import check_interface
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import NewtonSettings, SolverSettings
from mgehl.solver.task import Task
from mgehl.solver.verification import complementarity_error


class Waves(Surface):
    """Heights in waves of half the Hertz radius, eight nodes long on 65 nodes, a valley in the middle."""

    def __init__(self, amplitude, a):
        self.amplitude, self.a = amplitude, a

    def height(self, x, y):
        k = 4.0 * np.pi / self.a
        return -self.amplitude * np.cos(k * x) * np.cos(k * y)


@pytest.fixture
def solve_rough(paper_contact, make_hierarchy):
    """Function: problem and outcome of a wavy ball, by its amplitude, speed and boundary film in m."""

    def run(
        amplitude, speed, boundary_film=2e-11, start="film", couette="1B", nodes=65,
        tolerance=1e-8,
    ):  # fmt: skip
        contact = paper_contact(speed, load=100.0, surface=Waves(amplitude, 2.05e-4))
        hierarchy = make_hierarchy(contact, nodes, x=(-2.0, 1.5), y=(-1.75, 1.75))
        law = BoundaryFilm(boundary_film / contact.film_scale)
        scheme = Scheme(couette, "linear-gap", contact_law=law)
        newton = NewtonSettings(tolerance=tolerance)
        settings = SolverSettings(scheme=scheme, newton=newton, start=start)
        return nested_iteration(Task(hierarchy, contact, settings))

    return run


def test_3L_has_the_film_of_finer_grids_where_1B_has_twice_of_it(solve_rough):
    """Mean film of a wavy ball on 65 nodes beside that on 257, 14.33 nm: 14.19 by 3L, 27.19 by 1B."""

    def mean_film(couette, nodes):
        problem, outcome = solve_rough(1e-7, 1e-2, couette=couette, nodes=nodes)
        X, Y = (np.linspace(*ends, nodes) for ends in ((-2.0, 1.5), (-1.75, 1.75)))
        within = np.add.outer(Y**2, X**2) < 1.0
        assert outcome.converged
        return 1e9 * problem.contact.film_scale * outcome.state.H[within].mean()

    limit = mean_film("3L", 257)
    assert mean_film("3L", 65) == pytest.approx(limit, rel=0.015)
    assert mean_film("3L", 129) == pytest.approx(limit, rel=0.007)
    assert mean_film("1B", 65) > 1.85 * limit


@pytest.mark.parametrize("couette", ["3B", "3L"])
def test_behind_peaks_a_film_is_never_less_than_none(solve_rough, couette):
    """Contact has 0.070 % of the load on 65 nodes, 0.076 % on 129, and 22 % by 3B without 3L's limit."""
    problem, outcome = solve_rough(1e-7, 3e-3, boundary_film=2e-9, couette=couette)
    P, contact = outcome.state.P, outcome.state.status == CONTACT
    assert outcome.converged and 0.0 < P[contact].sum() / P.sum() < 0.001


@pytest.mark.parametrize("couette", ["1B", "3L"])
def test_from_a_film_and_from_contact_it_is_the_same_state(solve_rough, couette):
    """Closing is continuous: there is no second branch. What solves are apart by, their tolerance is."""
    how = {"couette": couette, "tolerance": 1e-10}
    found = [solve_rough(1e-7, 1e-3, start=start, **how) for start in ("film", "contact")]
    films = [problem.films(outcome.state) for problem, outcome in found]
    np.testing.assert_allclose(*films, rtol=1e-6)


def test_contact_is_where_the_film_would_be_thinner(solve_rough):
    """With a boundary film of 2 nm at a smooth film of 4 nm: contact on some peaks, at that gap."""
    problem, outcome = solve_rough(1e-7, 1e-3, boundary_film=2e-9)
    assert outcome.converged
    state, nm = outcome.state, 1e9 * problem.contact.film_scale
    contact, film = state.status == CONTACT, state.status == LUBRICATED
    assert contact.any() and film.any()
    np.testing.assert_allclose(state.H[contact] * nm, 2.0, rtol=1e-5)
    assert state.H[film].min() * nm > 2.0
    assert (state.p[contact] >= 0.0).all() and (state.p[contact] <= state.P[contact]).all()
    flow = np.abs(problem.evaluate(state).inflow) * problem.grid.mesh.dX
    assert flow[contact].max() < 1e-7, "what flows into contact leaves it"


@pytest.mark.parametrize("start", ["film", "contact"])
@pytest.mark.parametrize("speed, share", [(3e-4, 0.08), (1e-5, 0.5)])
def test_contact_carries_much_of_the_load(solve_rough, start, speed, share):
    """Down to next to no flow, with a boundary film: settled, no overlap, Eq. 2 at the interface."""
    problem, outcome = solve_rough(1e-7, speed, boundary_film=2e-9, start=start)
    state = outcome.state
    assert outcome.converged
    assert problem.load(np.where(state.status == CONTACT, state.P, 0.0)) > share * problem.load(state.P)
    assert complementarity_error(problem, state, problem.evaluate(state)) < 1e-7
    assert check_interface(problem, state).violations == 0
