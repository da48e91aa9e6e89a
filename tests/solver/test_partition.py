"""The rules of the partition one by one, on 9 x 9 nodes."""

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.problem import State

THRESHOLD = 1e-3
NODE = (4, 4)


@pytest.fixture
def make_partition(tiny_problem):
    return lambda threshold=THRESHOLD, budget=2: Partition(tiny_problem, threshold, budget)


@pytest.fixture
def state(tiny_problem):
    """All film with P = 0.5 and a gap of 1."""
    shape = tiny_problem.grid.shape
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    P = np.where(tiny_problem.boundary, 0.0, 0.5)
    return State(P, 0.0, np.ones(shape), status)


def only(changes, **expected):
    """The changes are these and no others."""
    counts = {"cavitated": 0, "filled": 0, "entered": 0, "released": 0} | expected
    assert vars(changes) == counts
    assert changes.total == sum(counts.values())


class TestTension:
    def test_negative_film_pressure_cavitates(self, make_partition, state):
        changes = Changes()
        state.P[NODE] = -0.1
        make_partition().cut_tension(state.P, state.status, changes)
        assert state.status[NODE] == CAVITATED and state.P[NODE] == 0.0
        only(changes, cavitated=1)

    def test_negative_contact_pressure_releases(self, make_partition, state):
        changes = Changes()
        state.P[NODE], state.status[NODE] = -0.1, CONTACT
        make_partition().cut_tension(state.P, state.status, changes)
        assert state.status[NODE] != CONTACT and state.P[NODE] == 0.0
        only(changes, released=1)

    @pytest.mark.parametrize("status", [LUBRICATED, CAVITATED, CONTACT])
    def test_pressures_that_are_not_negative_stay(self, make_partition, state, status):
        changes = Changes()
        state.P[NODE], state.status[NODE] = 0.0, status
        before = state.copy()
        make_partition().cut_tension(state.P, state.status, changes)
        np.testing.assert_array_equal(state.P, before.P)
        np.testing.assert_array_equal(state.status, before.status)
        only(changes)

    def test_tensile_contact_always_leaves_whatever_the_budget(self, make_partition, state):
        partition = make_partition(budget=0)
        for _ in range(3):
            state.P[NODE], state.status[NODE] = -0.1, CONTACT
            changes = Changes()
            partition.cut_tension(state.P, state.status, changes)
            only(changes, released=1)


class TestEnteringContact:
    @pytest.mark.parametrize("status", [LUBRICATED, CAVITATED])
    @pytest.mark.parametrize("gap, enters", [(-0.1, True), (THRESHOLD, True), (1.01 * THRESHOLD, False)])
    def test_fluid_whose_gap_is_closed(self, make_partition, state, status, gap, enters):
        changes = Changes()
        state.status[NODE], state.H[NODE] = status, gap
        make_partition().enter_contact(state, changes)
        assert state.status[NODE] == (CONTACT if enters else status)
        only(changes, entered=int(enters))

    def test_the_boundary_never_enters(self, make_partition, state):
        changes = Changes()
        state.H[0, 4] = state.H[4, 0] = -0.1
        make_partition().enter_contact(state, changes)
        assert state.status[0, 4] == BOUNDARY and state.status[4, 0] == BOUNDARY
        only(changes)

    def test_fluid_shut_in_from_west_and_east_enters(self, make_partition, state):
        changes = Changes()
        state.status[4, 3] = state.status[4, 5] = CONTACT
        make_partition().enter_contact(state, changes)
        assert state.status[NODE] == CONTACT
        only(changes, entered=1)

    def test_fluid_shut_in_across_the_motion_does_not(self, make_partition, state):
        changes = Changes()
        state.status[3, 4] = state.status[5, 4] = CONTACT
        make_partition().enter_contact(state, changes)
        assert state.status[NODE] == LUBRICATED
        only(changes)

    def test_a_released_node_stays_out_for_a_step(self, make_partition, state):
        """It has no gap yet, and opens one only in the next step."""
        partition, changes = make_partition(), Changes()
        state.P[NODE], state.status[NODE], state.H[NODE] = -0.1, CONTACT, -1e-12
        partition.cut_tension(state.P, state.status, Changes())
        partition.enter_contact(state, changes)
        assert state.status[NODE] != CONTACT
        only(changes)

    @pytest.mark.parametrize("gap, enters", [(0.5 * THRESHOLD, False), (-1e-6, True)])
    def test_a_released_node_comes_back_only_if_the_bodies_overlap(
        self, make_partition, state, gap, enters
    ):
        partition = make_partition()
        state.P[NODE], state.status[NODE] = -0.1, CONTACT
        partition.cut_tension(state.P, state.status, Changes())
        partition.cut_tension(state.P, state.status, Changes())  # the next step
        state.H[NODE], changes = gap, Changes()
        partition.enter_contact(state, changes)
        assert (state.status[NODE] == CONTACT) == enters
        only(changes, entered=int(enters))


