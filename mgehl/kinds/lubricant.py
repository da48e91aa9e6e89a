"""[lubricant]: its keys, what follows from an oil as data sheets give it, and the laws that they make."""

from dataclasses import dataclass, fields, replace

from mgehl.config_value import number, shown, word
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, Derived, word_of
from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS, Lubricant
from mgehl.model.oils import CELSIUS, OILS, thinning, walther
from mgehl.model.own_function import OwnFunction, absolute, is_own
from mgehl.model.own_laws import OwnDensity, OwnViscosity
from mgehl.model.sources import SOURCES

CONSTANT = "constant"
"""Viscosity that does not answer to pressure."""


@dataclass(frozen=True)
class LubricantSection:
    # fmt: off
    viscosity: float = number(0.096, "viscosity where p = 0", "Pa*s", 1e-6, 1e4,
        instead="lubricant.kinematic_viscosity takes cSt, beside lubricant.density")
    viscosity_law: str = word("barus", "viscosity-pressure law", tuple(VISCOSITY_LAWS), own=absolute)
    pressure_viscosity: float = number(18.2e-9, "pressure-viscosity coefficient", "1/Pa", 0.0, 1e-6)
    density_law: str = word("dowson-higginson", "density-pressure law", tuple(DENSITY_LAWS), own=absolute)
    oil: str | None = word(None, "a measured oil, for viscosity and its law at lubricant.temperature",
        tuple(OILS))
    temperature: float | None = number(None, "temperature of the oil in the inlet", "K", 200.0, 600.0)
    kinematic_viscosity: float | None = number(None, "viscosity over density, beside lubricant.density",
        "m^2/s", 1e-9, 10.0)
    kinematic_viscosity_40: float | None = number(None, "the same at 40 degrees C, from which with that at "
        "100 it is found at lubricant.temperature", "m^2/s", 2e-6, 0.1)
    kinematic_viscosity_100: float | None = number(None, "the same at 100 degrees C", "m^2/s", 1e-6, 0.1)
    density: float | None = number(None, "density at that temperature, some 5 % less at 80 than a data "
        "sheet's at 15 degrees C", "kg/m^3", 100.0, 1e4)
    conductivity: float | None = number(None, "thermal conductivity (mineral oils: .12 to .15)", "W/m/K",
        1e-3, 1e3)
    thermoviscosity: float | None = number(None, "beta of viscosity ~ exp(-beta T) (mineral oils: .02 to "
        ".06)", "1/K", 1e-5, 1.0)
    heating: str = word("none", "whether shear in the inlet thins the oil by a factor of the film (Gupta "
        "and others)", ("none", "factor"))
    # fmt: on


def law_choices(tables):
    """A constant viscosity does not answer to pressure."""
    if word_of(tables, "lubricant.viscosity_law") == CONSTANT:
        said = f'where lubricant.viscosity_law = "{CONSTANT}"'
        yield Choice(said, gives=("lubricant.pressure_viscosity",))


def derived_from_oil(config):
    """What follows from [lubricant]: `Derived`, in order. Raises ConfigError."""
    section = config.lubricant
    if section.viscosity_law == CONSTANT:
        yield Derived("lubricant.pressure_viscosity", 0.0, "a constant viscosity")
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
        cold, warm = (f"{100.0 * off:+.0f} %" for off in oil.off)
        yield f"beside its kinematic viscosities the formula is off by {cold} at 40 C, {warm} at 100 C"


def thinning_of(config):
    """beta = -d ln(eta)/dT in 1/K of an oil that is known over the temperature; None of others."""
    section = config.lubricant
    if section.oil is not None:
        return thinning(OILS[section.oil].viscosity, section.temperature)
    if section.kinematic_viscosity_40 is not None:
        return thinning(_by_walther(section), section.temperature)
    return None


def check_laws(config):
    """Raise ConfigError where a law has no meaning for this viscosity."""
    if is_own(config.lubricant.viscosity_law):
        return
    try:
        lubricant_from(config)
    except ValueError as error:
        viscosity = shown(config.lubricant.viscosity)
        raise ConfigError(f"lubricant.viscosity = {viscosity}: {error}") from None


def lubricant_from(config):
    """The lubricant, by built-in laws or the user's own. Raises ValueError where the numbers fit no law."""
    section = config.lubricant
    at_rest = section.viscosity, section.pressure_viscosity
    if section.oil is not None:
        # By the numbers of the run that is read, where that was made by other ones.
        viscosity = replace(
            OILS[section.oil].law(section.temperature), viscosity=at_rest[0], pressure_viscosity=at_rest[1]
        )
    elif is_own(section.viscosity_law):
        viscosity = OwnViscosity(*at_rest, OwnFunction(section.viscosity_law), section.temperature)
    else:
        law = VISCOSITY_LAWS[section.viscosity_law]
        viscosity = law(**{field.name: getattr(section, field.name) for field in fields(law)})
    if is_own(section.density_law):
        density = OwnDensity(OwnFunction(section.density_law), section.temperature)
    else:
        density = DENSITY_LAWS[section.density_law]()
    beta = thinning_of(config) if section.thermoviscosity is None else section.thermoviscosity
    known = section.conductivity, beta
    return Lubricant(viscosity, density, *known, ambient_pressure=config.contact.ambient_pressure)
