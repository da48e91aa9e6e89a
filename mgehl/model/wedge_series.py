"""Series solution of the wedge bearing without a pillar, to compare with [Liu eqs. 43, 44].

A flat plate over a wedge h = m x, isoviscous, with P = m^2 p/(eta u):

    d/dX(X^3 dP/dX) + X^3 d2P/dY2 = -6,    exit <= X <= inlet,  |Y| <= width/2,

P = 0 on both sides and at the inlet. The exit is open, P = 0, or blocked, X^3 dP/dX + 6 X = 0. Lengths
share one unit; P is in 1 over it.

With 1 = sum of c cos(k Y), k = n pi/width, c = 4/(n pi) (-1)^((n-1)/2), n odd, P is the sum of f cos(k Y).
In z = k X, g = X f solves z^2 g'' + z g' - (1 + z^2) g = -6 c: modified Bessel functions of order one and 3
pi c D, D = L_{-1} - I_1 (Struve's L).
"""

from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np
from scipy.special import ive, kve, spence

D_NODES = 48
"""Gauss-Legendre nodes for D and D'."""
LOAD_NODES = 160
"""Gauss-Legendre nodes along X for the load."""


@dataclass(frozen=True)
class WedgeSeries:
    """Pressure and load of a wedge bearing whose exit is open or blocked."""

    exit: float
    """X at the narrow end, above zero."""
    inlet: float
    """X at the wide end, where P = 0."""
    width: float
    """Extent of the plate along Y, centred at Y = 0."""
    blocked: bool
    terms: int = 800
    """Number of odd n; far more than width/exit."""

    def pressure(self, X, Y=0.0):
        """P at points of the plate; X and Y broadcast. Two slow sums are known in closed form: the leading
        particular solutions make up the short bearing, those of the layer at a blocked exit a dilogarithm.
        What is left falls like 1/n^3 at exit and inlet, like 1/n^5 between."""
        X, Y = np.asarray(X, dtype=float), np.asarray(Y, dtype=float)
        difference = self.modes(X) - self._short_modes(X) - self._layer_modes(X)
        fast = np.einsum("...n,...n->...", difference, np.cos(Y[..., None] * self._k))
        short = 3.0 * (self.width**2 / 4.0 - Y**2) / X**3
        return fast + short + self._layer(X, Y)

    def load(self):
        """Integral of P over the plate."""
        t, w = np.polynomial.legendre.leggauss(LOAD_NODES)
        # Nodes crowd at both ends, where the layers of the modes are.
        X = self.exit + 0.25 * (self.inlet - self.exit) * (2.0 + t * (3.0 - t**2))
        dX = 0.75 * (self.inlet - self.exit) * w * (1.0 - t**2)
        short = self.width**3 / 4.0 * (self.exit**-2 - self.inlet**-2)
        # The integral of cos(k Y) over Y is c width/2.
        return short + dX @ (self.modes(X) - self._short_modes(X)) @ self._c * self.width / 2.0

    def modes(self, X):
        """Coefficients f of cos(n pi Y/width), n = 1, 3, 5, ...; shape X.shape + (terms,)."""
        X = np.asarray(X, dtype=float)[..., None]
        A, B = self._coefficients
        D, _ = struve_difference(self._k * X)
        return (3.0 * pi * self._c * D + A * self._scaled_I(1, X) + B * self._scaled_K(1, X)) / X

    @cached_property
    def _n(self):
        return 2.0 * np.arange(self.terms) + 1.0

    @cached_property
    def _k(self):
        return self._n * pi / self.width

    @cached_property
    def _c(self):
        return 4.0 / (pi * self._n) * (-1.0) ** np.arange(self.terms)

    def _scaled_I(self, order, X):
        """I_order(k X)/I_1(k inlet), without overflow."""
        return ive(order, self._k * X) / ive(1, self._k * self.inlet) * np.exp(self._k * (X - self.inlet))

    def _scaled_K(self, order, X):
        """K_order(k X)/K_1(k exit), without overflow."""
        return kve(order, self._k * X) / kve(1, self._k * self.exit) * np.exp(self._k * (self.exit - X))

    @cached_property
    def _coefficients(self):
        """Factors A, B of I_1(k X)/I_1(k inlet) and K_1(k X)/K_1(k exit) in g = X f, by Cramer's rule.
        Blocked: f' = -6 c/X^2 at the exit, with (I_1(z)/z)' = I_2(z)/z and (K_1(z)/z)' = -K_2(z)/z."""
        k, c, X = self._k, self._c, self.exit
        D, slope = struve_difference(k * X)
        if self.blocked:
            I_exit, K_exit = self._scaled_I(2, X), -self._scaled_K(2, X)
            at_exit = -c * (6.0 / (k * X) + 3.0 * pi * (slope - D / (k * X)))
        else:
            I_exit, K_exit = self._scaled_I(1, X), 1.0
            at_exit = -3.0 * pi * c * D
        at_inlet = -3.0 * pi * c * struve_difference(k * self.inlet)[0]
        K_inlet = self._scaled_K(1, self.inlet)
        determinant = K_exit - I_exit * K_inlet
        A = (at_inlet * K_exit - at_exit * K_inlet) / determinant
        return A, (at_exit - at_inlet * I_exit) / determinant

    def _short_modes(self, X):
        """Leading terms of 3 pi c D/X for large n."""
        return 6.0 * self._c / (self._k**2 * X[..., None] ** 3)

    def _layer_modes(self, X):
        """Leading terms for large n of the layer of f at a blocked exit."""
        if not self.blocked:
            return 0.0
        decay = np.exp(self._k * (self.exit - X[..., None]))
        return 6.0 * self._c / self._k * decay / np.sqrt(self.exit * X[..., None] ** 3)

    def _layer(self, X, Y):
        """Sum of the layer's leading terms for all n: the inverse tangent integral Ti_2(w)."""
        if not self.blocked:
            return 0.0
        iw = 1j * np.exp(pi / self.width * (self.exit - X + 1j * Y))
        Ti_2 = (spence(1.0 - iw) - spence(1.0 + iw)) / 2j
        return 24.0 * self.width / pi**2 * Ti_2.real / np.sqrt(self.exit * X**3)


def struve_difference(z):
    """D = L_{-1}(z) - I_1(z) and D' for z > 0; both I and L grow like exp(z), D falls like 1/z^2.

    DLMF 11.5.6 by parts: D = (2/pi) int_0^(pi/2) sin(s) exp(-z sin(s)) ds, which is
    (2/(pi z)) int_0^inf sin(z t) (1 + t^2)^(-3/2) dt.
    """
    z = np.asarray(z, dtype=float)
    D, slope = np.zeros_like(z), np.zeros_like(z)
    # Beyond 70/z the integrand is below exp(-44).
    end = np.minimum(pi / 2.0, 70.0 / z)
    for t, w in zip(*np.polynomial.legendre.leggauss(D_NODES), strict=True):
        sine = np.sin(end * (1.0 + t) / 2.0)
        part = w * end / pi * sine * np.exp(-z * sine)
        D += part
        slope -= part * sine
    return D, slope
