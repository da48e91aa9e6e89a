from dataclasses import replace

import numpy as np
import pytest
from contacts import contact_of, moes
from scipy.sparse import diags
from scipy.sparse.linalg import spsolve

from mgehl.model.far_field import missing_load, missing_share
from mgehl.model.frame import Frame

X, Y = (-20.0, 2.0), (-12.0, 12.0)
WHOLE = 0.3513
"""Load of the gap 1 + x^2 + y^2 on the whole plane, over 12 eta u times its units: by another code, whose
sides are 6000 away, and the film of 8.88 um of a ball of 10 mm under 0.1 N at 0.025 N/m."""
ALONG = (1.0, 0.0)
ELLIPSE = {"radius_x": 10e-3, "radius_y": 40e-3}


def contact(M=3.0, L=2.0, angle=0.0, **bodies):
    return contact_of(moes(M, L, **bodies), {"motion": {"angle": angle}})


def relaxed_load(x, y, cells, squeezed=None):
    """Load of the gap 1 + x^2 + y^2 on a rectangle whose film tears at p = 0, by central differences; of
    bodies whose lengths have the ratio `squeezed` under an approach, not a motion."""
    X, Y = (np.linspace(*ends, cells + 1) for ends in (x, y))
    dx, dy = X[1] - X[0], Y[1] - Y[0]

    def cubed(x, y):
        return (1.0 + x**2 + y[:, None] ** 2) ** 3

    half_x, half_y = X[:-1] + 0.5 * dx, Y[:-1] + 0.5 * dy
    inner = np.s_[1:-1]
    west, east = cubed(half_x[:-1], Y[inner]) / dx**2, cubed(half_x[1:], Y[inner]) / dx**2
    dy_2 = (dy / (squeezed or 1.0)) ** 2
    south, north = cubed(X[inner], half_y[:-1]) / dy_2, cubed(X[inner], half_y[1:]) / dy_2
    wedge = np.broadcast_to(-2.0 * X[inner] if squeezed is None else 1.0, west.shape).ravel()
    before = [np.append(each.ravel(), 0.0) for each in (west * (X[inner] > X[1]), south)]
    diagonals = [
        -(west + east + south + north).ravel(), before[0][1:-1], (east * (X[inner] < X[-2])).ravel()[:-1],
        before[1][west.shape[1] : -1], north.ravel()[: -west.shape[1]],
    ]  # fmt: skip
    A = diags(diagonals, [0, -1, 1, -west.shape[1], west.shape[1]], format="csr")
    film, moved = np.ones(wedge.size, dtype=bool), True
    while moved:
        p = np.zeros(wedge.size)
        p[film] = spsolve(A[film][:, film], -wedge[film])
        torn, fills = film & (p < 0.0), ~film & (A @ p + wedge > 1e-9)
        film, moved = film & ~torn | fills, (torn | fills).any()
    return p.sum() * dx * dy


@pytest.mark.parametrize("x, y", [((-6.6, 1.2), (-4.4, 4.4)), ((-12.0, 3.0), (-6.0, 6.0))])
def test_what_is_missing_and_what_a_rectangle_carries_is_all_of_the_load(x, y):
    coarse, fine = (relaxed_load(x, y, cells) for cells in (48, 96))
    assert fine + (fine - coarse) / 3.0 + missing_load(x, y, 1.0, ALONG) == pytest.approx(WHOLE, rel=2e-3)


@pytest.mark.parametrize("ratio", [1.0, 0.4])
def test_what_is_squeezed_beyond_a_rectangle_and_what_it_carries_is_all_of_the_load(ratio):
    """p = k/h^2 with k = 1/(4 (1 + ratio^2)) on the whole plane."""
    x, y, whole = (-6.6, 1.2), (-4.4, 3.0), 0.25 * np.pi / (1.0 + ratio**2)
    coarse, fine = (relaxed_load(x, y, cells, ratio) for cells in (96, 192))
    missing = missing_load(x, y, ratio, None)
    assert missing > 0.1 * whole
    assert fine + (fine - coarse) / 3.0 + missing == pytest.approx(whole, rel=2e-3)


def test_where_no_film_tears_what_is_sucked_is_what_is_pressed():
    """As much is missing on either side; on one side alone what the other one carries."""
    torn, whole = 0.0, 1e9
    assert missing_load((-5.0, 5.0), Y, 1.0, ALONG, whole) == pytest.approx(0.0, abs=1e-9)
    before, behind = (missing_load(x, Y, 1.0, ALONG, whole) for x in ((-5.0, 2.0), (-2.0, 5.0)))
    assert before == pytest.approx(-behind, rel=1e-6) and before < 0.0
    some = [missing_load((-20.0, 2.0), Y, 1.0, ALONG, around) for around in (torn, 1e-3, 1e-2, whole)]
    assert some == sorted(some, reverse=True) and some[0] == missing_load((-20.0, 2.0), Y, 1.0, ALONG)


def test_far_away_it_falls_as_one_over_the_distance():
    """Twice as far the half of it, whatever the shape of the bodies."""
    for ratio in (0.2, 1.0, 2.0):
        near, far = (missing_load((-d, d), (-d, d), ratio, ALONG) for d in (20.0, 40.0))
        assert near == pytest.approx(2.0 * far, rel=0.02)


@pytest.mark.parametrize("angle", [90, 135, 200, 315])
def test_it_is_the_same_in_the_axes_of_the_solver(angle):
    ball = contact(angle=angle, **ELLIPSE)
    frame = Frame.of(angle)[0]
    here = [tuple(end * scale for end in pair) for pair, scale in ((X, ball.x_scale), (Y, ball.y_scale))]
    there = missing_share(ball.in_frame(frame), *frame.intervals(*here))
    assert there == pytest.approx(missing_share(ball, *here), rel=1e-6)


@pytest.mark.parametrize("M, counted", [(3.0, 1.0), (8.0, 1.0), (16.0, 0.0), (200.0, 0.0)])
def test_the_load_beyond_is_counted_where_the_film_answers_to_it(M, counted):
    assert contact(M, 5.0).counted_beyond == counted
    for said in (True, False):
        assert replace(contact(M, 5.0), load_beyond=said).counted_beyond == said


def test_films_do_not_jump_where_it_begins_to_be_counted():
    """Where M grows by one per cent the part that is counted falls by 0.03 at the most."""
    loads = np.geomspace(7.0, 18.0, 100)
    counted = [contact(M, 5.0).counted_beyond for M in loads]
    assert counted[0] == 1.0 and counted[-1] == 0.0
    assert 0.0 <= min(-np.diff(counted)) and max(-np.diff(counted)) < 0.03
