from dataclasses import replace
from math import log, pi

import numpy as np
import pytest
from contacts import contact_of, moes
from mpi4py import MPI
from scipy.integrate import simpson

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.model.drag import (
    kapitza_factor,
    line_drag_beyond,
    line_shear_beyond,
    point_drag_beyond,
    point_shear_beyond,
    wake_shear,
)
from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, ConstantDensity, Lubricant
from mgehl.model.rheology import Friction, Limiting, Newtonian
from mgehl.run import solve


def test_drag_beyond_grows_with_the_logarithm_of_the_domain():
    """Of a ball half of the integral of h dp/dx between two squares far away, one twice as wide: pi K R
    ln 2 [Kapitza 1955]."""
    ball = contact_of(moes(3.0, 2.0))
    square, twice = (-30.0, 30.0), (-60.0, 60.0)
    assert 60.0 * 2.0**0.5 * ball.x_scale < ball.radius_x
    between = point_drag_beyond(ball, square, square, False) - point_drag_beyond(ball, twice, twice, False)
    K = kapitza_factor(ball.lubricant, ball.speed, ball.radius_x, ball.radius_x)
    assert between == pytest.approx(pi * K * ball.radius_x * log(2.0), rel=3e-3)


def test_where_no_film_tears_the_other_side_drags_as_much():
    ball = contact_of(moes(3.0, 2.0))
    square = (-8.0, 8.0)
    upstream, both = (point_drag_beyond(ball, square, square, whole) for whole in (False, True))
    assert both == pytest.approx(2.0 * upstream)


def test_within_and_beyond_a_soft_ball_s_domain_are_one_sum():
    """By the gap of rigid bodies the sum grew by a tenth from an "auto" domain to one twice as large."""
    ball = {
        "contact": {"load": 2.0, "radius_x": 0.01, "radius_y": 0.01, "reduced_modulus": 5e6},
        "lubricant": {"viscosity": 0.1, "pressure_viscosity": 0.0, "density_law": "constant"},
        "motion": {"speed": 0.1},
        "solver": {"error": False},
    }

    def rolling(nodes, x, y):
        asked = config_from_tables(ball | {"grid": {"nodes": nodes, "x": x, "y": y}})
        friction = solve(asked, MPI.COMM_SELF).result.friction
        return friction.rolling_coefficient, friction.rolling_beyond

    near, far = rolling(65, [-1.85, 1.27], [-1.56, 1.56]), rolling(129, [-3.7, 2.54], [-3.12, 3.12])
    assert near[1] > 0.3 * near[0] and far[1] < 0.1 * far[0]
    assert sum(near) == pytest.approx(sum(far), rel=0.03)


LINE = LineContact(2e3, 0.01, 2e7, 0.05, Lubricant(Barus(0.5, 2e-8), ConstantDensity()))


def test_drag_beyond_of_a_line_falls_as_one_over_the_distance():
    """Of rigid bodies 12 eta u R/x on each body."""
    far = line_drag_beyond(LINE, (-1e4, 1e4), False)
    assert far == pytest.approx(12.0 * 0.5 * 0.05 * 0.01 / (1e4 * LINE.x_scale), rel=1e-5)
    assert line_drag_beyond(LINE, (-1e4, 1e4), True) == pytest.approx(2.0 * far)


def test_what_drags_between_two_domains_is_the_integral_between_them():
    X, dX = np.linspace(2.0, 4.0, 20001, retstep=True)
    film = LINE.flooded_film / LINE.film_scale
    H = film + LINE.dry_gap(X, None)
    between = simpson((H - film) / H**2, dx=dX)
    unit = 6.0 * LINE.lubricant.viscosity * LINE.speed * LINE.x_scale / LINE.film_scale
    near, far = (line_drag_beyond(LINE, (-end, 1.0), False) for end in (2.0, 4.0))
    assert near - far == pytest.approx(unit * between, rel=1e-6)


SLIDES = Friction(slide_to_roll=0.5)


