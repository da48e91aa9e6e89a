from math import pi

import numpy as np
import pytest
from scipy.integrate import quad

from mgehl.model.wedge_series import WedgeSeries, one_dimensional, struve_difference

EXIT, INLET, WIDTH = 20.0, 50.0, 20.0
BLOCKED, OPEN = (WedgeSeries(EXIT, INLET, WIDTH, blocked) for blocked in (True, False))

both = pytest.mark.parametrize("bearing", [BLOCKED, OPEN], ids=["blocked", "open"])


def modal_source(bearing):
    """k and c of 1 = sum of c cos(k Y), shape (terms,)."""
    n = 2 * np.arange(bearing.terms) + 1
    return n * pi / bearing.width, 4.0 / (n * pi) * (-1.0) ** ((n - 1) // 2)


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
    """Centre line at X = 22, 30 and 40 mm, and the load."""
    np.testing.assert_allclose(bearing.pressure([22.0, 30.0, 40.0]), pressures, rtol=0, atol=0.5e-6)
    assert bearing.load() == pytest.approx(load, abs=0.5e-4)


@both
def test_modes_agree_with_collocation(bearing):
    """X^3 f'' + 3 X^2 f' - k^2 X^3 f = -6 c in 100 Chebyshev points, with no special function."""
    x = np.polynomial.chebyshev.chebpts2(100)
    X = 0.5 * (EXIT + INLET) + 0.5 * (INLET - EXIT) * x
    V = np.polynomial.chebyshev.chebvander(x, 99)
    columns = [np.polynomial.chebyshev.Chebyshev.basis(j, domain=(EXIT, INLET)) for j in range(100)]
    V1 = np.stack([column.deriv()(X) for column in columns], axis=1)
    V2 = np.stack([column.deriv(2)(X) for column in columns], axis=1)
    k, c = modal_source(bearing)
    modes = bearing.modes(X)
    for m in (0, 1, 2, 10):
        A = (X**3)[:, None] * V2 + 3.0 * (X**2)[:, None] * V1 - k[m] ** 2 * (X**3)[:, None] * V
        right = np.full(100, -6.0 * c[m])
        A[-1], right[-1] = V[-1], 0.0
        A[0], right[0] = (V1[0], -6.0 * c[m] / EXIT**2) if bearing.blocked else (V[0], 0.0)
        expected = V @ np.linalg.solve(A, right)
        np.testing.assert_allclose(modes[:, m], expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@both
def test_modes_satisfy_the_equation(bearing):
    """Central differences, fourth order, with a step of 1/100 of the wave length."""
    k, c = modal_source(bearing)
    for m in (0, 3, 30, 300):
        h = 0.01 / k[m]
        X = np.array([EXIT + 3.0 * h, EXIT + 20.0 * h, 0.5 * (EXIT + INLET), INLET - 3.0 * h])
        west2, west, f, east, east2 = (bearing.modes(X + j * h)[:, m] for j in (-2, -1, 0, 1, 2))
        first = (west2 - 8.0 * west + 8.0 * east - east2) / (12.0 * h)
        second = (-west2 + 16.0 * west - 30.0 * f + 16.0 * east - east2) / (12.0 * h**2)
        sides = X**3 * second + 3.0 * X**2 * first - k[m] ** 2 * X**3 * f
        np.testing.assert_allclose(sides, -6.0 * c[m], rtol=1e-6)


@both
def test_modes_at_the_inlet(bearing):
    assert np.abs(bearing.modes(INLET)).max() < 1e-15 * np.abs(bearing.modes(30.0)).max()


def test_modes_at_an_open_exit():
    assert np.abs(OPEN.modes(EXIT)).max() < 1e-15


def test_modes_at_a_blocked_exit():
    """f' = -6 c/X^2, by one-sided differences of third order."""
    k, c = modal_source(BLOCKED)
    for m in (0, 1, 10, 100, 799):
        h = 0.002 / k[m]
        f = np.array([BLOCKED.modes(EXIT + j * h)[m] for j in range(4)])
        slope = f @ [-11.0, 18.0, -9.0, 2.0] / (6.0 * h)
        assert slope == pytest.approx(-6.0 * c[m] / EXIT**2, rel=1e-7)


@both
def test_no_pressure_at_sides_and_inlet(bearing):
    X, Y = np.linspace(EXIT, INLET, 13), np.linspace(-0.5 * WIDTH, 0.5 * WIDTH, 13)
    assert np.abs(bearing.pressure(X, 0.5 * WIDTH)).max() < 1e-15
    assert np.abs(bearing.pressure(X, -0.5 * WIDTH)).max() < 1e-15
    assert np.abs(bearing.pressure(INLET, Y)).max() < 1e-9


def test_no_pressure_at_an_open_exit():
    assert np.abs(OPEN.pressure(EXIT, np.linspace(-0.5 * WIDTH, 0.5 * WIDTH, 13))).max() < 2e-8


def test_no_flow_through_a_blocked_exit():
    """X^3 dP/dX + 6 X = 0 of the summed series, by one-sided differences."""
    h = 0.02
    for Y in (0.0, 4.0, -8.0):
        P = BLOCKED.pressure(EXIT + h * np.arange(4), Y)
        assert EXIT**3 * (P @ [-11.0, 18.0, -9.0, 2.0]) / (6.0 * h) == pytest.approx(-6.0 * EXIT, rel=1e-4)


@both
def test_closed_forms_are_what_the_series_sums_to(bearing):
    """The plain partial sums tend to the accelerated pressure, which has six digits and more."""
    X, Y = np.array([EXIT, EXIT, 20.1, 22.0, 35.0]), np.array([0.0, 8.0, 8.0, 3.0, -9.0])
    long = WedgeSeries(EXIT, INLET, WIDTH, bearing.blocked, terms=10000)
    k, _ = modal_source(long)
    plain = (long.modes(X) * np.cos(k * Y[:, None])).sum(axis=1)
    np.testing.assert_allclose(plain, long.pressure(X, Y), rtol=0, atol=1e-8)
    np.testing.assert_allclose(bearing.pressure(X, Y), long.pressure(X, Y), rtol=1e-7, atol=2e-9)


@both
def test_load_is_the_integral_of_the_pressure(bearing):
    t, w = np.polynomial.legendre.leggauss(60)
    X, Y = 35.0 + 15.0 * t, 10.0 * t
    P = bearing.pressure(X[:, None], Y[None, :])
    assert 150.0 * w @ P @ w == pytest.approx(bearing.load(), rel=1e-5)


@both
def test_load_does_not_depend_on_the_number_of_terms(bearing):
    few = WedgeSeries(EXIT, INLET, WIDTH, bearing.blocked, terms=200)
    assert few.load() == pytest.approx(bearing.load(), rel=1e-8)


def test_wide_bearing_is_one_dimensional():
    """Away from the sides, by as much as some of its lengths."""
    X = np.linspace(EXIT, INLET, 16)
    wide = WedgeSeries(EXIT, INLET, 600.0, True)
    np.testing.assert_allclose(wide.pressure(X), one_dimensional(X, INLET), rtol=0, atol=2e-7)
    np.testing.assert_allclose(wide.pressure(X, 60.0), one_dimensional(X, INLET), rtol=0, atol=2e-6)


def test_narrow_bearing_is_short():
    """3 (width^2/4 - Y^2)/X^3 in the middle, up to (width/X)^2; no overflow at k X of 1e5."""
    narrow = WedgeSeries(EXIT, INLET, 0.5, True)
    assert narrow.pressure(35.0, 0.1) == pytest.approx(3.0 * (0.0625 - 0.01) / 35.0**3, rel=1e-3)
    assert np.isfinite(narrow.modes([EXIT, 35.0, INLET])).all()


@both
def test_unit_of_length(bearing):
    """P goes with 1/length and the load with length."""
    metres = WedgeSeries(1e-3 * EXIT, 1e-3 * INLET, 1e-3 * WIDTH, bearing.blocked)
    assert 1e-3 * metres.pressure(0.022, 0.003) == pytest.approx(bearing.pressure(22.0, 3.0), rel=1e-12)
    assert 1e3 * metres.load() == pytest.approx(bearing.load(), rel=1e-12)


@both
def test_arrays(bearing):
    """X and Y broadcast; every point is what it is by itself."""
    X, Y = np.array([[20.0], [22.0], [50.0]]), np.array([0.0, 5.0, -5.0, 9.0])
    P = bearing.pressure(X, Y)
    assert P.shape == (3, 4)
    single = [[bearing.pressure(x, y) for y in Y] for x in X[:, 0]]
    np.testing.assert_allclose(P, single, rtol=0, atol=1e-15)
    np.testing.assert_allclose(P[:, 1], P[:, 2], rtol=1e-12, atol=1e-15)
    assert bearing.modes(X).shape == (3, 1, bearing.terms)


@pytest.mark.parametrize("z", [0.1, 1.0, pi, 8.0, 40.0, 50.0, 300.0])
def test_struve_difference(z):
    """Against the Fourier integral, and D' against the difference of D."""
    D, slope = struve_difference(z)
    integral = quad(lambda t: (1.0 + t * t) ** -1.5, 0.0, np.inf, weight="sin", wvar=z, epsabs=1e-13)[0]
    assert D == pytest.approx(2.0 / (pi * z) * integral, abs=1e-12)
    h = 1e-3 * z
    west2, west, east, east2 = (struve_difference(z + j * h)[0] for j in (-2, -1, 1, 2))
    assert slope == pytest.approx((west2 - 8.0 * west + 8.0 * east - east2) / (12.0 * h), rel=1e-8)


def test_struve_difference_for_large_z():
    """D = (2/pi) (1/z^2 + 3/z^4 + 45/z^6 + ...)."""
    z = np.array([1e3, 1e4, 1e5])
    D, slope = struve_difference(z)
    np.testing.assert_allclose(D, 2.0 / pi * (z**-2 + 3.0 * z**-4 + 45.0 * z**-6), rtol=2e-13)
    np.testing.assert_allclose(slope, -2.0 / pi * (2.0 * z**-3 + 12.0 * z**-5 + 270.0 * z**-7), rtol=2e-13)


def test_one_dimensional():
    """No net flow, X^3 dP/dX + 6 X = 0, and no pressure at the inlet."""
    X, h = np.array([20.0, 30.0, 45.0]), 1e-3
    slope = (one_dimensional(X + h, INLET) - one_dimensional(X - h, INLET)) / (2.0 * h)
    np.testing.assert_allclose(X**3 * slope + 6.0 * X, 0.0, atol=1e-5)
    assert one_dimensional(INLET, INLET) == 0.0
