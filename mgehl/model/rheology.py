"""How a sheared oil resists: shear stress by the conditions at a node, as pure functions.

Which law is right is contested: Eyring's fits squalane on four rigs, limits fit twin discs [Neupert, Bartel
2023; Arana, Larranaga, Ulacia, Proc IMechE J 233 (2019) 303]. A result names the law that it is by.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.model.own_function import OwnFunction


@dataclass(frozen=True)
class Conditions:
    """Where a law of the lubricant is asked: arrays of one shape, or numbers that hold everywhere."""

    pressure: np.ndarray
    """In Pa, never negative."""
    viscosity: np.ndarray | None = None
    """In Pa s, of oil that is hardly sheared, at this pressure and temperature."""
    shear_rate: np.ndarray | None = None
    """In 1/s, never negative."""
    temperature: float | None = None
    """In K; None where the configuration names none."""


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


@dataclass(frozen=True)
class OwnRheology:
    """law(conditions) -> shear stress in Pa, of the user's own; `conditions` are `Conditions`."""

    function: OwnFunction

    name = "own"
    eyring_stress = None

    def shear_stress(self, at):
        """In Pa, at `Conditions`."""
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
        self.shear_stress(Conditions(p, np.full(p.shape, viscosity), np.full(p.shape, shear_rate)))


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
