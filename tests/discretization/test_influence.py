from math import pi

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.model.deformation import HalfPlane, HalfSpace


def mesh(k_e=1.0, nx=9, ny=7):
    return Mesh(nx, ny, (-1.9, 1.3), (-1.5, 1.5), k_e)


def integral_of_reciprocal_distance(x, y, width, height):
    """The integral of 1/r from (0, 0) over a rectangle around (x, y), by adaptive quadrature."""

    def quarter(x0, x1, y0, y1):
        return dblquad(lambda y, x: 1.0 / np.hypot(x, y), x0, x1, y0, y1, epsabs=1e-12, epsrel=1e-11)[0]

    if x == y == 0.0:
        # Polar coordinates around the singular corner: the integral of the boundary's distance.
        angle = np.arctan2(height, width)
        t, weight = np.polynomial.legendre.leggauss(40)
        across = 0.5 * angle * (weight / np.cos(0.5 * angle * (t + 1))).sum() * width / 2
        rest = pi / 2 - angle
        along = 0.5 * rest * (weight / np.cos(0.5 * rest * (t + 1))).sum() * height / 2
        return 4.0 * (across + along)
    return quarter(x - width / 2, x + width / 2, y - height / 2, y + height / 2)


@pytest.mark.parametrize("k_e", [1.0, 0.4, 2.5])
@pytest.mark.parametrize("line, node", [(0, 0), (0, 1), (1, 0), (1, 1), (3, 2), (6, 8)])
def test_coefficients_against_quadrature(k_e, line, node):
    """The rectangle is dX by dY/k_e in units of a, whatever the axis ratio."""
    m = mesh(k_e)
    width, height = m.dX, m.dY / k_e
    expected = integral_of_reciprocal_distance(node * width, line * height, width, height)
    assert influence_coefficients(m, HalfSpace(2.0))[line, node] == pytest.approx(2.0 * expected, rel=1e-9)


def test_far_field_is_area_over_distance():
    """The relative error of area/r falls with the square of the distance."""
    m = mesh(k_e=0.6, nx=129, ny=129)
    K, area = influence_coefficients(m, HalfSpace(1.0)), m.dX * m.dY / 0.6

    def error(n):
        return abs(K[n, n] * np.hypot(n * m.dX, n * m.dY / 0.6) / area - 1.0)

    assert error(100) < 1e-5
    assert error(25) / error(100) == pytest.approx(16.0, rel=0.01)


def test_hertz_pressure_flattens_the_paraboloid():
    """Deflection by the discrete Hertz pressure restores the approach less X^2/2 inside the circle.

    H = H0 + X^2/2 + Y^2/2 + (2/pi^2) iint P/r with H0 = -1; first order in the mesh size.
    """
    errors = []
    for n in (17, 33):
        m = Mesh(n, n, (-1.25, 1.25), (-1.25, 1.25))
        X, Y = np.meshgrid(m.X, m.Y)
        P = np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0))
        K = influence_coefficients(m, HalfSpace(2.0 / pi**2))
        j, i = np.indices((n, n))
        centre = n // 2
        gaps = []
        for line, node in ((centre, centre), (centre, centre + n // 5), (centre - n // 5, centre)):
            deflection = (K[abs(j - line), abs(i - node)] * P).sum()
            gaps.append(-1.0 + 0.5 * (X[line, node] ** 2 + Y[line, node] ** 2) + deflection)
        errors.append(np.abs(gaps).max())
    assert errors[1] < 0.01
    assert errors[1] < 0.6 * errors[0]


def line(nx=9, x=(-1.9, 1.3)):
    return Mesh(nx, 1, x, (0.0, 0.0))


@pytest.mark.parametrize("node", [0, 1, 2, 8])
def test_line_coefficients_against_quadrature(node):
    """-ln|x| over the strip around a node, with its singularity inside the first."""
    m = line()
    ends = (node - 0.5) * m.dX, (node + 0.5) * m.dX
    halves = ((ends[0], node * m.dX), (node * m.dX, ends[1]))
    expected = sum(quad(lambda x: -np.log(abs(x)), *half, epsabs=1e-13, epsrel=1e-12)[0] for half in halves)
    K = influence_coefficients(m, HalfPlane(0.7))
    assert K.shape == (1, 9)
    assert K[0, node] == pytest.approx(0.7 * expected, rel=1e-10)


def test_hertz_line_pressure_flattens_the_parabola():
    """H0 + X^2/2 - (1/pi) int P ln|X - X'| = 0 inside, with H0 = -(1/4 + ln2/2), to O(dX).

    The edge of the contact is a node of every mesh: the error depends on where it lies in its cell.
    """
    errors = []
    for n in (65, 129, 257):
        m = line(n, (-1.6, 1.6))
        P = np.sqrt(np.maximum(1.0 - m.X**2, 0.0))
        K = influence_coefficients(m, HalfPlane(1.0 / pi))[0]
        deflection = K[np.abs(np.subtract.outer(np.arange(n), np.arange(n)))] @ P
        gap = -(0.25 + 0.5 * np.log(2.0)) + 0.5 * m.X**2 + deflection
        errors.append(np.abs(gap[np.abs(m.X) < 1.01]).max())
        assert errors[-1] < 0.25 * m.dX
    assert errors[2] < 0.5 * errors[1] < 0.25 * errors[0]
