from math import exp, log, sqrt

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions, UnifiedEquations
from mgehl.discretization.fluid import FACE_MEANS, face_mobility, fluid_state
from mgehl.discretization.scheme import Scheme

LCIC = InterfaceConditions()


def test_mobility_is_rho_H3_over_eta_lambda(contact):
    """eps at one node from numbers only: p = 0.5 p_h, alpha = 3/GPa."""
    p = 0.5 * contact.hertz.p_h
    rho = 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p)
    a, p_h = contact.hertz.a, contact.hertz.p_h
    reynolds = 12.0 * 0.1 * 0.096 * 12.7e-3**2 / (a**3 * p_h)
    fluid = fluid_state(np.array([0.5]), np.array([0.1]), contact, LCIC)
    assert fluid.rho[0] == pytest.approx(rho, rel=1e-14)
    assert fluid.eps[0] == pytest.approx(rho * 0.1**3 * exp(-3e-9 * p) / reynolds, rel=1e-13)


def test_mobility_is_the_paper_s_in_its_own_units(contact):
    """a p_h/(12 u eta0) rho* h*^3/eta* with h* = h/a equals eps (a/R_x), as the flow per u a does."""
    a, p_h, R = contact.hertz.a, contact.hertz.p_h, contact.radius_x
    gap = 0.1 * contact.film_scale
    paper = a * p_h / (12.0 * contact.speed * 0.096) * (gap / a) ** 3
    eps = fluid_state(np.array([0.0]), np.array([0.1]), contact, LCIC).eps[0]
    assert eps * a / R == pytest.approx(paper, rel=1e-13)


@pytest.mark.parametrize("name, by", [("rho", "P"), ("eps", "P"), ("eps", "H")])
def test_derivatives_match_central_differences(contact, name, by):
    P, H, d = np.linspace(0.0, 1.2, 5), np.linspace(0.03, 0.2, 5), 1e-6
    dP, dH = (d, 0.0) if by == "P" else (0.0, d)
    above = getattr(fluid_state(P + dP, H + dH, contact, LCIC), name)
    below = getattr(fluid_state(P - dP, H - dH, contact, LCIC), name)
    derivative = getattr(fluid_state(P, H, contact, LCIC), f"d{name}_d{by}")
    np.testing.assert_allclose(derivative, (above - below) / (2.0 * d), rtol=1e-7)


@pytest.mark.parametrize(
    "mean, value, by_a, by_b",
    [
        ("arithmetic", 5.0, 0.5, 0.5),
        (
            "logarithmic",
            6.0 / log(4.0),
            (3.0 / log(4.0) - 1.0) / log(4.0),
            (1.0 - 0.75 / log(4.0)) / log(4.0),
        ),
        ("geometric", 4.0, 1.0, 0.25),
        ("harmonic", 3.2, 2.0 * 0.8**2, 2.0 * 0.2**2),
    ],
)
def test_means_of_two_and_eight(mean, value, by_a, by_b):
    """sqrt(2*8) = 4 with slopes 4/(2*2), 4/(2*8); 2*16/10 = 3.2 with slopes 2 (8/10)^2, 2 (2/10)^2.

    Of the logarithmic mean m they are (m/2 - 1)/ln 4 and (1 - m/8)/ln 4.
    """
    result = FACE_MEANS[mean](np.array([2.0]), np.array([8.0]))
    assert [np.ravel(part)[0] for part in result] == pytest.approx([value, by_a, by_b], rel=1e-15)


@pytest.mark.parametrize("mean", FACE_MEANS)
@pytest.mark.parametrize("a, b", [(1.0, 3.0), (2e-9, 5e-3), (7e4, 1e-12), (4.0, 4.0)])
def test_mean_slopes_match_central_differences(mean, a, b):
    value, by_a, by_b = (np.ravel(part)[0] for part in FACE_MEANS[mean](np.array([a]), np.array([b])))
    d = 1e-4

    def at(a, b):
        return FACE_MEANS[mean](np.array([a]), np.array([b]))[0][0]

    # Homogeneity of degree one states the slopes where a difference would drown in rounding.
    assert a * by_a + b * by_b == pytest.approx(value, rel=1e-13)
    if max(a, b) / min(a, b) < 1e3:
        assert by_a == pytest.approx((at(a * (1 + d), b) - at(a * (1 - d), b)) / (2 * a * d), rel=1e-7)
        assert by_b == pytest.approx((at(a, b * (1 + d)) - at(a, b * (1 - d))) / (2 * b * d), rel=1e-7)


