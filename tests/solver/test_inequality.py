import numpy as np
import pytest

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.inequality import (
    SAFETY,
    Power,
    check_interface,
    check_pressure_inequality,
    check_under_contact,
)

NODE = (4, 4)


class TestInterface:
    """Eq. 2 at the face between film and contact, along x and y."""

    @pytest.fixture(params=["along x", "along y"])
    def across(self, request, state):
        """Function: the state with these pressures of nodes 1 to 6, film and from node 4 on contact."""

        def make(P):
            for array, values in ((state.P, P), (state.status, [LUBRICATED] * 3 + [CONTACT] * 3)):
                (array.T if request.param == "along y" else array)[:, 1:7] = values
            return state

        return make

    @pytest.mark.parametrize("slope", [0.1, -0.1])
    def test_a_pressure_that_goes_on_through_the_interface_holds(self, tiny_problem, across, slope):
        """Falling, it breaks the comparison of the nodes."""
        state = across(1.0 + slope * np.arange(6))
        assert check_interface(tiny_problem, state).violations == 0
        at_nodes = {(each["i"], each["j"]) for each in check_pressure_inequality(tiny_problem, state).nodes}
        edge = {(5, j) for j in range(1, 10)} | {(i, 5) for i in range(1, 10)}
        assert bool(at_nodes & edge) == (slope < 0.0)

    @pytest.mark.parametrize("slope", [0.1, 0.0, -0.1])
    def test_a_jump_to_less_pressure_is_found(self, tiny_problem, across, slope):
        """Of 0.5; each side's step to the face, half of the slope, may be wrong by more than its size."""
        P = 1.0 + slope * np.arange(6)
        P[3:] -= 0.5
        result = check_interface(tiny_problem, across(P))
        assert result.violations >= 7 and result.worst == pytest.approx(0.5 - SAFETY * abs(slope))

    def test_the_edge_of_a_dry_contact_in_fluid_of_one_pressure_holds(self, tiny_problem, across):
        """p0, and p0 + sqrt of the distance inside, wherever the edge lies between the nodes."""
        for inside in (1e-6, 0.01, 0.1, 0.5, 0.99):
            P = np.r_[np.full(3, 0.3), 0.3 + np.sqrt(inside + np.arange(3.0))]
            assert check_interface(tiny_problem, across(P)).violations == 0

    @pytest.mark.parametrize("behind, found", [(0.0, False), (0.24, False), (0.26, True), (0.6, True)])
    def test_contact_one_node_wide(self, tiny_problem, state, behind, found):
        """The pressure that falls through it breaks nothing; fluid that presses from both sides does."""
        state.P[:], state.P[:, 5:] = 0.8, behind
        state.P[3, 4], state.P[4, 4], state.P[5, 4], state.P[6, 4] = 0.2, 0.25, 0.3, 0.35
        state.status[4, 4] = CONTACT
        assert bool(check_interface(tiny_problem, state).violations) == found

    def test_a_pressure_that_turns_near_the_interface_holds(self, tiny_problem, across):
        """0.03 from node to node, and no jump: the curvature of 0.04 on the fluid's side says so."""
        state = across(np.array([0.79, 0.84, 0.835, 0.80, 0.79, 0.79]))
        assert check_interface(tiny_problem, state).violations == 0

    @pytest.mark.parametrize("first, undecided", [(0.24, 9), (0.35, 0)])
    def test_contact_that_rises_from_its_tolerance_is_not(self, tiny_problem, across, first, undecided):
        """By 0.4 from node to node: half of that is the step to the face, and 1.25 times as much, 0.25, the
        tolerance; on the outer lines, beyond which there is no pressure, 0.32. No fluid is behind it."""
        state = across(np.r_[np.full(3, 0.125), first + 0.4 * np.arange(3.0)])
        found = check_interface(tiny_problem, state)
        assert found.violations == 0 and found.power == Power(18, undecided, 0.125 if undecided else 0.0)
        assert found.power.decides == (not undecided)


class TestPressureInequality:
    @pytest.mark.parametrize("beside", [(2, 4), (2, 6), (1, 5), (3, 5)], ids=["W", "E", "S", "N"])
    def test_a_violation_on_each_side(self, tiny_problem, state, beside):
        state.status[2, 5], state.P[2, 5] = CONTACT, 0.5
        state.P[beside] = 0.75
        result = check_pressure_inequality(tiny_problem, state)
        assert result.checked == result.violations == 1 and result.worst == 0.25
        assert result.nodes == [{"i": 6, "j": 3, "size": 0.25}]  # counted from 1

    def test_contact_inside_contact_is_not_interface(self, tiny_problem, state):
        state.status[3:6, 3:6], state.P[3:6, 3:6] = CONTACT, 0.9
        state.P[NODE] = 0.1
        result = check_pressure_inequality(tiny_problem, state)
        assert (result.checked, result.violations) == (8, 0)

    def test_the_largest_of_several_neighbours_counts(self, tiny_problem, state):
        """Its ratio is infinite where the contact beside it has no pressure."""
        state.status[NODE], state.P[NODE] = CONTACT, 0.5
        state.P[4, 3], state.P[4, 5], state.P[5, 4] = 0.6, 0.8, 0.7
        result = check_pressure_inequality(tiny_problem, state)
        assert (result.violations, result.worst) == (1, pytest.approx(0.3))
        assert result.largest_ratio == 1.6
        state.P[NODE] = 0.0
        assert check_pressure_inequality(tiny_problem, state).largest_ratio == np.inf


def test_under_contact_the_fluid_presses_no_harder_than_the_bodies(tiny_problem, state):
    state.status[4, 3:5], state.P[4, 3:5] = CONTACT, 0.5
    state.p[4, 3:6] = 0.25, 0.75, 2.0  # the last one is film
    found = check_under_contact(tiny_problem, state)
    assert (found.checked, found.nodes) == (2, [{"i": 5, "j": 5, "size": 0.25}])
