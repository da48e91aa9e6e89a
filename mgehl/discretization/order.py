"""The order of a Couette scheme, told from its table."""

from math import isclose

from mgehl.discretization.couette import SHIFT, couette_scheme

HIGHEST = 4
"""Beyond it nobody asks: the Poiseuille flow is of second order."""


def couette_order(name):
    """Order of the difference that the scheme of this name makes of d(rho H)/dx away from walls.

    It is exact for the products x^m of rho and x^n of H up to m + n = order.
    """
    scheme = couette_scheme(name)
    order = 0
    while order < HIGHEST and _is_exact(scheme, order + 1):
        order += 1
    return order


def _is_exact(scheme, degree):
    """Whether the difference of x^m and x^n is right at x = 0 for all m + n = degree, the spacing 1."""
    derivative = 1.0 if degree == 1 else 0.0
    powers = ((m, degree - m) for m in range(degree + 1))
    return all(isclose(_difference(scheme, *each), derivative, abs_tol=1e-12) for each in powers)


def _difference(scheme, m, n):
    """Flow that leaves the node at 0 less flow that enters it, of rho = x^m and H = x^n."""
    leaving = sum(c * SHIFT[a] ** m * SHIFT[b] ** n for c, a, b in scheme.leaving)
    return leaving - sum(c * (SHIFT[a] - 1) ** m * (SHIFT[b] - 1) ** n for c, a, b in scheme.entering)