def test_what_is_sheared_beside_a_ball_grows_with_the_logarithm_of_the_domain():
    """Far away h = r^2/2R: of a plane eta dU 4 pi R ln 2 between two squares, one twice as wide."""
    ball = replace(contact_of(moes(3.0, 2.0)), friction=SLIDES)
    square, twice = (-60.0, 60.0), (-120.0, 120.0)
    near, far = (point_shear_beyond(ball, ends, ends, True) for ends in (square, twice))
    eta_dU = ball.lubricant.viscosity * 0.5 * ball.speed
    assert near - far == pytest.approx(eta_dU * 4.0 * pi * ball.radius_x * log(2.0), rel=0.02)
    torn = point_shear_beyond(ball, square, square, False)
    assert 0.5 * near < torn < near


LIGHT = {
    "contact": {"load": 5.0, "radius_x": 0.0103, "radius_y": 0.0103, "reduced_modulus": 110e9},
    "lubricant": {"viscosity": 0.04, "pressure_viscosity": 0.0, "density_law": "constant"},
    "motion": {"speed": 2.0, "slide_to_roll": 1.0},
    "solver": {"error": False},
}  # fmt: skip


def sliding(nodes, angle=0.0, **grid):
    """Of a light ball: friction of the film, within its domain and beyond it."""
    asked = LIGHT | {"motion": LIGHT["motion"] | {"angle": angle}, "grid": {"nodes": nodes, **grid}}
    friction = solve(config_from_tables(asked), MPI.COMM_SELF).result.friction
    return np.array([friction.film_coefficient, friction.sliding_beyond])


@pytest.mark.parametrize("angle", [0.0, 45.0])
def test_within_and_beyond_a_light_ball_s_domain_are_one_sum(angle):
    """The torn film behind an "auto" domain was in neither number: a seventh of the friction."""
    narrow = {"x": [-6.0, 1.2], "y": [-6.0, 1.2]} if angle else {}
    wide = {"x": [-15.0, 10.0], "y": [-15.0, 10.0] if angle else [-12.0, 12.0]}
    near, far = sliding(65, angle, **narrow), sliding(129, angle, **wide)
    assert near[1] > near[0] and far[1] < 0.6 * far[0]
    assert near.sum() == pytest.approx(far.sum(), rel=0.03)


def test_beyond_the_domain_all_directions_are_alike():
    along, back, across = (
        sliding(65, angle, x=[-6.0, 6.0], y=[-6.0, 6.0]) for angle in (0.0, 180.0, 270.0)
    )
    np.testing.assert_allclose(back, along, rtol=1e-9)
    np.testing.assert_allclose(across, along, rtol=1e-9)


def test_behind_a_line_s_torn_film_its_oil_is_sheared_by_what_it_fills():
    line, content, end = replace(LINE, friction=SLIDES), 1e-8, 2.0
    X = end * np.geomspace(1.0, 1e4, 20001)
    gap = line.flooded_film + line.film_scale * line.dry_gap(X, None)
    between = 0.5 * 0.5 * 0.05 * line.x_scale * simpson(content / gap**2, x=X)
    found = wake_shear(line, np.array([end * line.x_scale]), None, np.array([content]))
    assert found == pytest.approx([between], rel=1e-3)


def test_what_is_sheared_beside_a_line_is_the_integral():
    line = replace(LINE, friction=SLIDES)
    X, dX = np.linspace(2.0, 4.0, 20001, retstep=True)
    gap = line.flooded_film + line.film_scale * line.dry_gap(X, None)
    between = 0.5 * 0.5 * 0.05 * line.x_scale * simpson(1.0 / gap, dx=dX)
    near, far = (line_shear_beyond(line, (-end, 1.0), False) for end in (2.0, 4.0))
    assert near - far == pytest.approx(between, rel=1e-6)


@pytest.mark.parametrize("contact", [LINE, contact_of(moes(3.0, 2.0))], ids=["line", "ball"])
def test_oil_with_a_limit_resists_no_more_than_a_part_of_the_pressure_around(contact):
    """There is none, so it is nothing."""
    limit = Friction(Limiting(0.05, Newtonian()), slide_to_roll=0.5)
    mesh = Mesh(65, 65, (-3.0, 2.0), (-2.0, 2.0))
    assert replace(contact, friction=limit).shear_beyond(mesh) == 0.0
    assert replace(contact, friction=SLIDES).shear_beyond(mesh) > 0.0
