"""The oil as data sheets give it: kinematic viscosity with density, at two temperatures, or by its name."""

from mgehl.errors import ConfigError
from mgehl.kinds.derived import Derived
from mgehl.model.oils import CELSIUS, OILS, thinning, walther
from mgehl.model.sources import SOURCES


def derived(config):
    """What follows from [lubricant]: `Derived`, in order. Raises ConfigError."""
    section = config.lubricant
    if section.oil is not None:
        law = OILS[section.oil].law(section.temperature)
        words = f"{section.oil} at {section.temperature - CELSIUS:.4g} C"
        yield Derived("lubricant.viscosity", law.viscosity, words)
        yield Derived("lubricant.pressure_viscosity", law.pressure_viscosity, f"{words}, where p = 0")
    elif section.kinematic_viscosity is not None:
        yield _dynamic(section, section.kinematic_viscosity, "")
    elif section.kinematic_viscosity_40 is not None:
        if section.kinematic_viscosity_40 <= section.kinematic_viscosity_100:
            raise ConfigError(
                f"lubricant.kinematic_viscosity_40 = {section.kinematic_viscosity_40:g}: must be above "
                f"that at 100 C, {section.kinematic_viscosity_100:g}"
            )
        words = f" at {section.temperature - CELSIUS:.4g} C by Walther's equation"
        yield _dynamic(section, _by_walther(section)(section.temperature), words)


def _dynamic(section, kinematic, words):
    words = f"{1e6 * kinematic:.4g} cSt{words}, times {section.density:g} kg/m^3"
    return Derived("lubricant.viscosity", kinematic * section.density, words)


def _by_walther(section):
    """The kinematic viscosity as a function of the temperature."""
    return lambda T: walther(section.kinematic_viscosity_40, section.kinematic_viscosity_100, T)


def oil_words(config):
    """Where a named oil was measured and what is not known of it; nothing of others."""
    if config.lubricant.oil is not None:
        oil = OILS[config.lubricant.oil]
        yield f"{oil.description}, {SOURCES[oil.source].short}"
        yield (
            f"measured from {oil.coldest - CELSIUS:g} to {oil.warmest - CELSIUS:g} C and up to "
            f"{1e-9 * oil.highest:g} GPa; not known: {oil.unknown}"
        )


def thinning_of(config):
    """beta = -d ln(eta)/dT in 1/K of an oil that is known over the temperature; None of others."""
    section = config.lubricant
    if section.oil is not None:
        return thinning(OILS[section.oil].viscosity, section.temperature)
    if section.kinematic_viscosity_40 is not None:
        return thinning(_by_walther(section), section.temperature)
    return None
