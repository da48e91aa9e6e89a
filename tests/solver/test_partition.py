"""The rules of the partition one by one, on 9 x 9 nodes."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.partition import RESTLESS, ROUND, Changes, Contradiction, Partition
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
        make_partition().cut_tension(state, changes)
        assert state.status[NODE] == CAVITATED and state.P[NODE] == 0.0
        only(changes, cavitated=1)

    @pytest.mark.parametrize("status, filling", [(LUBRICATED, 1.0), (CONTACT, 0.0)])
    def test_torn_film_leaves_a_full_gap_and_contact_an_empty_one(
        self, make_partition, state, status, filling
    ):
        state.P[NODE], state.status[NODE], state.filling[:] = -0.1, status, 0.3
        make_partition().cut_tension(state, Changes())
        assert state.filling[NODE] == filling
        assert np.count_nonzero(state.filling == 0.3) == state.filling.size - 1

    def test_negative_contact_pressure_releases(self, make_partition, state):
        changes = Changes()
        state.P[NODE], state.status[NODE] = -0.1, CONTACT
        make_partition().cut_tension(state, changes)
        assert state.status[NODE] != CONTACT and state.P[NODE] == 0.0
        only(changes, released=1)

    @pytest.mark.parametrize("status", [LUBRICATED, CAVITATED, CONTACT])
    def test_pressures_that_are_not_negative_stay(self, make_partition, state, status):
        changes = Changes()
        state.P[NODE], state.status[NODE] = 0.0, status
        before = state.copy()
        make_partition().cut_tension(state, changes)
        np.testing.assert_array_equal(state.P, before.P)
        np.testing.assert_array_equal(state.status, before.status)
        only(changes)

    def test_tensile_contact_always_leaves_whatever_the_budget(self, make_partition, state):
        partition = make_partition(budget=0)
        for _ in range(3):
            state.P[NODE], state.status[NODE] = -0.1, CONTACT
            changes = Changes()
            partition.cut_tension(state, changes)
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
        partition.cut_tension(state, Changes())
        partition.enter_contact(state, changes)
        assert state.status[NODE] != CONTACT
        only(changes)

    @pytest.mark.parametrize("gap, enters", [(0.5 * THRESHOLD, False), (-1e-6, True)])
    def test_a_released_node_comes_back_only_if_the_bodies_overlap(
        self, make_partition, state, gap, enters
    ):
        partition = make_partition()
        state.P[NODE], state.status[NODE] = -0.1, CONTACT
        partition.cut_tension(state, Changes())
        partition.cut_tension(state, Changes())  # the next step
        state.H[NODE], changes = gap, Changes()
        partition.enter_contact(state, changes)
        assert (state.status[NODE] == CONTACT) == enters
        only(changes, entered=int(enters))


class TestFilling:
    @pytest.mark.parametrize("filling, fills", [(1.01, True), (1.0, False), (0.0, False)])
    def test_cavity_that_holds_more_than_its_gap(self, make_partition, state, filling, fills):
        changes = Changes()
        state.status[NODE], state.P[NODE], state.filling[NODE] = CAVITATED, 0.0, filling
        make_partition().fill(state, changes)
        assert state.status[NODE] == (LUBRICATED if fills else CAVITATED)
        only(changes, filled=int(fills))

    @pytest.mark.parametrize("law", [LAW, BoundaryFilm(THRESHOLD)])
    def test_a_cavity_without_a_gap_stays(self, make_partition, state, law):
        changes = Changes()
        state.status[NODE], state.P[NODE], state.H[NODE], state.filling[NODE] = CAVITATED, 0.0, 0.0, 2.0
        make_partition(law=law).fill(state, changes)
        assert state.status[NODE] == CAVITATED
        only(changes)

    def test_by_the_unified_equations_it_fills(self, make_partition, state):
        changes = Changes()
        state.status[NODE], state.P[NODE], state.H[NODE], state.filling[NODE] = CAVITATED, 0.0, -0.1, 2.0
        make_partition(law=UnifiedEquations()).fill(state, changes)
        assert state.status[NODE] == LUBRICATED
        only(changes, filled=1)

    @pytest.mark.parametrize("status", [LUBRICATED, CONTACT])
    def test_filling_does_not_change_other_nodes(self, make_partition, state, status):
        """What is no cavity has a filling without meaning."""
        changes = Changes()
        state.status[NODE], state.filling[:] = status, 2.0
        before = state.status.copy()
        make_partition().fill(state, changes)
        np.testing.assert_array_equal(state.status, before)
        only(changes)


class TestFit:
    def test_contents_are_between_nothing_and_what_the_gap_holds(self, make_partition, state):
        state.filling[4, 3:6] = -0.1, 0.3, 1.2
        make_partition().fit(state)
        assert state.filling[4, 3:6].tolist() == [0.0, 0.3, 1.0]

    def test_the_fluid_has_a_pressure_of_its_own_in_contact_alone(self, make_partition, state):
        state.status[4, 3:6] = CONTACT, CONTACT, CAVITATED
        state.P[4, 5], state.p[:] = 0.0, 0.2
        state.p[4, 3] = -0.1
        before = state.copy()
        make_partition(law=BoundaryFilm(THRESHOLD)).fit(state)
        expected = before.P.copy()
        expected[4, 3:5] = 0.0, 0.2
        np.testing.assert_array_equal(state.p, expected)
        np.testing.assert_array_equal(state.P, before.P)
        np.testing.assert_array_equal(state.status, before.status)


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
                partition.cut_tension(state, Changes())

        def close(partition, node=NODE, gap=-0.02):
            partition.cut_tension(state, Changes())  # a step in which nothing is torn
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
            partition.cut_tension(state, Changes())
            state.filling[NODE], filled = 1.1, Changes()
            partition.fill(state, filled)
            only(filled, filled=1)
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
        state.H[4, 3], state.H[4, 5] = 0.99 * self.FILM, 1.01 * self.FILM
        changes = Changes()
        partition.enter_contact(state, changes)
        assert state.status[4, 3] == CONTACT and state.status[4, 5] == LUBRICATED
        only(changes, entered=1)
        assert not partition.past.turns.any()

    def test_it_has_the_pressure_of_its_own_step(self, partition, state):
        """Not that before: where pressures fell, what has just closed would be let go at once."""
        state.p[4, 3], state.H[4, 3] = state.P[4, 3] + 0.1, 0.99 * self.FILM
        partition.enter_contact(state, Changes())
        assert state.p[4, 3] == state.P[4, 3]
        partition.open_contact(state, Changes())
        assert state.status[4, 3] == CONTACT

    def test_it_shuts_in_no_fluid(self, partition, state):
        state.status[4, [3, 5]] = CONTACT
        partition.enter_contact(state, Changes())
        assert state.status[4, 4] == LUBRICATED

    @pytest.mark.parametrize("more, opens", [(0.1, True), (0.0, False), (-0.1, False)])
    def test_it_opens_where_the_fluid_presses_harder(self, partition, pressed, more, opens):
        pressed.p[4, 3:7], changes = pressed.P[4, 3:7] - 0.1, Changes()
        pressed.p[NODE] = pressed.P[NODE] + more
        partition.open_contact(pressed, changes)
        after = [CONTACT, LUBRICATED if opens else CONTACT, CONTACT, CONTACT]
        assert pressed.status[4, 3:7].tolist() == after
        only(changes, released=int(opens))

    @pytest.mark.parametrize("part, opens", [(0.9, True), (1.1, False)])
    def test_what_overlaps_opens_where_the_fluid_lifts_it_far_enough(
        self, partition, tiny_problem, pressed, part, opens
    ):
        """The missing gap in parts of what p - P gives the node."""
        pressed.p[NODE] = pressed.P[NODE] + 0.1
        pressed.H[NODE] -= part * 0.1 * tiny_problem.K00
        changes = Changes()
        partition.open_contact(pressed, changes)
        assert (pressed.status[NODE] == LUBRICATED) == opens
        only(changes, released=int(opens))

    def test_a_wider_gap_alone_opens_nothing(self, partition, pressed):
        """Nor does it where the fluid presses less hard than the bodies."""
        pressed.H[4, 3:7], pressed.p[4, 3:7] = 1.0, pressed.P[4, 3:7] - 0.01
        partition.open_contact(pressed, Changes())
        assert (pressed.status[4, 3:7] == CONTACT).all()

    def test_what_has_opened_does_not_close_before_the_next_step(self, partition, pressed):
        pressed.p[NODE] += 0.1
        pressed.H[NODE] *= 0.99
        partition.open_contact(pressed, Changes())
        partition.enter_contact(pressed, Changes())
        assert pressed.status[NODE] == LUBRICATED
        partition.cut_tension(pressed, Changes())
        partition.enter_contact(pressed, Changes())
        assert pressed.status[NODE] == CONTACT

    def test_only_contact_is_asked(self, partition, state):
        state.status[4, 5], changes = CAVITATED, Changes()
        state.p += 1.0
        before = state.status.copy()
        partition.open_contact(state, changes)
        np.testing.assert_array_equal(state.status, before)
        only(changes)

    def test_contact_that_closes_its_faces_is_not_asked(self, make_partition, pressed):
        changes = Changes()
        pressed.p += 1.0
        make_partition().open_contact(pressed, changes)
        assert (pressed.status[4, 3:7] == CONTACT).all()
        only(changes)

    def test_it_is_not_let_go_by_its_pressure(self, partition, make_partition):
        assert not partition.asks_eq_2 and make_partition().asks_eq_2
