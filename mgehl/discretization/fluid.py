"""Nodal state of the lubricant and the mobility of a face between two nodes."""

from dataclasses import dataclass, fields, replace

import numpy as np

from mgehl.discretization.mean_kernels import linear_gap_means, logarithmic_means
from mgehl.model.rheology import effective_mobilities

VACUUM = 1e5
"""Pa below the pressure at which oil tears for which laws are asked at the most."""


@dataclass
class Fluid:
    """Density and mobility at nodes with their derivatives; all arrays of one shape. eps = rho* H^3/(eta*
    lambda)  [Liu eq. 26, in units of a^2/R]"""

    P: np.ndarray
    """The fluid's own pressure, in contact the one beside the solids'."""
    H: np.ndarray
    carried: np.ndarray
    """The part of H that the surfaces carry along where it is full of fluid."""
    rho: np.ndarray
    drho_dP: np.ndarray
    eps: np.ndarray
    deps_dP: np.ndarray
    deps_dH: np.ndarray
    follows: np.ndarray | None = None
    """Where `carried` follows H; None: everywhere."""
    torn: np.ndarray | None = None
    """Cavities; None where all count as full."""
    filling: np.ndarray | None = None
    """The part of `carried` that there is fluid: less than 1 in cavities alone; None as of `torn`."""
    across: np.ndarray | None = None
    """Mobility along Y where shear thins the oil, `eps` being that along X; None where both are one."""
    dacross_dP: np.ndarray | None = None
    dacross_dH: np.ndarray | None = None

    def mobility(self, axis):
        """Mobility along an axis with its derivatives by P and by H."""
        if axis.number or self.across is None:
            return self.eps, self.deps_dP, self.deps_dH
        return self.across, self.dacross_dP, self.dacross_dH

    def with_mobility(self, eps):
        """The same with another mobility along X, which neither pressure nor gap moves."""
        rigid = np.zeros(np.shape(eps))
        fluid = replace(self, eps=eps, deps_dP=rigid, deps_dH=rigid)
        if self.across is None:
            return fluid
        easier = np.divide(self.across, self.eps, out=np.ones(np.shape(eps)), where=self.eps > 0.0)
        return replace(fluid, across=eps * easier, dacross_dP=rigid, dacross_dH=rigid)

    def of(self, lines):
        """That of some lines of nodes (a slice): views."""
        arrays = (getattr(self, each.name) for each in fields(self))
        return Fluid(*(None if array is None else array[lines] for array in arrays))


def fluid_state(P, H, contact, contact_law, touching=None, torn=None, filling=None, tears=False):
    """Evaluate the constitutive laws at nodes of fluid pressure `P` and gap `H`.

    `contact` gives the lubricant, the unit of P and lambda; the `contact_law` the gap that the Poiseuille
    flow sees: at `touching` nodes what contact keeps. H must be positive wherever the node can exchange
    fluid. Nodes that are `torn`, whose pressure is given, hold their `filling`. Where oil `tears`, nodes
    that wait for their turn may have less pressure than it has laws for (`VACUUM`).
    """
    follows = None
    if touching is not None and not contact_law.closes_faces:
        H, follows = np.where(touching, contact_law.contact_gap, H), ~touching
    lubricant, p_h = contact.lubricant, contact.pressure_scale
    borne = np.maximum(P, contact.tears_at - VACUUM / p_h) if tears else P
    rho, drho_dP = lubricant.density(borne, p_h)
    log_eta, dlog_eta_dP = lubricant.log_viscosity(borne, p_h)
    by_H3 = rho * np.exp(-log_eta) / contact.lambda_
    gap, dgap_dH = contact_law.flow_gap(H)
    by_H2 = by_H3 * gap * gap
    eps = by_H2 * gap
    deps_dP, deps_dH = eps * (drho_dP / rho - dlog_eta_dP), 3.0 * by_H2 * dgap_dH
    carried = contact_law.carried(H)
    if torn is not None:
        filling, drho_dP = np.where(torn, filling, 1.0), np.where(torn, 0.0, drho_dP)
    fluid = Fluid(P, H, carried, rho, drho_dP, eps, deps_dP, deps_dH, follows, torn, filling)
    if contact.thinning is not None:
        _thin(fluid, contact.thinning * np.exp(log_eta), gap, dgap_dH, dlog_eta_dP)
    return fluid


def _thin(fluid, sheared, gap, dgap_dH, dlog_eta_dP):
    """Make a `Fluid` as mobile along X and Y as the shear leaves it, in place; the surfaces slide along X.
    `sheared` over the gap is sigma of `effective_mobilities`. A closed gap is not sheared."""
    is_open = gap > 0.0
    gap = np.where(is_open, gap, 1.0)
    sigma = np.where(is_open, sheared / gap, 0.0)
    by_P, by_H = sigma * dlog_eta_dP, -sigma * dgap_dH / gap
    along, across = (
        (
            factor * fluid.eps,
            factor * fluid.deps_dP + slope * by_P * fluid.eps,
            factor * fluid.deps_dH + slope * by_H * fluid.eps,
        )
        for factor, slope in effective_mobilities(sigma)
    )
    fluid.eps, fluid.deps_dP, fluid.deps_dH = along
    fluid.across, fluid.dacross_dP, fluid.dacross_dH = across


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


