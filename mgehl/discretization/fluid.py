"""Nodal state of the lubricant and the mobility of a face between two nodes."""

from dataclasses import dataclass, fields

import numpy as np

from mgehl.discretization.kernels import logarithmic_means, tapered_mobilities


@dataclass
class Fluid:
    """Density and mobility at nodes with their derivatives; all arrays of one shape.

    eps = rho* H^3/(eta* lambda)  [Liu eq. 26, in units of a^2/R]
    """

    P: np.ndarray
    H: np.ndarray
    rho: np.ndarray
    drho_dP: np.ndarray
    eps: np.ndarray
    deps_dP: np.ndarray
    deps_dH: np.ndarray
    gap: np.ndarray | None = None
    """The gap that the Poiseuille flow sees; H where the contact law says nothing else."""

    def __post_init__(self):
        if self.gap is None:
            self.gap = self.H

    def with_part(self, nodes, part):
        """A copy that is another fluid, `part`, on the `nodes` of a mask."""
        parts = []
        for field in fields(self):
            array = getattr(self, field.name).copy()
            array[nodes] = getattr(part, field.name)
            parts.append(array)
        return Fluid(*parts)


def fluid_state(P, H, contact, contact_law):
    """Evaluate the constitutive laws at nodes of pressure `P` and gap `H`.

    `contact` gives the lubricant, the unit of P and lambda; the `contact_law` the gap that the
    Poiseuille flow sees. H must be positive wherever the node can exchange fluid; contact nodes may
    carry any H, their faces are closed.
    """
    lubricant, p_h = contact.lubricant, contact.pressure_scale
    rho, drho_dP = lubricant.density_law.density(P, p_h)
    log_eta, dlog_eta_dP = lubricant.viscosity_law.log_viscosity(P, p_h)
    by_H3 = rho * np.exp(-log_eta) / contact.lambda_
    gap, dgap_dH = contact_law.flow_gap(H)
    by_H2 = by_H3 * gap * gap
    eps = by_H2 * gap
    by_P = eps * (drho_dP / rho - dlog_eta_dP)
    return Fluid(P, H, rho, drho_dP, eps, by_P, 3.0 * by_H2 * dgap_dH, gap)


def arithmetic_mean(a, b):
    """(a + b)/2 and its two derivatives  [Liu eq. 7]."""
    return 0.5 * (a + b), 0.5, 0.5


def geometric_mean(a, b):
    """sqrt(a b) and its two derivatives: vanishes with either side."""
    a, b = np.maximum(a, 0.0), np.maximum(b, 0.0)
    mean = np.sqrt(a * b)
    return mean, _share(0.5 * mean, a), _share(0.5 * mean, b)


def harmonic_mean(a, b):
    """2 a b/(a + b) and its two derivatives: vanishes with either side."""
    a, b = np.maximum(a, 0.0), np.maximum(b, 0.0)
    of_a, of_b = _share(a, a + b), _share(b, a + b)
    return 2.0 * a * of_b, 2.0 * of_b**2, 2.0 * of_a**2


def logarithmic_mean(a, b):
    """(a - b)/ln(a/b) and its two derivatives: vanishes with either side.

    Between nodes of one gap and Barus's law it is exact: their flow is that of the reduced pressure
    q = (1 - e^(-alpha p))/alpha.
    """
    parts = np.empty((3, *np.shape(a)))
    logarithmic_means(np.atleast_2d(a), np.atleast_2d(b), *(np.atleast_2d(part) for part in parts))
    return tuple(parts)


def _share(part, whole):
    """part/whole, zero where there is nothing (a closed gap's mobility may be negative)."""
    return np.divide(part, whole, out=np.zeros(np.broadcast(part, whole).shape), where=whole > 0.0)


FACE_MEANS = {
    "arithmetic": arithmetic_mean,
    "logarithmic": logarithmic_mean,
    "geometric": geometric_mean,
    "harmonic": harmonic_mean,
}
"""Means of two nodes' mobilities."""

FACE_MOBILITIES = (*FACE_MEANS, "tapered")


@dataclass(frozen=True)
class FaceMobility:
    """Mobility of faces and, for the nodes (W, E) on their sides, its derivatives by P and by H."""

    value: np.ndarray
    by_P: tuple
    by_H: tuple


def face_mobility(scheme, west, east):
    """The `FaceMobility` between nodes `west` and `east`; either gives a part of the `Fluid` by its name.

    With a `mobility_share` below 1 the rest is the arithmetic mean.
    """
    share, parts = scheme.mobility_share, (west, east)
    mobility = _tapered if scheme.face_mobility == "tapered" else _of_mean(FACE_MEANS[scheme.face_mobility])
    whole = mobility(*parts)
    if share == 1.0:
        return whole
    paper = _of_mean(arithmetic_mean)(*parts)

    def blend(own, of_paper):
        return share * own + (1.0 - share) * of_paper

    by_P, by_H = (
        tuple(blend(*both) for both in zip(*pair, strict=True))
        for pair in ((whole.by_P, paper.by_P), (whole.by_H, paper.by_H))
    )
    return FaceMobility(blend(whole.value, paper.value), by_P, by_H)


def _of_mean(mean):
    """The face's mobility by a `mean` of its nodes': P and H count by those."""

    def mobility(west, east):
        value, of_west, of_east = mean(west("eps"), east("eps"))
        by_P = of_west * west("deps_dP"), of_east * east("deps_dP")
        return FaceMobility(value, by_P, (of_west * west("deps_dH"), of_east * east("deps_dH")))

    return mobility


def _tapered(west, east):
    """That of a gap which tapers from one node to the other: exact for Barus's law and constant density.

    With a gap h linear in x and a flow q = u h - h^3 e^(-alpha p)/(12 eta_0) dp/dx the same all along,
    q int h^-3 = int u h^-2 - (psi_E - psi_W), psi = (1 - e^(-alpha p))/(12 eta_0 alpha). So the pressure
    drives its flow through 1/int h^-3 = 2 h_W^2 h_E^2/(h_W + h_E) over the distance, and the viscosity
    counts by its logarithmic mean. The flow ends where either gap closes: nothing leaks into contact.
    """
    gap_w, gap_e = west("gap"), east("gap")
    value, *slopes = np.empty((5, *np.shape(gap_w)))
    tapered_mobilities(
        *(np.atleast_2d(part) for part in (west("eps"), east("eps"), gap_w, gap_e)),
        *(np.atleast_2d(part) for part in (value, *slopes)),
    )
    by_west, by_east, by_gap_w, by_gap_e = slopes
    # Where the law keeps a smallest gap neither it nor the mobility moves with H.
    moves_w, moves_e = west("deps_dH") != 0.0, east("deps_dH") != 0.0
    by_P = by_west * west("deps_dP"), by_east * east("deps_dP")
    return FaceMobility(value, by_P, (by_gap_w * moves_w, by_gap_e * moves_e))
