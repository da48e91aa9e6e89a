"""Nodal state of the lubricant and the mobility of a face between two nodes."""

from dataclasses import dataclass, fields

import numpy as np

from mgehl.discretization.mean_kernels import linear_gap_means, logarithmic_means

OF_PRESSURE = "rho", "drho_dP", "eps", "deps_dP", "deps_dH"
"""What the pressure decides of a fluid."""


@dataclass
class Fluid:
    """Density and mobility at nodes with their derivatives; all arrays of one shape.

    eps = rho* H^3/(eta* lambda)  [Liu eq. 26, in units of a^2/R]
    """

    P: np.ndarray
    H: np.ndarray
    carried: np.ndarray
    """The part of H that the surfaces carry along as fluid."""
    rho: np.ndarray
    drho_dP: np.ndarray
    eps: np.ndarray
    deps_dP: np.ndarray
    deps_dH: np.ndarray

    def of(self, lines):
        """That of some lines of nodes (a slice): views."""
        return Fluid(*(getattr(self, each.name)[lines] for each in fields(self)))

    def change(self, P, nodes, part):
        """In place: under another pressure `P`, with the fluid `part` on the `nodes` of a mask."""
        self.P = P
        for name in OF_PRESSURE:
            getattr(self, name)[nodes] = getattr(part, name)


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
    carried = contact_law.carried(H)
    return Fluid(
        P, H, carried, rho, drho_dP, eps, eps * (drho_dP / rho - dlog_eta_dP), 3.0 * by_H2 * dgap_dH
    )


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

FOLDING = ("geometric", "harmonic")
"""Means by which the flow through a face falls again where its nodes differ by much. By the logarithmic
mean it rises with the difference of the pressures, however large."""


LINEAR_GAP = "linear-gap"
"""Not a mean of the mobility alone: it asks for the gap, too."""

FACE_MOBILITIES = ("arithmetic", "logarithmic", LINEAR_GAP, "geometric", "harmonic")


@dataclass(frozen=True)
class FaceMobility:
    """Mobility of faces and its slopes by that of the nodes W and E, and by their gap beside it."""

    value: np.ndarray
    by_eps: tuple
    by_gap: tuple = ()
    """Nothing where the mobilities say it all."""

    def of_lines(self, axis, lines):
        """That of the faces of some `lines` of nodes (a slice), which lie along an `axis`."""

        def some(slopes):
            return tuple(axis.of_lines(each, lines) if np.ndim(each) else each for each in slopes)

        return FaceMobility(axis.of_lines(self.value, lines), some(self.by_eps), some(self.by_gap))


def face_mobility(scheme, eps, gaps):
    """The `FaceMobility` between nodes of mobilities `eps` and `gaps`, pairs (W, E), by the scheme's mean.

    With a `mobility_share` below 1 the rest is the arithmetic mean.
    """
    if scheme.face_mobility == LINEAR_GAP:
        found = _linear_gap_mobility(eps, gaps)
    else:
        value, *by_eps = FACE_MEANS[scheme.face_mobility](*eps)
        found = FaceMobility(value, tuple(by_eps))
    return found if scheme.mobility_share == 1.0 else _shared(found, scheme.mobility_share, eps)


def _linear_gap_mobility(eps, gaps):
    """Exact for one-dimensional flow by Barus's law that the pressure drives through a linear gap.

    e dp/dx = q/h^3 with e = exp(-alpha p) is integrated on both sides from node to node.
    """
    parts = np.empty((5, *np.shape(eps[0])))
    laid = [np.atleast_2d(each) for each in (*eps, *gaps, *parts)]
    linear_gap_means(*laid)
    value, by_w, by_e, by_gap_w, by_gap_e = parts
    return FaceMobility(value, (by_w, by_e), (by_gap_w, by_gap_e))


def _shared(found, share, eps):
    """A share of a mobility and the rest of the arithmetic mean."""
    paper, *by_eps = arithmetic_mean(*eps)
    rest = 1.0 - share
    slopes = tuple(share * own + rest * other for own, other in zip(found.by_eps, by_eps, strict=True))
    return FaceMobility(
        share * found.value + rest * paper, slopes, tuple(share * each for each in found.by_gap)
    )