def _share(part, whole):
    """part/whole, zero where there is nothing (a closed gap's mobility may be negative)."""
    return np.divide(part, whole, out=np.zeros(np.broadcast(part, whole).shape), where=whole > 0.0)


ARITHMETIC = "arithmetic"
"""The paper's, the one mean that does not vanish with either side."""

FACE_MEANS = {ARITHMETIC: arithmetic_mean, "geometric": geometric_mean, "harmonic": harmonic_mean}
"""Means of two mobilities with their slopes by both; the others are `MONOTONE`."""

FOLDING = ("geometric", "harmonic")
"""Means by which the flow through a face falls again where its nodes differ by much. By the logarithmic
mean it rises with the difference of the pressures, however large."""

LINEAR_GAP = "linear-gap"
"""Not a mean of the mobility alone: it asks for the gap, too."""

FACE_MOBILITIES = (ARITHMETIC, "logarithmic", LINEAR_GAP, "geometric", "harmonic")


@dataclass(frozen=True)
class FaceMobility:
    """Mobility of faces and its slopes by that of the nodes W and E, and by their gap beside it."""

    value: np.ndarray
    by_eps: tuple
    by_gap: tuple = ()
    """Nothing where the mobilities say it all."""
    by_rho: tuple = ()
    """Slopes by the densities, the mobilities held; nothing where the mobilities say it all."""

    def times(self, weight):
        """That of faces which count `weight` times."""
        slopes = (tuple(weight * each for each in some) for some in (self.by_eps, self.by_gap, self.by_rho))
        return FaceMobility(weight * self.value, *slopes)

    def of_lines(self, axis, lines):
        """That of the faces of some `lines` of nodes (a slice), which lie along an `axis`."""

        def some(slopes):
            return tuple(axis.of_lines(each, lines) if np.ndim(each) else each for each in slopes)

        slopes = some(self.by_eps), some(self.by_gap), some(self.by_rho)
        return FaceMobility(axis.of_lines(self.value, lines), *slopes)


def face_mobility(scheme, eps, gaps, rho):
    """The `FaceMobility` between nodes of mobilities `eps`, `gaps` and densities `rho`, pairs (W, E), by
    the scheme's mean; with a `mobility_share` below 1 the rest is the arithmetic one."""
    if scheme.face_mobility in MONOTONE:
        found = _by_mean_density(MONOTONE[scheme.face_mobility], eps, gaps, rho)
    else:
        value, *by_eps = FACE_MEANS[scheme.face_mobility](*eps)
        found = FaceMobility(value, tuple(by_eps))
    return found if scheme.mobility_share == 1.0 else _shared(found, scheme.mobility_share, eps)


def _by_mean_density(mean, eps, gaps, rho):
    """The mean density times a `mean` of the mobilities without theirs. The mean of all would fold: where
    one side has no viscosity left, more pressure on the other would drive less."""
    volume = mean([each / density for each, density in zip(eps, rho, strict=True)], gaps)
    density = 0.5 * (rho[0] + rho[1])
    by_eps = tuple(density * slope / each for slope, each in zip(volume.by_eps, rho, strict=True))
    by_rho = tuple(
        0.5 * volume.value - slope * mobility / each
        for slope, mobility, each in zip(by_eps, eps, rho, strict=True)
    )
    by_gap = tuple(density * slope for slope in volume.by_gap)
    return FaceMobility(density * volume.value, by_eps, by_gap, by_rho)


def _logarithmic_mobility(eps, _gaps):
    """(a - b)/ln(a/b) of the mobilities a and b: vanishes with either side. Exact between nodes of one gap
    for Barus's law: their flow is that of the reduced pressure q = (1 - e^(-alpha p))/alpha."""
    parts = np.empty((3, *np.shape(eps[0])))
    logarithmic_means(*(np.atleast_2d(each) for each in (*eps, *parts)))
    value, *by_eps = parts
    return FaceMobility(value, tuple(by_eps))


def _linear_gap_mobility(eps, gaps):
    """Exact for one-dimensional flow by Barus's law that the pressure drives through a linear gap. e dp/dx
    = q/h^3 with e = exp(-alpha p) is integrated on both sides from node to node."""
    parts = np.empty((5, *np.shape(eps[0])))
    laid = [np.atleast_2d(each) for each in (*eps, *gaps, *parts)]
    linear_gap_means(*laid)
    value, by_w, by_e, by_gap_w, by_gap_e = parts
    return FaceMobility(value, (by_w, by_e), (by_gap_w, by_gap_e))


MONOTONE = {"logarithmic": _logarithmic_mobility, LINEAR_GAP: _linear_gap_mobility}
"""Means by which the flow through a face rises with the pressure that drives it, however large."""


def _shared(found, share, eps):
    """A share of a mobility and the rest of the arithmetic mean."""
    paper, *by_eps = arithmetic_mean(*eps)
    rest = 1.0 - share
    slopes = tuple(share * own + rest * other for own, other in zip(found.by_eps, by_eps, strict=True))
    by_gap, by_rho = (tuple(share * each for each in slopes) for slopes in (found.by_gap, found.by_rho))
    return FaceMobility(share * found.value + rest * paper, slopes, by_gap, by_rho)
