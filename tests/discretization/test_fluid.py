from math import exp, log

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions, UnifiedEquations
from mgehl.discretization.fluid import face_mobility, fluid_state
from mgehl.discretization.scheme import Scheme
from mgehl.model.rheology import Eyring, Friction

LCIC = InterfaceConditions()
ONE, TWO, EIGHT = np.ones(1), np.array([2.0]), np.array([8.0])


def mean_of(name, a, b):
    """Mean of the mobilities a and b, (n,), of a fluid of density 1, and its slopes by both."""
    found = face_mobility(Scheme(face_mobility=name), (a, b), (ONE, ONE), (ONE, ONE))
    return found.value, *found.by_eps


def test_mobility_is_rho_H3_over_eta_lambda(contact):
    """eps at one node from numbers only: p = 0.5 p_h, alpha = 3/GPa."""
    p = 0.5 * contact.hertz.p_h
    rho = 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p)
    a, p_h = contact.hertz.a, contact.hertz.p_h
    reynolds = 12.0 * 0.1 * 0.096 * 12.7e-3**2 / (a**3 * p_h)
    fluid = fluid_state(np.array([0.5]), np.array([0.1]), contact, LCIC)
    assert fluid.rho[0] == pytest.approx(rho, rel=1e-14)
    assert fluid.eps[0] == pytest.approx(rho * 0.1**3 * exp(-3e-9 * p) / reynolds, rel=1e-13)


@pytest.mark.parametrize(
    "mean, value, by_a, by_b",
    [("arithmetic", 5.0, 0.5, 0.5),
     ("logarithmic", 6.0 / log(4.0), (3.0 / log(4.0) - 1.0) / log(4.0), (1.0 - 0.75 / log(4.0)) / log(4.0)),
     ("geometric", 4.0, 1.0, 0.25), ("harmonic", 3.2, 2.0 * 0.8**2, 2.0 * 0.2**2)],
)  # fmt: skip
def test_means_of_two_and_eight(mean, value, by_a, by_b):
    """sqrt(2*8) = 4 with slopes 4/(2*2), 4/(2*8); 2*16/10 = 3.2 with slopes 2 (8/10)^2, 2 (2/10)^2.

    Of the logarithmic mean m they are (m/2 - 1)/ln 4 and (1 - m/8)/ln 4.
    """
    result = mean_of(mean, TWO, EIGHT)
    assert [np.ravel(part)[0] for part in result] == pytest.approx([value, by_a, by_b], rel=1e-15)


@pytest.mark.parametrize("mean", ["logarithmic", "geometric", "harmonic"])
@pytest.mark.parametrize("a, b", [(0.0, 3.0), (3.0, 0.0), (0.0, 0.0)])
def test_vanishing_mean_of_a_closed_node_is_finite(mean, a, b):
    value, by_a, by_b = mean_of(mean, np.array([a]), np.array([b]))
    assert value[0] == 0.0
    assert np.isfinite(by_a).all() and np.isfinite(by_b).all()


@pytest.mark.parametrize("alpha_dP", [0.0, 1e-9, 1e-3, 0.019, 0.021, 0.5, 20.0])
def test_logarithmic_mean_carries_the_flow_of_the_reduced_pressure(alpha_dP):
    """By Barus's law and one gap mean (P_E - P_W) = (e^(-alpha P_W) - e^(-alpha P_E))/alpha.

    It rises in proportion to both mobilities: each slope times its mobility adds up to it.
    """
    W, E = 1.0, np.exp(-alpha_dP)
    mean, by_W, by_E = (part[0] for part in mean_of("logarithmic", np.array([W]), np.array([E])))
    assert mean * alpha_dP == pytest.approx(-np.expm1(-alpha_dP), rel=1e-9)
    assert W * by_W + E * by_E == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize(
    "mean, share, rho, value",
    [("arithmetic", 0.4, ONE, 5.0), ("geometric", 0.4, ONE, 4.6), ("harmonic", 0.4, ONE, 4.28),
     ("logarithmic", 1.0, TWO, 3.0 / log(2.0)), ("linear-gap", 1.0, TWO, 6.0 / log(4.0))],
)  # fmt: skip
def test_the_mobility_of_a_face_between_two_and_eight(mean, share, rho, value):
    """0.4 of 5, 4 or 3.2, and 0.6 of 5. With densities 1 and 2 it is 3/2 times the mean of 2 and 4.

    Through gaps 1/2 and 1 that of the linear gap is that of 16 and 4 per cube, 12/ln 4, times 1/3.
    """
    found = face_mobility(Scheme("1B", mean, share), (TWO, EIGHT), (0.5 * ONE, ONE), (ONE, rho))
    assert found.value[0] == pytest.approx(value, rel=1e-14)


def test_the_linear_gap_s_flow_is_that_of_the_differential_equation():
    """q = -h^3 e^(-P) dP/dx through a gap from 1 to 3 between pressures 0 and 2, integrated."""
    P, h, steps = (0.0, 2.0), (1.0, 3.0), 4000
    x = (np.arange(steps) + 0.5) / steps
    q = -(1.0 - exp(-2.0)) / np.mean((h[0] + (h[1] - h[0]) * x) ** -3.0)
    eps = [np.array([gap**3 * exp(-p)]) for p, gap in zip(P, h, strict=True)]
    gaps = [np.array([gap]) for gap in h]
    found = face_mobility(Scheme("1B", "linear-gap"), eps, gaps, (ONE, ONE))
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


def test_a_closed_gap_that_shear_thins_has_no_mobility_along_or_across(paper_contact):
    """0/0 of it were nan on coarse grids, where bodies overlap."""
    thinned = paper_contact(friction=Friction(Eyring(6e6), slide_to_roll=1.0, thins=True))
    fluid = fluid_state(np.zeros(3), np.array([-0.1, 0.0, 0.3]), thinned, UnifiedEquations(0.0))
    again = fluid.with_mobility(fluid.eps)
    np.testing.assert_allclose(again.across, fluid.across, rtol=1e-14)
    assert again.across[2] > 0.0 and not again.across[1]
