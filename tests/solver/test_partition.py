from functools import partial

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.layers import by_reduced_pressure
from mgehl.solver.partition import Changes, Partition

THRESHOLD = 1e-3
NODE = (4, 4)
LAW = InterfaceConditions(THRESHOLD)
BESIDE = {"W": (4, 3), "E": (4, 5), "S": (3, 4), "N": (5, 4)}


@pytest.fixture
def make_partition(make_problem):
    def make(law=LAW, **scheme):
        return Partition(make_problem(nodes=9, scheme=Scheme(contact_law=law, **scheme)))

    return make


@pytest.fixture
def state(state, tiny_problem):
    state.P[:] = state.p[:] = np.where(tiny_problem.boundary, 0.0, 0.5)
    return state


def changed_by(rule, state, **expected):
    """Apply a rule; the changes that it tells are these and no others."""
    changes = Changes()
    rule(state, changes)
    assert changes == Changes(**expected)
    assert changes.total == sum(expected.values())


class TestTension:
    @pytest.mark.parametrize("status, filling", [(LUBRICATED, 1.0), (CONTACT, 0.0)])
    def test_it_is_cut(self, make_partition, state, status, filling):
        """Torn film leaves a full gap behind, contact an empty one, any number of times."""
        partition, told = make_partition(), "cavitated" if status == LUBRICATED else "released"
        for _ in range(3):
            state.P[NODE], state.status[NODE], state.filling[:] = -0.1, status, 0.3
            changed_by(partition.cut_tension, state, **{told: 1})
            assert state.status[NODE] == CAVITATED and state.P[NODE] == 0.0
            assert state.filling[NODE] == filling
            assert np.count_nonzero(state.filling == 0.3) == state.filling.size - 1

    @pytest.mark.parametrize("status", [LUBRICATED, CAVITATED, CONTACT])
    def test_pressures_that_are_not_negative_stay(self, make_partition, state, status):
        state.P[NODE], state.status[NODE] = 0.0, status
        before = state.copy()
        changed_by(make_partition().cut_tension, state)
        np.testing.assert_array_equal(state.P, before.P)
        np.testing.assert_array_equal(state.status, before.status)


class TestEnteringContact:
    @pytest.mark.parametrize("status", [LUBRICATED, CAVITATED])
    @pytest.mark.parametrize("gap, enters", [(-0.1, True), (THRESHOLD, True), (1.01 * THRESHOLD, False)])
    def test_fluid_whose_gap_is_closed(self, make_partition, state, status, gap, enters):
        state.status[NODE], state.H[NODE], state.H[0, 4] = status, gap, -0.1  # the boundary never enters
        changed_by(make_partition().enter_contact, state, entered=int(enters))
        assert state.status[NODE] == (CONTACT if enters else status)

    @pytest.mark.parametrize(
        "motion, sides, enters",
        [((1.0, 0.0), "WE", True), ((1.0, 0.0), "SN", False), ((0.6, 0.8), "WE", False),
         ((0.6, 0.8), "WESN", True)],
    )  # fmt: skip
    def test_fluid_shut_in_along_the_motion_enters(self, make_partition, state, motion, sides, enters):
        for side in sides:
            state.status[BESIDE[side]] = CONTACT
        changed_by(make_partition(motion=motion).enter_contact, state, entered=int(enters))
        assert state.status[NODE] == (CONTACT if enters else LUBRICATED)

    def test_by_the_unified_equations_bodies_overlap(self, make_partition, state):
        state.H[NODE] = -0.1
        changed_by(make_partition(law=UnifiedEquations()).enter_contact, state)

    @pytest.mark.parametrize(
        "steps, gap, enters", [(1, -1e-12, False), (2, 0.5 * THRESHOLD, False), (2, -1e-6, True)]
    )
    def test_a_released_node_comes_back_if_bodies_overlap(self, make_partition, state, steps, gap, enters):
        partition = make_partition()
        state.P[NODE], state.status[NODE], state.H[NODE] = -0.1, CONTACT, gap
        for _ in range(steps):
            partition.cut_tension(state, Changes())
        changed_by(partition.enter_contact, state, entered=int(enters))
        assert (state.status[NODE] == CONTACT) == enters


@pytest.mark.parametrize(
    "law, status, H, filling, fills",
    [(LAW, CAVITATED, 1.0, 1.01, True), (LAW, CAVITATED, 1.0, 1.0, False),
     (LAW, LUBRICATED, 1.0, 2.0, False), (LAW, CONTACT, 1.0, 2.0, False),
     (LAW, CAVITATED, 0.0, 2.0, False), (BoundaryFilm(THRESHOLD), CAVITATED, 0.0, 2.0, False),
     (UnifiedEquations(), CAVITATED, -0.1, 2.0, True)],
)  # fmt: skip
def test_a_cavity_that_holds_more_than_its_gap_fills(make_partition, state, law, status, H, filling, fills):
    state.status[NODE], state.H[NODE], state.filling[NODE] = status, H, filling
    changed_by(make_partition(law=law).fill, state, filled=int(fills))
    assert state.status[NODE] == (LUBRICATED if fills else status)


def test_contents_are_between_nothing_and_what_the_gap_holds(make_partition, state):
    state.filling[4, 3:6] = -0.1, 0.3, 1.2
    make_partition().fit(state)
    assert state.filling[4, 3:6].tolist() == [0.0, 0.3, 1.0]


