import pytest
from contacts import line, moes, starvation

from mgehl.model.room import ALLOWED, NEAREST, PARTS, domain_for
from mgehl.studies.study import merged

NODES, FARTHEST = 257, 1000.0

CASES = [
    moes(8.0, 3.0), moes(20.0, 10.0), moes(1000.0, 10.0), moes(100.0, 8.0, radius_y=2e-3),
    moes(100.0, 8.0, radius_y=80e-3), line(50e3, 1.0), line(1e3, 0.5),
    {"contact": {"radius_y": 30e-3}, "motion": {"speed": 1.0, "angle": 30}},
]  # fmt: skip


def domain(tables):
    return domain_for(starvation(tables), NODES, FARTHEST)


@pytest.mark.parametrize("tables", CASES)
def test_it_is_large_enough_and_three_quarters_of_its_room_are_not(tables):
    found = starvation(tables)
    x, y = domain_for(found, NODES, FARTHEST)
    assert found.lost(x, y) <= ALLOWED

    def nearer(ends):
        rooms = [0.75 * (abs(end) - 1.0) for end in ends]
        return -1.0 - rooms[0], 1.0 + max(rooms[1], NEAREST)

    assert found.lost(nearer(x), y if found.contact.is_line else nearer(y)) > ALLOWED


@pytest.mark.parametrize("tables", CASES)
def test_the_centre_is_a_node_of_the_coarsest_grid(tables):
    for before, after in domain(tables):
        cells = -before / (after - before or 1.0) * PARTS
        assert cells == pytest.approx(round(cells), abs=2e-3)


@pytest.mark.parametrize("angle, side", [(0, (0, 0)), (90, (1, 0)), (180, (0, 1)), (270, (1, 1))])
def test_most_room_is_where_the_motion_comes_from(angle, side):
    axis, end = side
    found = domain({"motion": {"speed": 1.0, "angle": angle}})
    upstream, downstream, beside = found[axis][end], found[axis][1 - end], found[1 - axis][1]
    assert abs(upstream) > beside > abs(downstream)
    assert found[1 - axis] == (-beside, beside)
    assert abs(upstream) == -domain({"motion": {"speed": 1.0}})[0][0]


def test_oil_that_the_pressure_around_holds_together_has_as_much_room_behind():
    """Not under a load beside which that pressure is nothing. Film that never tears has such room, too."""
    held, never = {"contact": {"ambient_pressure": 1e6}}, {"discretization": {"cavitation": False}}
    for light in (moes(3.0, 3.0), line(1e3, 0.05)):
        for whole in (held, never):
            upstream, downstream = domain(merged(light, whole))[0]
            assert downstream >= 0.8 * -upstream > 2.0 * domain(light)[0][1]
    assert domain(merged(line(50e3, 1.0), held))[0] == pytest.approx(domain(line(50e3, 1.0))[0], rel=0.01)


def test_a_soft_layer_s_contact_has_room_for_what_is_not_known_of_it():
    coating = {"thickness": 40e-6, "modulus": 4e9}
    tables = {"contact": {"load": 100.0, "deformation": "coated"}, "coating": coating}
    found = starvation(tables | {"motion": {"speed": 1e-6}})
    x, _ = domain_for(found, NODES, FARTHEST)
    assert found.contact.reach > 1.3 * 1.3
    assert x[1] >= found.contact.reach