@pytest.mark.parametrize("mean", ["logarithmic", "geometric", "harmonic"])
@pytest.mark.parametrize("a, b", [(0.0, 3.0), (3.0, 0.0), (0.0, 0.0)])
def test_vanishing_mean_of_a_closed_node_is_finite(mean, a, b):
    value, by_a, by_b = FACE_MEANS[mean](np.array([a]), np.array([b]))
    assert value[0] == 0.0
    assert np.isfinite(by_a).all() and np.isfinite(by_b).all()


def test_means_are_ordered_and_symmetric():
    a, b = np.array([1.0, 5.0, 1e-6]), np.array([2.0, 5.0, 1e3])
    means = {name: mean(a, b)[0] for name, mean in FACE_MEANS.items()}
    assert (means["harmonic"] <= means["geometric"] * (1 + 1e-15)).all()
    assert (means["geometric"] <= means["logarithmic"] * (1 + 1e-15)).all()
    assert (means["logarithmic"] <= means["arithmetic"] * (1 + 1e-15)).all()
    assert means["geometric"][0] == pytest.approx(sqrt(2.0), rel=1e-15)
    for mean in FACE_MEANS.values():
        value, by_a, by_b = mean(a, b)
        swapped, by_b_swapped, by_a_swapped = mean(b, a)
        np.testing.assert_allclose(swapped, value, rtol=1e-15)
        # A slope is a pure number up to 2, so rounding is absolute.
        np.testing.assert_allclose(by_a_swapped, by_a, rtol=0.0, atol=5e-16)
        np.testing.assert_allclose(by_b_swapped, by_b, rtol=0.0, atol=5e-16)


@pytest.mark.parametrize("alpha_dP", [0.0, 1e-9, 1e-3, 0.019, 0.021, 0.5, 20.0])
def test_logarithmic_mean_carries_the_flow_of_the_reduced_pressure(alpha_dP):
    """By Barus's law and one gap mean (P_E - P_W) = (e^(-alpha P_W) - e^(-alpha P_E))/alpha."""
    mean = FACE_MEANS["logarithmic"](np.array([1.0]), np.exp([-alpha_dP]))[0][0]
    assert mean * alpha_dP == pytest.approx(-np.expm1(-alpha_dP), rel=1e-9)


@pytest.mark.parametrize("ratio", [1.0 + 1e-14, 1.0 + 1e-8, 1.01, 1.0199, 1.0203, 1.05])
def test_logarithmic_mean_of_like_mobilities_keeps_its_digits(ratio):
    """By (a + b)/2 (1 - x^2/3 - 4 x^4/45), x = (b - a)/(a + b), and its slopes."""
    b = 3.0 * ratio
    x = (b - 3.0) / (3.0 + b)
    even, slope = 1.0 - x**2 / 3.0 - 4.0 * x**4 / 45.0, -2.0 * x / 3.0 - 16.0 * x**3 / 45.0
    value, by_a, by_b = (part[0] for part in FACE_MEANS["logarithmic"](np.array([3.0]), np.array([b])))
    assert value == pytest.approx(0.5 * (3.0 + b) * even, rel=1e-10)
    assert by_a == pytest.approx(0.5 * even - slope * b / (3.0 + b), rel=1e-8)
    assert by_b == pytest.approx(0.5 * even + slope * 3.0 / (3.0 + b), rel=1e-8)


A, B = np.array([2.0, 1.0, 4.0, 0.0]), np.array([8.0, 30.0, 4.0, 3.0])
"""Mobilities on the two sides of four faces, one of them closed."""


GAPS = np.array([0.5, 1.0, 2.0, 0.0]), np.array([1.0, 2.0, 2.0, 1.0])
LIGHT = np.ones(4), np.ones(4)
"""Densities that make no difference."""
RHO = np.array([1.0, 1.3, 1.2, 1.1]), np.array([2.0, 1.1, 1.2, 1.4])


def parts_of(mobility):
    return (mobility.value, *mobility.by_eps, *mobility.by_gap)


@pytest.mark.parametrize("mean", FACE_MEANS)
@pytest.mark.parametrize("share", [1.0, 0.0])
def test_face_mobility_at_either_end_of_the_share(mean, share):
    """All of it is the scheme's mean itself, none of it the arithmetic one."""
    expected = FACE_MEANS[mean if share else "arithmetic"](A, B)
    found = face_mobility(Scheme("1B", mean, share), (A, B), GAPS, LIGHT)
    for part, own in zip(parts_of(found), expected, strict=True):
        np.testing.assert_array_equal(np.broadcast_to(part, A.shape), np.broadcast_to(own, A.shape))


