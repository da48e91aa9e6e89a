import numpy as np
import pytest
from contacts import line, moes, starvation

from mgehl.model.frame import Frame
from mgehl.model.starvation import Starvation
from mgehl.studies.study import merged

WIDE = (-100.0, 100.0)
WITHIN = merged(moes(5.0, 5.0), {"grid": {"load_beyond": False}})
"""A light load that the film in the domain carries alone."""


def taken(found, x, y):
    """Per cent of central and minimum film that a domain takes of that on a hundred semi-axes."""
    pairs = zip(found.missing(x, y), found.missing(WIDE, WIDE), strict=True)
    return [100.0 * (1.0 - np.exp(more - less)) for less, more in pairs]


@pytest.mark.parametrize(
    "tables, x, y, central, minimum",
    [
        (moes(20.0, 10.0), (-4.275, 4.0), (-12.0, 12.0), 1.09, 1.06),
        (moes(200.0, 10.0), (-2.269, 3.0), (-4.0, 4.0), 1.39, 0.92),
        (moes(200.0, 2.0), (-1.490, 3.0), (-4.0, 4.0), 2.46, 0.79),
        (moes(100.0, 10.0), (-8.0, 3.0), (-1.639, 1.639), 0.84, 2.52),
        (WITHIN, (-5.75, 10.0), (-20.0, 20.0), -1.38, 7.5),
        (moes(100.0, 5.0, radius_y=50.8e-3), (-2.314, 3.6), (-2.776, 2.776), 4.18, 2.53),
    ],
)  # fmt: skip
def test_within_a_factor_of_two_of_solutions(tables, x, y, central, minimum):
    """Per cent taken, by pairs of solutions of 2B on 4 to 6 inlet cells."""
    estimate = max(taken(starvation(tables), x, y))
    assert 0.5 < estimate / max(central, minimum) < 2.0


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0), (1000.0, 5.0)])
def test_on_hamrock_and_dowson_s_boundary_a_ball_has_lost_some_per_cent(M, L):
    found = starvation(moes(M, L))
    boundary = 1.0 + 3.06 * found.dimensionless_film**0.58
    assert 2.0 < taken(found, (-boundary, 100.0), WIDE)[0] < 6.0


def test_a_light_load_that_is_counted_beyond_the_domain_takes_little():
    x, y = (-30.0, 3.0), (-15.0, 15.0)
    counted, within = starvation(moes(5.0, 5.0)).lost(x, y), starvation(WITHIN).lost(x, y)
    assert counted < 0.2 < 2.0 < within


@pytest.mark.parametrize("is_line", [False, True])
def test_the_suction_behind_is_kapitza_s_but_for_what_is_torn(is_line):
    """Load beyond each distance by quadrature, of a pressure K/x^3, at the most the ambient one."""
    pressed = line(1e3, 0.05) if is_line else WITHIN
    held = starvation(merged(pressed, {"contact": {"ambient_pressure": 1e5}}))
    whole, far = held.torn_until, np.geomspace(1.0, 1e5, 200_000)
    for way in (0.3 * whole, 0.9 * whole, 2.0 * whole):
        r = way * far
        sucked = np.minimum(r**-3.0, whole**-3.0) * (2.0 if is_line else r)
        beyond = float(((sucked[1:] + sucked[:-1]) * np.diff(r)).sum()) / 2.0
        assert held.behind(way) == pytest.approx(held.by_load[0] * beyond, rel=1e-3)
        assert held.way_behind(held.behind(way)) == pytest.approx(way, rel=1e-9)
    assert starvation(pressed).behind(0.1 * whole) == 0.0


@pytest.mark.parametrize("angle", [30, 90, 135, 180, 200, 270, 315])
def test_it_is_the_same_in_the_axes_of_the_solver(angle):
    ellipse = {"contact": {"radius_y": 30e-3}, "motion": {"speed": 1.0, "angle": angle}}
    found = starvation(ellipse)
    frame, x, y = Frame.of(angle)[0], (-2.0, 1.5), (-1.3, 1.8)
    turned = Starvation(found.contact.in_frame(frame), found.film)
    assert turned.lost(*frame.intervals(x, y)) == pytest.approx(found.lost(x, y), rel=1e-9)
