from math import pi, sqrt

import numpy as np
import pytest

from mgehl.model.flash import MovingHeat, Solid, shared

STEEL, GLASS = Solid(46.0, 3.6e6), Solid(1.1, 2.1e6)
RADIUS, FLUX = 2e-4, 1e9


def circle(nodes, semi):
    """Even heat on a circle, or semi-ellipsoidal heat, of a mean of `FLUX` over it; and the cell."""
    x = np.linspace(-1.2, 1.2, nodes)
    r2 = x[:, None] ** 2 + x**2
    heat = np.sqrt(np.maximum(1.0 - r2, 0.0)) if semi else (r2 < 1.0) * 1.0
    cell = RADIUS * (x[1] - x[0])
    return FLUX * pi * RADIUS**2 / (heat.sum() * cell**2) * heat, cell


def of_tian_and_kennedy(peclet, semi):
    factor, shift = (2.32, 1.234) if semi else (2.0, 1.273)
    return factor * FLUX * RADIUS / (STEEL.conductivity * sqrt(pi * (shift + peclet)))


@pytest.mark.parametrize("semi", [False, True])
@pytest.mark.parametrize("peclet", [0.0, 1e-3, 1e3, 1e4])
def test_a_circle_slow_and_fast(peclet, semi):
    """Pe = u a/(2 kappa). The formula lies 2 % off between its limits."""
    heat, cell = circle(129, semi)
    velocity = 2.0 * STEEL.diffusivity * peclet / RADIUS, 0.0
    rise = MovingHeat(STEEL, velocity, heat.shape, cell, cell).rise(heat)
    assert rise.max() == pytest.approx(of_tian_and_kennedy(peclet, semi), rel=0.005)


@pytest.mark.parametrize("semi, constant, at", [(False, 1.128, 1.0), (True, 1.1115, 0.65)])
def test_a_fast_band_on_two_bodies(semi, constant, at):
    """dT = c q'/[sqrt(2 b) (B_1 sqrt u_1 + B_2 sqrt u_2)]: both have one temperature."""
    x = np.linspace(-1.2, 1.2, 513)
    heat = np.sqrt(np.maximum(1.0 - x**2, 0.0)) if semi else (np.abs(x) < 1.0) * 1.0
    cell = RADIUS * (x[1] - x[0])
    heat *= 1e5 / (heat.sum() * cell)
    bodies = ((STEEL, 30.0), (GLASS, 10.0))
    sources = (MovingHeat(solid, (u, 0.0), (1, 513), cell, 1.0) for solid, u in bodies)
    first, second = shared(heat[None], *sources, np.zeros((1, 513)))
    B = [sqrt(solid.conductivity * solid.capacity * u) for solid, u in bodies]
    assert first.max() == pytest.approx(constant * 1e5 / (sqrt(2.0 * RADIUS) * sum(B)), rel=0.002)
    here = heat[None] > 0.0
    np.testing.assert_allclose(second[here], first[here], atol=1e-3 * first.max())
    assert x[first.argmax()] == pytest.approx(at, abs=0.01)


def test_a_band_on_a_body_at_rest_grows_for_ever():
    with pytest.raises(ValueError, match="no steady temperature"):
        MovingHeat(STEEL, (0.0, 0.0), (1, 65), 1e-6, 1.0)


@pytest.mark.parametrize("turned", [np.transpose, lambda map_: map_[:, ::-1]])
def test_heat_moves_with_its_body(turned):
    """Along y as along x, and against x."""
    heat, cell = circle(33, True)
    heat[:16] *= 0.5
    u = 20.0 * STEEL.diffusivity / RADIUS
    along_x = MovingHeat(STEEL, (u, 0.0), heat.shape, cell, cell).rise(heat)
    velocity = (0.0, u) if turned is np.transpose else (-u, 0.0)
    other = MovingHeat(STEEL, velocity, heat.shape, cell, cell).rise(turned(heat))
    np.testing.assert_allclose(other, turned(along_x), rtol=1e-3)


def test_a_film_that_insulates_gives_each_body_half_of_the_heat():
    heat, cell = circle(33, True)
    sources = [MovingHeat(solid, (0.5, 0.0), heat.shape, cell, cell) for solid in (STEEL, GLASS)]
    first, second = shared(heat, *sources, np.full(heat.shape, 1.0))
    np.testing.assert_allclose(first, sources[0].rise(0.5 * heat), rtol=1e-3, atol=1e-6)
    np.testing.assert_allclose(second, sources[1].rise(0.5 * heat), rtol=1e-3, atol=1e-6)
