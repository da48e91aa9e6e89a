"""What a user may put in place of a built-in law, surface or deformation by a function of their own.

    viscosity     law(conditions) -> eta in Pa s, d eta/dp
    density       law(conditions) -> rho/rho_0, its derivative by p
    shear stress  law(conditions) -> tau in Pa
    surface       surface(x, y) -> height in m, a peak positive: it lowers the gap
    deformation   compliance(k) -> deflection at wave number k over that of half-spaces

`conditions`: `Conditions`; x and y in m from the centre, k in 1/m, of one shape. `check` asks beforehand.
"""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.model.conditions import Conditions
from mgehl.model.own_function import OwnFunction
from mgehl.model.surface import Surface

CHECKED_PRESSURES = 101

SLOPE_STEP = 1e-5
"""Step of the central differences that a derivative is compared to, over the highest pressure."""

SLOPE_TOLERANCE = 1e-3
"""Of a derivative, relative to the largest at any pressure."""

NO_SLOPE = 1e-6
"""A smaller change over the whole range of pressures counts as none."""

HIGHEST = 10.0
"""Pressure in p_h, above that of rough bodies' peaks, up to which a law must be one whenever it is asked.
Only an iteration that diverges asks beyond: that ends, or begins anew on a finer grid."""

AMBIENT_TOLERANCE = 1e-3
"""Of a law at p = 0, relative."""

ALPHA_TOLERANCE = 0.1
"""Of the slope of ln(eta) at p = 0, relative: some 5 % of the film that formulas make of it."""


@dataclass(frozen=True)
class OwnViscosity:
    """A viscosity law. Below p = 0, where the function is not asked, ln(eta) goes on as a line."""

    viscosity: float
    pressure_viscosity: float
    function: OwnFunction
    temperature: float | None = None
    """Of the oil in K, which the function is told; None where the configuration names none."""

    def log_viscosity(self, P, p_h):
        """Return ln(eta*) and d ln(eta*)/dP, shapes as P."""
        p = np.maximum(P, 0.0) * p_h
        eta, slope = _numbers(self.function, *self._law(p), p, HIGHEST * p_h)
        value, slope = self._log(eta, slope)
        return value + slope * p_h * np.minimum(P, 0.0), slope * p_h

    def check(self, p_max, ambient="the viscosity that it is given"):
        """Raise OwnFunctionError unless it is a law with its derivative from 0 to `p_max` in Pa. `ambient`
        says in the message what the viscosity at p = 0 must be."""
        p = _check_values(self.function, self._law, p_max, self.viscosity, ambient)
        _check_slope(self.function, self._log_law, p, "d ln(eta)/dp")

    def check_alpha(self, p_max):
        """Raise OwnFunctionError unless the slope of ln(eta) at p = 0 is the pressure-viscosity
        coefficient, by which formulas, regime, inlet and Moes' numbers go; `p_max` in Pa as before."""
        slope, alpha = float(_as_nodes(self._log_law, np.zeros(1))[1][0]), self.pressure_viscosity
        if not abs(slope - alpha) <= ALPHA_TOLERANCE * alpha + NO_SLOPE / p_max:
            raise self.function.error(
                f"d ln(eta)/dp at p = 0 is {slope:.4g} 1/Pa; must be lubricant.pressure_viscosity, here "
                f"{alpha:.4g}, to within a tenth: formulas and the domain go by it"
            )

    def _log_law(self, p):
        """ln(eta*) and d ln(eta*)/dp at `p` in Pa."""
        return self._log(*self._law(p))

    def _log(self, eta, slope):
        """ln(eta*) and its derivative."""
        with np.errstate(all="ignore"):  # what is not positive shows as nan
            return np.log(eta / self.viscosity), slope / eta

    def _law(self, p):
        at = Conditions(p, self.viscosity, self.pressure_viscosity, temperature=self.temperature)
        return self.function.pair(np.shape(p), at)


@dataclass(frozen=True)
class OwnDensity:
    """A density law. Below p = 0, where the function is not asked, the density goes on as a line."""

    function: OwnFunction
    temperature: float | None = None
    """Of the oil in K, which the function is told; None where the configuration names none."""

    def density(self, P, p_h):
        """Return rho* and d rho*/dP, shapes as P."""
        p = np.maximum(P, 0.0) * p_h
        rho, slope = _numbers(self.function, *self._law(p), p, HIGHEST * p_h)
        return rho + slope * p_h * np.minimum(P, 0.0), slope * p_h

    def check(self, p_max):
        """Raise OwnFunctionError unless it is a law with its derivative from 0 to `p_max` in Pa."""
        p = _check_values(self.function, self._law, p_max, 1.0, "the density over that at p = 0")
        _check_slope(self.function, self._law, p, "d rho/dp")

    def _law(self, p):
        return self.function.pair(np.shape(p), Conditions(p, temperature=self.temperature))


