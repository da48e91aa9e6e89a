"""The rules of the partition one by one, on 9 x 9 nodes."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.partition import (
    RESTLESS,
    ROUND,
    Changes,
    Contradiction,
    Partition,
    carried_through,
)
from mgehl.solver.problem import State

THRESHOLD = 1e-3
NODE = (4, 4)
LAW = InterfaceConditions(THRESHOLD)


@pytest.fixture
def make_partition(make_problem):
    """Factory of partitions on 9 x 9 nodes, by another contact law or motion if asked for."""

    def make(budget=2, law=LAW, **scheme):
        return Partition(make_problem(nodes=9, scheme=Scheme(contact_law=law, **scheme)), budget)

    return make


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


def let_go(partition, state):
    """How many nodes are let go on Eq. 2; nothing else changes."""
    changes = Changes()
    partition.release_violations(state, changes)
    only(changes, released=changes.released)
    return changes.released


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

    @pytest.mark.parametrize("sides, enters", [(1, False), (2, True)])
    def test_at_an_angle_fluid_must_be_shut_in_along_both_axes(self, make_partition, state, sides, enters):
        changes = Changes()
        for node in [(4, 3), (4, 5), (3, 4), (5, 4)][: 2 * sides]:
            state.status[node] = CONTACT
        make_partition(motion=(0.6, 0.8)).enter_contact(state, changes)
        assert state.status[NODE] == (CONTACT if enters else LUBRICATED)
        only(changes, entered=int(enters))

    def test_by_the_unified_equations_bodies_overlap(self, make_partition, state):
        changes = Changes()
        state.H[NODE] = -0.1
        make_partition(law=UnifiedEquations()).enter_contact(state, changes)
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

    def test_by_the_unified_equations_it_fills(self, make_partition, state):
        changes = Changes()
        state.status[NODE], state.P[NODE], state.H[NODE] = CAVITATED, 0.0, -0.1
        make_partition(law=UnifiedEquations()).fill(state, np.ones_like(state.P), changes)
        assert state.status[NODE] == LUBRICATED
        only(changes, filled=1)

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
        assert let_go(partition, state) == partition.count_violations(state) == 0
        state.P[beside] = 0.7
        assert partition.count_violations(state) == partition.count_releasable(state) == 1
        assert let_go(partition, state) == 1
        assert state.status[NODE] == LUBRICATED and state.P[NODE] == 0.7

    def test_equal_pressures_hold(self, make_partition, state):
        state.status[NODE] = CONTACT
        assert let_go(make_partition(), state) == 0
        assert state.status[NODE] == CONTACT

    def test_contact_beside_contact_holds(self, make_partition, state):
        state.status[3:6, 3:6], state.P[3:6, 3:6] = CONTACT, 0.9
        state.P[NODE] = 0.1  # below its neighbours, but those are contact
        assert let_go(make_partition(), state) == 0

    def test_the_budget_is_finite_and_per_node(self, make_partition, state):
        partition = make_partition(budget=2)
        for released in (1, 1, 0):
            state.status[NODE], state.P[NODE] = CONTACT, 0.1
            assert (partition.count_violations(state), partition.count_releasable(state)) == (1, released)
            assert let_go(partition, state) == released
        assert state.status[NODE] == CONTACT
        state.status[2, 2], state.P[2, 2] = CONTACT, 0.1
        assert let_go(partition, state) == 1

    @pytest.mark.parametrize("beside", [(4, 3), (4, 5), (3, 4), (5, 4)], ids=["W", "E", "S", "N"])
    def test_violations_are_named_with_the_pressure_beside_and_nothing_is_changed(
        self, make_partition, state, beside
    ):
        state.status[NODE], state.P[NODE], state.P[beside] = CONTACT, 0.6, 0.7
        before = state.copy()
        found, pressure = make_partition(budget=0).violations(state)
        assert np.argwhere(found).tolist() == [list(NODE)]
        assert pressure[NODE] == 0.7
        np.testing.assert_array_equal(state.P, before.P)
        np.testing.assert_array_equal(state.status, before.status)

    def test_only_contact_below_the_fluid_beside_it_is_a_violation(self, make_partition, state):
        """Not film below film, nor contact level with the fluid, nor contact below contact."""
        state.P[2, 2] = 0.1
        state.status[NODE] = CONTACT
        state.status[4:8, 6], state.P[4:8, 6] = CONTACT, 0.9
        state.P[5, 6] = 0.8
        assert not make_partition().violations(state)[0].any()


class TestRestlessNodes:
    """Nodes that turn between film and contact, which no grid of theirs will settle."""

    @pytest.fixture
    def turn(self, state):
        """Function that closes a node and tears it open again: two turns."""

        def turn(partition, node=NODE, gap=-0.02, pressure=-0.1, times=1):
            for _ in range(times):
                close(partition, node, gap)
                state.P[node] = pressure
                partition.cut_tension(state.P, state.status, Changes())

        def close(partition, node=NODE, gap=-0.02):
            partition.cut_tension(state.P, state.status, Changes())  # a step in which nothing is torn
            state.status[node], state.H[node] = LUBRICATED, gap
            changes = Changes()
            partition.enter_contact(state, changes)
            state.H[node] = 1.0
            only(changes, entered=1)

        turn.close = close
        return turn

    def test_a_partition_is_restless_from_that_many_turns_of_one_node(self, make_partition, turn):
        partition = make_partition()
        turn(partition, times=(RESTLESS - 1) // 2)
        turn.close(partition)
        assert not partition.restless  # 11 of 12
        turn(partition, times=1)
        assert partition.restless

    def test_turns_of_many_nodes_do_not_add_up(self, make_partition, turn):
        partition = make_partition()
        for node in ((2, 2), (2, 6), (6, 2), (6, 6)):
            turn(partition, node, times=2)
        assert not partition.restless

    def test_cavities_that_come_and_go_are_no_turns(self, make_partition, state):
        partition = make_partition()
        for _ in range(2 * RESTLESS):
            state.P[NODE], state.status[NODE] = -0.1, LUBRICATED
            partition.cut_tension(state.P, state.status, Changes())
            partition.fill(state, np.ones_like(state.P), Changes())
        assert not partition.restless and partition.contradictions(state.status) == []

    def test_a_contradiction_says_where_and_by_how_much(self, make_partition, state, turn):
        """Of gap and pressure the last count; the neighbours are west, east, before and after."""
        partition, node = make_partition(), (3, 5)
        turn(partition, node, times=RESTLESS // 2 - 1)
        turn(partition, node, gap=-0.03, pressure=-0.2)
        state.status[3, 4], state.status[3, 6] = CONTACT, CAVITATED
        state.status[2, 5], state.status[4, 5] = BOUNDARY, LUBRICATED
        assert partition.contradictions(state.status) == [
            Contradiction(6, 4, -0.03, -0.2, ("contact", "cavitated", "boundary", "lubricated"))
        ]

    def test_of_a_line_walls_are_beside(self, make_partition, state, turn):
        partition, node = make_partition(), (0, 5)
        partition.past.turns[node], partition.past.torn_pressure[node] = RESTLESS, -0.2
        (found,) = partition.contradictions(state.status)
        assert found.neighbours[2] == "wall"

    def test_those_about_to_be_restless_are_contradictions_too(self, make_partition, state, turn):
        """One round less is enough, one turn less than that is not; all in the order of the grid."""
        partition, before_the_last = make_partition(), (RESTLESS - ROUND) // 2
        turn(partition, (6, 2), times=before_the_last + 1)
        turn(partition, (2, 6), times=before_the_last)
        turn(partition, (2, 2), times=before_the_last - 1)
        turn.close(partition, (2, 2))
        assert [(each.i, each.j) for each in partition.contradictions(state.status)] == [(7, 3), (3, 7)]

    def test_a_node_that_was_never_torn_is_no_contradiction(self, make_partition, state, turn):
        partition = make_partition()
        for _ in range(RESTLESS):
            turn.close(partition)
        assert partition.restless and partition.contradictions(state.status) == []

    @pytest.mark.parametrize("budget", [0, 2])
    def test_release_on_eq_2_starts_the_count_anew(self, make_partition, state, turn, budget):
        """What opens then is another problem, and nodes have all their turns again."""
        partition = make_partition(budget=budget)
        turn(partition, times=RESTLESS // 2)
        assert partition.restless and len(partition.contradictions(state.status)) == 1
        state.status[NODE], state.P[NODE] = LUBRICATED, 0.5
        state.status[2, 2], state.P[2, 2] = CONTACT, 0.1
        assert let_go(partition, state) == (1 if budget else 0)
        assert not partition.restless and partition.contradictions(state.status) == []
        turn(partition, times=RESTLESS // 2 - 1)
        assert not partition.restless
        turn(partition)
        assert partition.restless


class TestContinuousContact:
    """Contact that keeps a film and leaves its faces open."""

    FILM = 1e-3

    @pytest.fixture
    def partition(self, make_partition):
        return make_partition(law=BoundaryFilm(self.FILM))

    @pytest.fixture
    def pressed(self, state):
        """Nodes 3 to 6 of line 4 in contact, at the film that contact keeps."""
        state.status[4, 3:7], state.H[4, 3:7] = CONTACT, self.FILM
        return state

    def test_a_film_closes_at_the_gap_that_contact_keeps(self, partition, state):
        state.H[4, 3], state.H[4, 5] = self.FILM, 1.01 * self.FILM
        changes = Changes()
        partition.enter_contact(state, changes)
        assert state.status[4, 3] == CONTACT and state.status[4, 5] == LUBRICATED
        only(changes, entered=1)
        assert not partition.past.turns.any()

    def test_it_shuts_in_no_fluid(self, partition, state):
        state.status[4, [3, 5]] = CONTACT
        partition.enter_contact(state, Changes())
        assert state.status[4, 4] == LUBRICATED

    def test_it_opens_as_far_as_what_flows_in_is_carried(self, partition, pressed):
        """0.1 flow in at node 4, node 5 needs 0.04 of it, node 6 more than what is left."""
        inflow, changes = np.full(pressed.P.shape, -1.0), Changes()
        inflow[4, 4], inflow[4, 5], inflow[4, 6] = 0.1, -0.04, -0.07
        partition.open_contact(pressed, inflow, changes)
        assert pressed.status[4, 3:7].tolist() == [CONTACT, LUBRICATED, LUBRICATED, CONTACT]
        only(changes, released=2)

    @pytest.mark.parametrize("missing, opens", [(0.9, True), (1.1, False)])
    def test_asked_is_the_flow_it_has_with_the_gap_it_keeps(
        self, partition, tiny_problem, pressed, missing, opens
    ):
        """A node that has just closed carries away less: it will not, as soon as it has its gap."""
        inflow = np.full(pressed.P.shape, -1.0)
        inflow[4, 4] = 0.1 * self.FILM / tiny_problem.grid.mesh.dX
        pressed.H[4, 4] -= 0.1 * self.FILM * missing
        partition.open_contact(pressed, inflow, Changes())
        assert (pressed.status[4, 4] == LUBRICATED) == opens

    def test_contact_that_closes_its_faces_is_not_asked(self, make_partition, pressed):
        make_partition().open_contact(pressed, np.ones(pressed.P.shape), Changes())
        assert (pressed.status[4, 3:7] == CONTACT).all()

    def test_it_is_not_let_go_by_its_pressure(self, partition, make_partition):
        assert not partition.asks_eq_2 and make_partition().asks_eq_2


def test_what_is_carried_through_a_run():
    """2 flow in: 1 is needed, 1 goes on and is used up; another run begins with nothing."""
    inflow = np.array([[9.0, 2.0, -1.0, -0.5, -3.0, 1.0, 9.0, -1.0, 0.5]])
    nodes = np.array([[0, 1, 1, 1, 1, 1, 0, 1, 1]], dtype=bool)
    carried = carried_through(inflow, nodes)[nodes]
    assert carried == pytest.approx([2.0, 1.0, 0.5, -2.5, 1.0, -1.0, 0.5])
