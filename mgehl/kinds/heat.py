"""[heat] and the lubricant's heating: bodies that conduct, oil that is thinned by the heat of its shear."""

from dataclasses import dataclass, fields

from mgehl.config_value import number, shown
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, given, word_of
from mgehl.kinds.lubricant import thinning_of
from mgehl.model.flash import Solid
from mgehl.model.inlet_heat import LEAST_HEATED
from mgehl.model.lubricant import USUAL_CONDUCTIVITY

THINNING = 0.04
"""Usual beta = -d ln(eta)/dT of oils in 1/K."""

WARM, LEAST_LEFT = 0.98, 0.5
"""Part of the film that heat leaves, below which it is told, and down to which the formula is trusted."""


@dataclass(frozen=True)
class HeatSection:
    # fmt: off
    conductivity_1: float | None = number(None, "thermal conductivity of body 1 (steel: 46); all four give "
        "flash temperatures", "W/m/K", 1e-3, 1e4)
    conductivity_2: float | None = number(None, "the same of body 2", "W/m/K", 1e-3, 1e4)
    capacity_1: float | None = number(None, "heat capacity of body 1 per volume (steel: 3.6e6)", "J/m^3/K",
        1e3, 1e8)
    capacity_2: float | None = number(None, "the same of body 2", "J/m^3/K", 1e3, 1e8)
    # fmt: on


OF_BODIES = tuple(f"heat.{field.name}" for field in fields(HeatSection))

OF_THE_OIL = "lubricant.conductivity", "lubricant.thermoviscosity"


def heat_choices(tables):
    """Bodies conduct by all four numbers or by none; a factor of the film needs two numbers of the oil, and
    means nothing to a wedge."""
    if found := given(tables, OF_BODIES):
        yield Choice(f"beside {found[0]}", needs=OF_BODIES)
    factor = word_of(tables, "lubricant.heating") == "factor"
    if word_of(tables, "contact.kind") == "wedge":
        heating = ("lubricant.heating",) if factor else ()
        yield Choice('where contact.kind = "wedge"', (*heating, *OF_THE_OIL))
    elif factor:
        known = given(tables, ("lubricant.oil", "lubricant.kinematic_viscosity_40"))
        needs = OF_THE_OIL[:1] if known else OF_THE_OIL
        yield Choice('where lubricant.heating = "factor"', needs=needs)


def check_factor(config, contact):
    """Raise ConfigError where the factor means nothing."""
    if contact.is_at_rest or config.lubricant.heating != "factor":
        return
    if contact.thermal_reduction < LEAST_HEATED:
        raise ConfigError(
            f"motion.speed = {shown(config.motion.speed)}: by the formula of lubricant.heating shear would "
            f"leave {contact.thermal_reduction:.2g} of the film; it must be at least {LEAST_HEATED:g}"
        )


def solids_from(config):
    """`Solid` of both bodies; None where nothing is said of them."""
    heat = config.heat
    if heat.conductivity_1 is None:
        return None
    return Solid(heat.conductivity_1, heat.capacity_1), Solid(heat.conductivity_2, heat.capacity_2)


def heated(config, contact):
    """The contact with so much less viscous oil that its film is thinner by Phi_T, where it is asked."""
    if config.lubricant.heating != "factor" or contact.is_at_rest:
        return contact
    return contact.heated()


def factor_words(contact):
    """What Gupta's factor leaves of the films of formulas, of an oil with the data for it."""
    if contact.thermal_reduction is not None:
        left = f"some {100.0 * max(contact.thermal_reduction, 0.0):.0f} %"
        does = f"leaves {left}" if contact.lubricant.thinned < 1.0 else f"would leave {left}"
        does = does if contact.thermal_reduction >= LEAST_HEATED else f"does not hold: it {does}"
        yield f'isothermal films: lubricant.heating = "factor" {does} of them (Gupta 1992)'


def heat_words(config, contact):
    """What shear in the inlet leaves of the film, for an oil known over the temperature or a usual one."""
    if contact.thermal_reduction is not None:
        return  # the run itself tells it, by the oil's own data
    oil, slip = contact.lubricant, contact.friction.slide_to_roll
    beta, k = oil.thermoviscosity or thinning_of(config), oil.conductivity
    factor = contact.heated_film(beta or THINNING, k or USUAL_CONDUCTIVITY)
    if factor < WARM and "piezoviscous" in contact.regime:
        left = f"some {100.0 * factor:.0f} %" if factor > LEAST_LEFT else "less than half"
        words = {f"beta {beta or THINNING:.2g} 1/K": beta, f"k {k or USUAL_CONDUCTIVITY:g} W/(m K)": k}
        given = "".join(f"{each}, " for each, known in words.items() if known)
        usual = " and ".join(each for each, known in words.items() if not known)
        data = f"{given}{usual} as is usual" if usual else given.removesuffix(", ")
        yield (
            f"isothermal films: heat by shear in the inlet would leave {left} of them (Gupta 1992; "
            f"slide-to-roll {slip:g}, {data})"
        )
