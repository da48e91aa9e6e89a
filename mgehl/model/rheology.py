"""How a sheared oil resists: shear stress by the conditions at a node, as pure functions.

Which law is right is contested: Eyring's fits squalane on four rigs, limits fit twin discs [Neupert, Bartel
2023; Arana, Larranaga, Ulacia, Proc IMechE J 233 (2019) 303]. A result names the law that it is by.
"""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.model.own_laws import OwnRheology


@dataclass(frozen=True)
class Newtonian:
    """tau = eta gamma'."""

    name = "newtonian"
    eyring_stress = None

    def shear_stress(self, at):
        """In Pa, at `Conditions`."""
        return at.viscosity * at.shear_rate


@dataclass(frozen=True)
class Eyring:
    """tau = tau_0 asinh(eta gamma'/tau_0)  [Eyring 1936; Johnson, Tevaarwerk 1977]."""

    eyring_stress: float
    """tau_0 in Pa."""

    name = "eyring"

    def shear_stress(self, at):
        """In Pa, at `Conditions`."""
        return self.eyring_stress * np.arcsinh(at.viscosity * at.shear_rate / self.eyring_stress)


@dataclass(frozen=True)
class Limiting:
    """min(tau of another law, Lambda p): no oil resists by more than a part of its pressure."""

    coefficient: float
    """Lambda."""
    below: Newtonian | Eyring

    name = "limiting"

    @property
    def eyring_stress(self):
        """That of the law below the limit, in Pa; None without one."""
        return self.below.eyring_stress

    def shear_stress(self, at):
        """In Pa, at `Conditions`."""
        return np.minimum(self.below.shear_stress(at), self.coefficient * at.pressure)


SERIES = 1e-3
"""Below this sigma/asinh(sigma) is a series: there its slope has 16 digits, the formula 10."""


def effective_mobilities(sigma):
    """What shear multiplies the mobility by, along the sliding and across, with slopes by `sigma`.

    Two pairs (value, slope), shapes as sigma = eta V/(h tau_0), where the oil follows Eyring's law, V is
    the sliding speed and pressure gradients are small beside it  [Ehret, Dowson, Taylor, Proc R Soc A 454
    (1998) 763]. The stress tau of the sliding is the same at all heights, sinh(tau/tau_0) = sigma. To first
    order shear rates change by a gradient's stress times (1/eta) cosh(tau/tau_0) along the sliding and
    (1/eta) sinh(tau/tau_0)/(tau/tau_0) across, where only its direction changes.
    """
    along = np.sqrt(1.0 + sigma * sigma)
    stress = np.arcsinh(sigma)
    small = sigma < SERIES
    one = np.where(small, 1.0, stress)
    across = np.where(small, 1.0 + sigma * sigma / 6.0, sigma / one)
    slope = np.where(small, sigma / 3.0, (1.0 - across / along) / one)
    return (along, sigma / along), (across, slope)


@dataclass(frozen=True)
class Friction:
    """How the surfaces slide over each other, and what resists."""

    rheology: Newtonian | Eyring | Limiting | OwnRheology = Newtonian()
    slide_to_roll: float = 0.0
    """2 (u_1 - u_2)/(u_1 + u_2): body 1 is the faster one where it is positive."""
    boundary_coefficient: float = 0.1
    """Shear stress between solids over the pressure that they carry."""
    thins: bool = False
    """Whether the film is solved with the viscosity that the sliding leaves (`effective_mobilities`)."""

    def sliding_speed(self, speed):
        """u_1 - u_2 in m/s, without its sign, at an entrainment speed in m/s."""
        return abs(self.slide_to_roll) * speed

    def slowed(self, share):
        """The same where the surfaces slide by `share` times as much."""
        return self if share == 1.0 else replace(self, slide_to_roll=share * self.slide_to_roll)