def test_the_share_is_all_of_the_mean_unless_another_is_asked_for():
    found = face_mobility(Scheme("1B", "harmonic"), (A, B), GAPS, LIGHT)
    for part, own in zip(parts_of(found), FACE_MEANS["harmonic"](A, B), strict=True):
        np.testing.assert_array_equal(part, own)


@pytest.mark.parametrize("mean, value", [("arithmetic", 5.0), ("geometric", 4.6), ("harmonic", 4.28)])
def test_a_share_of_the_mean_of_two_and_eight(mean, value):
    """0.4 of 5, 4 or 3.2, and 0.6 of 5."""
    scheme = Scheme("1B", mean, 0.4)
    assert face_mobility(scheme, (A, B), GAPS, LIGHT).value[0] == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize("mean", ["logarithmic", "linear-gap", "geometric", "harmonic"])
@pytest.mark.parametrize("share", [1.0, 0.4])
def test_slopes_of_a_face_mobility_match_central_differences(mean, share):
    """By the mobilities, the gaps and the densities, the others held."""
    scheme, d = Scheme("1B", mean, share), 1e-4
    state = [each[:3] for each in (A, B, *GAPS, *RHO)]

    def found(number=0, by=0.0):
        moved = [each + by * (number == k) for k, each in enumerate(state)]
        return face_mobility(scheme, moved[:2], moved[2:4], moved[4:])

    by = found()
    assert len(by.by_gap) == (2 if mean == "linear-gap" else 0)
    assert len(by.by_rho) == (2 if mean in ("logarithmic", "linear-gap") else 0)
    nothing = np.zeros(3), np.zeros(3)
    slopes = *by.by_eps, *(by.by_gap or nothing), *(by.by_rho or nothing)
    for number, slope in enumerate(slopes):
        measured = (found(number, d).value - found(number, -d).value) / (2.0 * d)
        np.testing.assert_allclose(slope, measured, rtol=2e-6, atol=1e-8)


@pytest.mark.parametrize("mean, value", [("logarithmic", 3.0 / log(2.0)), ("linear-gap", 6.0 / log(4.0))])
def test_the_mean_density_multiplies_the_mean_of_the_mobilities_without_theirs(mean, value):
    """Of 2 and 8 with densities 1 and 2: 3/2 times the mean of 2 and 4, not that of 2 and 8.

    Through gaps 1/2 and 1 that of the linear gap is that of 16 and 4 per cube, 12/ln 4, times 1/3.
    """
    found = face_mobility(Scheme("1B", mean), (A, B), GAPS, RHO)
    assert found.value[0] == pytest.approx(value, rel=1e-14)


def test_the_linear_gap_s_mobility_of_two_and_eight():
    """Gaps 1/2 and 1: 16 and 8 per cube, of logarithmic mean 8/ln 2, times 2 (1/4) 1/(3/2) = 1/3."""
    found = face_mobility(Scheme("1B", "linear-gap"), (A, B), GAPS, LIGHT)
    assert found.value[0] == pytest.approx(8.0 / log(2.0) / 3.0, rel=1e-15)
    assert found.value[2] == pytest.approx(4.0, rel=1e-15)
    assert found.value[3] == 0.0


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


def test_the_smallest_gap_leaves_the_fluid_carried_along_alone(contact):
    """rho and H, of whatever sign, are those of the interface conditions."""
    P, H = np.linspace(0.1, 0.9, 4), np.array([-0.2, 0.0, 0.05, 0.3])
    floored, free = (fluid_state(P, H, contact, law) for law in (UnifiedEquations(0.1), LCIC))
    for name in ("P", "H", "rho", "drho_dP"):
        np.testing.assert_array_equal(getattr(floored, name), getattr(free, name))


@pytest.mark.parametrize("by", ["P", "H"])
def test_floored_mobility_matches_central_differences(contact, by):
    P, H, d = np.linspace(0.0, 1.2, 6), np.array([-0.1, 0.03, 0.09, 0.11, 0.2, 0.3]), 1e-6
    dP, dH = (d, 0.0) if by == "P" else (0.0, d)
    law = UnifiedEquations(0.1)
    above, below = (fluid_state(P + s * dP, H + s * dH, contact, law).eps for s in (1.0, -1.0))
    derivative = getattr(fluid_state(P, H, contact, law), f"deps_d{by}")
    np.testing.assert_allclose(derivative, (above - below) / (2.0 * d), rtol=1e-7)
