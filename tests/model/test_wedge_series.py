from math import pi

import numpy as np
import pytest
from scipy.integrate import quad

from mgehl.model.wedge_series import WedgeSeries, struve_difference

EXIT, INLET, WIDTH = 20.0, 50.0, 20.0
BLOCKED, OPEN = (WedgeSeries(EXIT, INLET, WIDTH, blocked) for blocked in (True, False))

both = pytest.mark.parametrize("bearing", [BLOCKED, OPEN], ids=["blocked", "open"])


@pytest.mark.parametrize(
    "bearing, pressures, load",
    [
        # P(30, 0) = 0.01856448, also by collocation below.
        (BLOCKED, [0.063764, 0.018564, 0.005199], 7.7414),
        (OPEN, [0.005433, 0.007829, 0.003824], 2.0239),
    ],
    ids=["blocked", "open"],
)
def test_paper_wedge(bearing, pressures, load):
    np.testing.assert_allclose(bearing.pressure([22.0, 30.0, 40.0]), pressures, rtol=0, atol=0.5e-6)
    assert bearing.load() == pytest.approx(load, abs=0.5e-4)


@both
def test_closed_forms_are_what_the_series_sums_to(bearing):
    """The plain partial sums tend to the accelerated pressure, which has six digits and more."""
    X, Y = np.array([EXIT, EXIT, 20.1, 22.0, 35.0]), np.array([0.0, 8.0, 8.0, 3.0, -9.0])
    long = WedgeSeries(EXIT, INLET, WIDTH, bearing.blocked, terms=10000)
    k = (2 * np.arange(long.terms) + 1) * pi / long.width
    plain = (long.modes(X) * np.cos(k * Y[:, None])).sum(axis=1)
    np.testing.assert_allclose(plain, long.pressure(X, Y), rtol=0, atol=1e-8)
    np.testing.assert_allclose(bearing.pressure(X, Y), long.pressure(X, Y), rtol=1e-7, atol=2e-9)


@both
def test_load_is_the_integral_of_the_pressure(bearing):
    t, w = np.polynomial.legendre.leggauss(60)
    X, Y = 35.0 + 15.0 * t, 10.0 * t
    P = bearing.pressure(X[:, None], Y[None, :])
    assert 150.0 * w @ P @ w == pytest.approx(bearing.load(), rel=1e-5)


def test_wide_bearing_is_one_dimensional():
    """Away from the sides, by as much as some of its lengths: X^3 dP/dX + 6 X = 0."""
    X = np.linspace(EXIT, INLET, 16)
    P = 6.0 * (1.0 / X - 1.0 / INLET)
    wide = WedgeSeries(EXIT, INLET, 600.0, True)
    np.testing.assert_allclose(wide.pressure(X), P, rtol=0, atol=2e-7)
    np.testing.assert_allclose(wide.pressure(X, 60.0), P, rtol=0, atol=2e-6)


def test_narrow_bearing_is_short():
    """3 (width^2/4 - Y^2)/X^3 in the middle, up to (width/X)^2; no overflow at k X of 1e5."""
    narrow = WedgeSeries(EXIT, INLET, 0.5, True)
    assert narrow.pressure(35.0, 0.1) == pytest.approx(3.0 * (0.0625 - 0.01) / 35.0**3, rel=1e-3)
    assert np.isfinite(narrow.modes([EXIT, 35.0, INLET])).all()


@pytest.mark.parametrize("z", [0.1, 1.0, pi, 8.0, 40.0, 50.0, 300.0])
def test_struve_difference(z):
    D, slope = struve_difference(z)
    integral = quad(lambda t: (1.0 + t * t) ** -1.5, 0.0, np.inf, weight="sin", wvar=z, epsabs=1e-13)[0]
    assert D == pytest.approx(2.0 / (pi * z) * integral, abs=1e-12)
    h = 1e-3 * z
    west2, west, east, east2 = (struve_difference(z + j * h)[0] for j in (-2, -1, 1, 2))
    assert slope == pytest.approx((west2 - 8.0 * west + 8.0 * east - east2) / (12.0 * h), rel=1e-8)