def test_the_fluid_has_a_pressure_of_its_own_in_contact_alone(make_partition, state):
    state.status[4, 3:6] = CONTACT, CONTACT, CAVITATED
    state.P[4, 5], state.p[:] = 0.0, 0.2
    state.p[4, 3] = -0.1
    expected = state.P.copy()
    expected[4, 3:5] = 0.0, 0.2
    make_partition(law=BoundaryFilm(THRESHOLD)).fit(state)
    np.testing.assert_array_equal(state.p, expected)


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
        """It has the pressure of its own step, so that it is not let go at once, and shuts in no fluid."""
        state.p[4, 3] = state.P[4, 3] + 0.1
        state.H[4, [3, 5]] = 0.99 * self.FILM
        state.H[4, 4] = 1.01 * self.FILM
        changed_by(partition.enter_contact, state, entered=2)
        assert state.status[4, 3:6].tolist() == [CONTACT, LUBRICATED, CONTACT]
        assert not partition.past.turns.any() and state.p[4, 3] == state.P[4, 3]
        changed_by(partition.open_contact, state)

    @pytest.mark.parametrize("more, opens", [(0.1, True), (0.0, False), (-0.1, False)])
    def test_it_opens_where_the_fluid_presses_harder(self, partition, pressed, more, opens):
        """A wider gap alone opens nothing."""
        pressed.H[4, 5:7] = 1.0
        pressed.p[4, 3:7] = pressed.P[4, 3:7] - 0.1
        pressed.p[NODE] = pressed.P[NODE] + more
        changed_by(partition.open_contact, pressed, released=int(opens))
        assert pressed.status[4, 3:7].tolist() == [
            CONTACT, LUBRICATED if opens else CONTACT, CONTACT, CONTACT,
        ]  # fmt: skip

    def test_contact_opens_with_all_behind_it_once(self, make_partition, pressed):
        """A film went on by a node a step."""
        bare = make_partition(law=BoundaryFilm(self.FILM))
        bare.passes_on = True
        for released in (3, 1):
            pressed.status[4, 3:7], pressed.p[NODE] = CONTACT, pressed.P[NODE] + 0.1
            changed_by(bare.open_contact, pressed, released=released)
            assert np.count_nonzero(pressed.status[4, 4:7] == LUBRICATED) == released

    @pytest.mark.parametrize("asked, opens", [(0.9, False), (1.1, True)])
    def test_it_opens_at_once_where_no_pressure_drives_that(self, partition, pressed, asked, opens):
        """`asked` is a part of what an infinite pressure would drive. A film waited at each node."""
        pressed.p[NODE], stiffening = pressed.P[NODE] - 1.0, 20.0
        pressed.p[NODE] += by_reduced_pressure(np.array(asked) / stiffening, stiffening, at_once=True)
        changed_by(partition.open_contact, pressed, released=int(opens))

    def test_what_fluid_presses_under_is_lifted_and_not_torn_apart(self, partition, pressed):
        """It opened empty, was closed by the films beside it, and so on: a polymer was not found."""
        pressed.P[NODE], pressed.p[NODE] = -0.1, 0.1
        changed_by(partition.cut_tension, pressed)
        assert pressed.P[NODE] == 0.0 and pressed.status[NODE] == CONTACT
        changed_by(partition.open_contact, pressed, released=1)
        assert pressed.status[NODE] == LUBRICATED

    def test_what_has_opened_does_not_close_before_the_next_step(self, partition, pressed):
        pressed.p[NODE] += 0.1
        pressed.H[NODE] *= 0.99
        partition.open_contact(pressed, Changes())
        changed_by(partition.enter_contact, pressed)
        partition.cut_tension(pressed, Changes())
        changed_by(partition.enter_contact, pressed, entered=1)


@pytest.mark.parametrize("in_turn", [False, True])
@pytest.mark.parametrize(
    "rule, told, new",
    [("cut_tension", "cavitated", CAVITATED), ("fill", "filled", LUBRICATED),
     ("open_contact", "released", LUBRICATED)],
)  # fmt: skip
def test_neighbours_change_at_once_or_in_turn(make_partition, state, rule, told, new, in_turn):
    """Three neighbours, of which in turn the middle one alone changes, which asks most; and one apart.

    What has to wait keeps what the step gave it.
    """
    partition = make_partition(law=BoundaryFilm(1e-3))
    for where, size in (((4, slice(2, 5)), np.array([0.1, 0.3, 0.2])), ((2, 7), 0.01)):
        if rule == "cut_tension":
            state.P[where] = -size
        elif rule == "fill":
            state.status[where], state.filling[where] = CAVITATED, 1.0 + size
        else:
            state.status[where], state.H[where], state.p[where] = CONTACT, 1e-3, state.P[where] + size
    changed_by(partial(getattr(partition, rule), in_turn=in_turn), state, **{told: 2 if in_turn else 4})
    assert state.status[2, 7] == new
    assert (state.status[4, 2:5] == new).tolist() == ([False, True, False] if in_turn else 3 * [True])
    if rule == "cut_tension":
        assert state.P[4, 2:5].tolist() == ([-0.1, 0.0, -0.2] if in_turn else 3 * [0.0])
        assert state.P[2, 7] == 0.0
