"""What drags the plate of a pad, beside the closed form of a plane one."""

from math import log

import pytest

import mgehl

ETA, SPEED, LENGTH, INLET, EXIT, WIDTH = 0.04, 2.0, 0.05, 60e-6, 30e-6, 0.08
PAD = {
    "contact.kind": "wedge", "wedge.width": WIDTH, "wedge.sides": "closed", "lubricant.viscosity": ETA,
    "motion.speed": SPEED,
}  # fmt: skip
BY_FILMS = {"wedge.length": LENGTH, "wedge.inlet_film": INLET, "wedge.exit_film": EXIT}
SLOPE = (INLET - EXIT) / LENGTH
BY_SLOPE = {"wedge.slope": SLOPE, "wedge.exit": EXIT / SLOPE, "wedge.inlet": INLET / SLOPE}


def solved(nodes=129, **more):
    told = {key.replace("__", "."): value for key, value in more.items()}
    return mgehl.solve(mgehl.load(None, PAD | {"grid.nodes": nodes} | told)).summary


@pytest.mark.parametrize(
    ("pad", "centre"),
    [(BY_FILMS, 28.4344), (BY_SLOPE, 71.5656), (BY_SLOPE | {"wedge.reversed": True}, -71.5656)],
    ids=["by its films", "by its slope", "turned"],
)
def test_a_plane_pad_drags_as_its_closed_form_says(pad, centre):
    """eta u L/h_2 (4 ln k/(k - 1) - 6/(k + 1)) a width, k the ratio of its films; error of second order."""
    k = INLET / EXIT
    exact = ETA * SPEED * LENGTH * WIDTH / EXIT * (4.0 * log(k) / (k - 1.0) - 6.0 / (k + 1.0))
    coarse, fine = (solved(nodes, **pad) for nodes in (65, 129))
    assert fine.drag_N == pytest.approx(exact, rel=2e-5)
    assert abs(coarse.drag_N - exact) == pytest.approx(4.0 * abs(fine.drag_N - exact), rel=0.2)
    assert fine.drag_power_W == pytest.approx(SPEED * fine.drag_N)
    assert fine.pressure_centre_mm == pytest.approx(centre, abs=0.005)


@pytest.mark.parametrize("turned", [False, True])
def test_before_a_wall_the_pressure_drags_as_no_flow_asks(turned):
    """A blocked exit: 4 eta u/h at all x. The half cell beside it was left out, half a per cent."""
    pad = BY_SLOPE | {"wedge.blocked_exit": True, "wedge.reversed": turned}
    exact = 4.0 * ETA * SPEED * WIDTH * log(INLET / EXIT) / SLOPE
    coarse, fine = (solved(nodes, **pad, discretization__couette="2C") for nodes in (65, 129))
    assert fine.drag_N == pytest.approx(exact, rel=5e-5)
    assert abs(coarse.drag_N - exact) == pytest.approx(4.0 * abs(fine.drag_N - exact), rel=0.2)


def test_open_sides_bear_less_and_drag_hardly_less():
    """Of a pad without a slope the oil is sheared alone: eta u/h on all of it."""
    flat = {
        "wedge.length": LENGTH,
        "wedge.inlet_film": EXIT,
        "wedge.exit_film": EXIT,
        "wedge.sides": "open",
    }
    level = solved(65, **flat)
    assert level.drag_N == pytest.approx(ETA * SPEED * LENGTH * WIDTH / EXIT, rel=1e-9)
    closed, opened = (solved(65, **BY_FILMS, wedge__sides=sides) for sides in ("closed", "open"))
    assert opened.load_N < 0.8 * closed.load_N and 0.8 * closed.drag_N < opened.drag_N < closed.drag_N


def test_torn_film_drags_by_what_fills_the_gap():
    """A gap that widens from h_1 to h_2 is filled by h_1/h behind its inlet: eta u L/h_2 a width."""
    widening = {"wedge.length": LENGTH, "wedge.inlet_film": EXIT, "wedge.exit_film": INLET}
    torn = solved(129, **widening, discretization__cavitation=True)
    assert torn.cavitated_nodes > 100
    assert torn.drag_N == pytest.approx(ETA * SPEED * WIDTH * LENGTH / INLET, rel=0.01)
