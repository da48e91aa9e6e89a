from math import exp

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions, UnifiedEquations
from mgehl.discretization.fluid import FACE_MEANS, face_mobility, fluid_state
from mgehl.discretization.scheme import Scheme

LCIC = InterfaceConditions()


@pytest.mark.parametrize("mean", ["logarithmic", "geometric", "harmonic"])
@pytest.mark.parametrize("a, b", [(0.0, 3.0), (3.0, 0.0), (0.0, 0.0)])
def test_vanishing_mean_of_a_closed_node_is_finite(mean, a, b):
    value, by_a, by_b = FACE_MEANS[mean](np.array([a]), np.array([b]))
    assert value[0] == 0.0
    assert np.isfinite(by_a).all() and np.isfinite(by_b).all()


@pytest.mark.parametrize("alpha_dP", [0.0, 1e-9, 1e-3, 0.019, 0.021, 0.5, 20.0])
def test_logarithmic_mean_carries_the_flow_of_the_reduced_pressure(alpha_dP):
    """By Barus's law and one gap mean (P_E - P_W) = (e^(-alpha P_W) - e^(-alpha P_E))/alpha.

    It rises in proportion to both mobilities: each slope times its mobility adds up to it.
    """
    W, E = 1.0, np.exp(-alpha_dP)
    mean, by_W, by_E = (part[0] for part in FACE_MEANS["logarithmic"](np.array([W]), np.array([E])))
    assert mean * alpha_dP == pytest.approx(-np.expm1(-alpha_dP), rel=1e-9)
    assert W * by_W + E * by_E == pytest.approx(mean, rel=1e-12)


def test_the_linear_gap_s_flow_is_that_of_the_differential_equation():
    """q = -h^3 e^(-P) dP/dx through a gap from 1 to 3 between pressures 0 and 2, integrated."""
    P, h, steps = (0.0, 2.0), (1.0, 3.0), 4000
    x = (np.arange(steps) + 0.5) / steps
    q = -(1.0 - exp(-2.0)) / np.mean((h[0] + (h[1] - h[0]) * x) ** -3.0)
    eps = [np.array([gap**3 * exp(-p)]) for p, gap in zip(P, h, strict=True)]
    found = face_mobility(
        Scheme("1B", "linear-gap"), eps, [np.array([gap]) for gap in h], [np.ones(1), np.ones(1)]
    )
    assert -found.value[0] * (P[1] - P[0]) == pytest.approx(q, rel=1e-6)


def test_the_smallest_gap_of_the_unified_equations_is_the_least_of_the_mobility(contact):
    """At and below it eps is its own and ignores H; above it nothing changes."""
    P, H, smallest = np.full(5, 0.4), np.array([-0.2, 0.0, 0.05, 0.1, 0.3]), 0.1
    floored, free = (fluid_state(P, H, contact, law) for law in (UnifiedEquations(smallest), LCIC))
    below, above = slice(0, 4), slice(4, 5)
    for name in ("eps", "deps_dP"):
        np.testing.assert_array_equal(getattr(floored, name)[below], getattr(free, name)[3])
    assert (floored.eps > 0.0).all()
    assert (floored.deps_dH[below] == 0.0).all()
    for name in ("eps", "deps_dP", "deps_dH"):
        np.testing.assert_array_equal(getattr(floored, name)[above], getattr(free, name)[above])
