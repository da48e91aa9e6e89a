"""What the heat of shear in the inlet takes of a film, by a formula, and oil that is so much thinner."""

from dataclasses import replace
from math import log

from mgehl.model import films

LEAST_HEATED = 0.2
"""Part of the film below which the factor of heat means nothing: its formula falls through 0."""


class InletHeat:
    """A part of `LoadedContact`."""

    @property
    def unheated(self):
        """The same contact with the oil's own viscosity, which no heat of shear has thinned."""
        return replace(self, lubricant=replace(self.lubricant, thinned=1.0))

    @property
    def thermal_reduction(self):
        """As `heated_film`; None without oil's data."""
        oil = self.lubricant
        if oil.conductivity is None or oil.thermoviscosity is None or self.is_at_rest:
            return None
        return self.heated_film(oil.thermoviscosity, oil.conductivity)

    def heated_film(self, beta, conductivity):
        """Phi_T: the part of the film that the heat of shear in the inlet leaves, of the oil that is not
        thinned yet, with beta = -d ln(eta)/dT in 1/K and its conductivity in W/(m K).

        [Gupta, Cheng, Zhu, Forster, Schrand 1992]
        """
        loading = self.lubricant.cold_viscosity * beta * self.speed**2 / conductivity
        like, slip = self.in_formulas, self.friction.slide_to_roll
        return films.inlet_heating(like.hertz.p_h / like.reduced_modulus, loading, slip)

    def heated(self):
        """The same contact with oil so much thinner that the film is thinner by Phi_T; cold at rest."""
        cold = self.unheated
        if self.is_at_rest:
            return cold
        part = max(cold.thermal_reduction, LEAST_HEATED) ** (1.0 / cold.film_exponent)
        return replace(cold, lubricant=replace(cold.lubricant, thinned=part))

    @property
    def film_exponent(self):
        """n of film ~ viscosity^n, by the formula of its regime."""
        return log(self.at_speed(1.01 * self.speed).flooded_film / self.flooded_film) / log(1.01)