class TestFilling:
    @pytest.mark.parametrize("inflow, fills", [(1.0, True), (0.0, False), (-1.0, False)])
    def test_cavity_that_fluid_flows_into(self, make_partition, state, inflow, fills):
        changes = Changes()
        state.status[NODE], state.P[NODE] = CAVITATED, 0.0
        inflows = np.zeros_like(state.P)
        inflows[NODE] = inflow
        make_partition().fill(state, inflows, changes)
        assert state.status[NODE] == (LUBRICATED if fills else CAVITATED)
        only(changes, filled=int(fills))

    def test_a_cavity_without_a_gap_stays(self, make_partition, state):
        changes = Changes()
        state.status[NODE], state.P[NODE], state.H[NODE] = CAVITATED, 0.0, 0.0
        make_partition().fill(state, np.ones_like(state.P), changes)
        assert state.status[NODE] == CAVITATED
        only(changes)

    @pytest.mark.parametrize("status", [LUBRICATED, CONTACT])
    def test_inflow_does_not_change_other_nodes(self, make_partition, state, status):
        changes = Changes()
        state.status[NODE] = status
        before = state.status.copy()
        make_partition().fill(state, np.ones_like(state.P), changes)
        np.testing.assert_array_equal(state.status, before)
        only(changes)


class TestPressureInequality:
    """Release of contact whose pressure is below the fluid's beside it."""

    @pytest.mark.parametrize("beside", [(4, 3), (4, 5), (3, 4), (5, 4)], ids=["W", "E", "S", "N"])
    def test_a_violation_on_any_side_releases(self, make_partition, state, beside):
        state.status[NODE], state.P[NODE] = CONTACT, 0.6
        partition = make_partition()
        assert partition.release_violations(state) == 0
        state.P[beside] = 0.7
        assert partition.release_violations(state) == 1
        assert state.status[NODE] == LUBRICATED and state.P[NODE] == 0.7

    def test_equal_pressures_hold(self, make_partition, state):
        state.status[NODE] = CONTACT
        assert make_partition().release_violations(state) == 0
        assert state.status[NODE] == CONTACT

    def test_contact_beside_contact_holds(self, make_partition, state):
        state.status[3:6, 3:6], state.P[3:6, 3:6] = CONTACT, 0.9
        state.P[NODE] = 0.1  # below its neighbours, but those are contact
        assert make_partition().release_violations(state) == 0

    def test_the_budget_is_finite_and_per_node(self, make_partition, state):
        partition = make_partition(budget=2)
        for released in (1, 1, 0):
            state.status[NODE], state.P[NODE] = CONTACT, 0.1
            assert partition.release_violations(state) == released
        assert state.status[NODE] == CONTACT
        state.status[2, 2], state.P[2, 2] = CONTACT, 0.1
        assert partition.release_violations(state) == 1

    def test_a_released_node_is_not_put_back_at_once(self, make_partition, state):
        partition, changes = make_partition(), Changes()
        state.status[NODE], state.P[NODE], state.H[NODE] = CONTACT, 0.1, 0.0
        assert partition.release_violations(state) == 1
        partition.enter_contact(state, changes)
        assert state.status[NODE] == LUBRICATED
        only(changes)
