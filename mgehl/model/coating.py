"""A linear-elastic layer bonded to an elastic half-space, pressed without friction."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Coating:
    """One of the two bodies of a contact bears a layer, which replaces its outermost `thickness`. Lengths
    in m, moduli in Pa. `reduced_modulus` E' is that of both bodies without the layer, 2/E' the sum of their
    (1 - nu^2)/E; raises ValueError where the substrate alone is more compliant than that."""

    thickness: float
    modulus: float
    poisson: float
    substrate_modulus: float | None
    """None where each body has half of the compliance 2/E'."""
    substrate_poisson: float
    reduced_modulus: float

    def __post_init__(self):
        most = 2.0 / self.reduced_modulus
        if self._substrate > most * (1.0 + 1e-6):
            least = (1.0 - self.substrate_poisson**2) / most
            raise ValueError(
                f"both bodies without the coating have a reduced modulus of {self.reduced_modulus:.4g} Pa, "
                f"so that the substrate's modulus is at least {least:.4g} Pa"
            )

    @property
    def _substrate(self):
        """(1 - nu^2)/E of the substrate."""
        if self.substrate_modulus is None:
            return 1.0 / self.reduced_modulus
        return (1.0 - self.substrate_poisson**2) / self.substrate_modulus

    def compliance(self, k):
        """Deflection of both bodies at wave number `k` (1/m) over that without the layer."""
        layer = (1.0 - self.poisson**2) / self.modulus * self.layer_compliance(k * self.thickness)
        return 1.0 + 0.5 * self.reduced_modulus * (layer - self._substrate)

    def layer_compliance(self, kt):
        """Deflection of the coated body over that of a half-space of the layer's material. `kt` is the wave
        number times the thickness [O'Sullivan and King 1988; Nogi and Kato 1997]."""
        nu = self.poisson
        # Shear modulus over that of the substrate.
        rigidity = self.modulus / (1.0 + nu) * self._substrate / (1.0 - self.substrate_poisson)
        kappa = (rigidity - 1.0) / (rigidity + 3.0 - 4.0 * nu)
        lambda_ = 1.0 - 4.0 * (1.0 - nu) / (1.0 + rigidity * (3.0 - 4.0 * self.substrate_poisson))
        decay = np.exp(-2.0 * kt)
        twice = lambda_ * kappa * decay**2
        above = 1.0 + 4.0 * kt * kappa * decay - twice
        return above / (1.0 - (lambda_ + kappa + 4.0 * kappa * kt**2) * decay + twice)