@dataclass(frozen=True)
class OwnRheology:
    """A law of the shear stress, which may be no law of the film: that is thinned by Eyring's alone."""

    function: OwnFunction
    temperature: float | None = None
    """Of the oil in K, which the function is told; None where the configuration names none."""

    name = "own"
    eyring_stress = None

    def shear_stress(self, at):
        """In Pa, at `Conditions`."""
        at = replace(at, temperature=self.temperature)
        found = self.function.array(np.shape(at.pressure), at)
        wrong = ~((found >= 0.0) & np.isfinite(found))
        if wrong.any():
            i = np.unravel_index(int(wrong.argmax()), wrong.shape)
            p, rate = (np.broadcast_to(each, found.shape)[i] for each in (at.pressure, at.shear_rate))
            raise self.function.error(
                f"returns {found[i]:.3g} at {p:.3g} Pa and {rate:.3g} 1/s; must be a shear stress in Pa, "
                "not below 0"
            )
        return found

    def check(self, p_max, viscosity, shear_rate):
        """Raise OwnFunctionError unless it gives stresses from 0 to `p_max` in Pa."""
        self.function.check_arguments("conditions")
        p = np.linspace(0.0, p_max, 11)
        self.shear_stress(
            Conditions(p, np.full(p.shape, viscosity), shear_rate=np.full(p.shape, shear_rate))
        )


@dataclass(frozen=True)
class OwnSurface(Surface):
    """The surface of the body that stands still: its height is taken off the gap of the smooth bodies."""

    function: OwnFunction

    def height(self, x, y):
        """Height in m at `x` and `y` in m, in the shape of both together."""
        x, y, height = self._asked(x, y)
        wrong = ~np.isfinite(height)
        if wrong.any():
            at = _first(wrong)
            raise self.function.error(
                f"returns {height[at]:.3g} at x = {x[at]:.3g} m, y = {y[at]:.3g} m; must be a height in m"
            )
        return height

    def check(self, x, y, highest):
        """Raise OwnFunctionError unless every height at (x[i], y[j]) is a number of at most `highest`."""
        self.function.check_arguments("x", "y")
        for line in y:
            height = self._asked(x[None, :], line)[2][0]
            wrong = ~(np.abs(height) <= highest)
            if wrong.any():
                i = int(wrong.argmax())
                raise self.function.error(
                    f"returns {height[i]:.3g} at x = {x[i]:.3g} m, y = {line:.3g} m; must be a height in "
                    f"m of at most {highest:.3g}"
                )

    def _asked(self, x, y):
        """`x`, `y` and the heights there, all in one shape."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        return x, y, self.function.array(x.shape, x, y)


@dataclass(frozen=True)
class OwnCompliance:
    """The deflection of both bodies by a pressure wave, over that of half-spaces of the reduced modulus."""

    function: OwnFunction

    def compliance(self, k):
        """At the wave numbers `k` in 1/m; shape as `k`."""
        found = self.function.array(np.shape(k), k)
        _check_positive(self.function, found, k, "1/m")
        return found

    def check(self, k):
        """Raise OwnFunctionError unless it is positive at all `k` in 1/m."""
        self.function.check_arguments("k")
        self.compliance(k)


def _numbers(function, values, slopes, p, highest):
    """Values and derivatives of a law at `p` in Pa, positive and finite up to `highest`. It was one when it
    was checked, but may depend on more than the pressure, and is asked for higher ones."""
    is_law = (values > 0.0) & np.isfinite(values) & np.isfinite(slopes)
    if is_law.all():
        return values, slopes
    wrong = ~is_law & (p <= highest)
    if wrong.any():
        at = _first(wrong)
        _check_positive(function, values[at], p[at], "Pa")
        raise function.error(f"its derivative is {slopes[at]:.3g} at {p[at]:.3g} Pa; must be a number")
    return np.where(is_law, values, np.nan), slopes


def _first(wrong):
    """Index of the first node that is wrong, of any number of axes."""
    return np.unravel_index(int(wrong.argmax()), wrong.shape)


def _check_positive(function, values, at, unit):
    values, at = np.atleast_1d(values, at)
    wrong = ~((values > 0.0) & np.isfinite(values))
    if wrong.any():
        i = _first(wrong)
        raise function.error(f"returns {values[i]:.3g} at {at[i]:.3g} {unit}; must be a positive number")


def _as_nodes(law, p):
    """Value and derivative of a `law` at `p` (n,), asked as nodes are: (n, 1)."""
    return [each[:, 0] for each in law(p[:, None])]


def _check_values(function, law, p_max, expected, meaning):
    """Values from 0 to `p_max` in Pa must be positive, the first one as `expected`; the pressures."""
    function.check_arguments("conditions")
    p = np.linspace(0.0, p_max, CHECKED_PRESSURES)
    values = _as_nodes(law, p)[0]
    _check_positive(function, values, p, "Pa")
    if not abs(values[0] - expected) <= AMBIENT_TOLERANCE * expected:
        raise function.error(f"returns {values[0]:.4g} at p = 0; must be {expected:.4g}, {meaning}")
    return p


def _check_slope(function, law, p, name):
    """The derivative of a `law` must be that of its value, to within a small part of the largest; at a kink
    of a table that of either side, or between both."""
    step = SLOPE_STEP * p[-1]
    given, inner = _as_nodes(law, p)[1], p[1:]
    value, before, after = (_as_nodes(law, inner + way)[0] for way in (0.0, -step, step))
    sides = (value - before) / step, (after - value) / step
    # At p = 0 there is nothing below to compare to.
    first = np.where(np.isfinite(given[0]), given[0], 0.0)
    least, most = (np.append(first, end(*sides)) for end in (np.minimum, np.maximum))
    allowed = SLOPE_TOLERANCE * np.abs([least[1:], most[1:]]).max() + NO_SLOPE / p[-1]
    nearest = np.clip(given, least, most)
    off = np.abs(given - nearest)
    if not (off <= allowed).all():
        i = int(off.argmax())
        raise function.error(
            f"its derivative is wrong: {name} = {given[i]:.4g} at {p[i]:.3g} Pa, where differences of "
            f"the value give {nearest[i]:.4g}"
        )
