"""[friction]: its keys, which of them a law of the sheared oil takes, the `Friction` that they make."""

from dataclasses import dataclass

from mgehl.config_value import number, shown, switch, word
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice
from mgehl.kinds.time import range_of
from mgehl.model.own_function import OwnFunction, absolute, is_own
from mgehl.model.own_laws import OwnRheology
from mgehl.model.rheology import Eyring, Friction, Limiting, Newtonian


@dataclass(frozen=True)
class FrictionSection:
    # fmt: off
    model: str | None = word(None, "how the sheared oil resists (unset: newtonian)",
        ("newtonian", "eyring", "limiting"), own=absolute)
    eyring_stress: float | None = number(None, "tau_0 of tau = tau_0 asinh(eta gamma'/tau_0), below a "
        "limit, too", "Pa", 1e3, 1e9)
    limiting_coefficient: float | None = number(None, "largest shear stress of the oil over its pressure "
        "(.03 to .06 measured)", above=0.0, high=1.0)
    boundary_coefficient: float = number(Friction.boundary_coefficient, "shear stress between solids over "
        "the pressure they carry (.08 to .135 measured)", low=0.0, high=2.0)
    thinning: bool | None = switch(None, "whether shear thins the film (unset: where there is an Eyring "
        "stress and surfaces slide)")
    # fmt: on


PARAMETERS = STRESS, LIMIT, THINNING = (
    "friction.eyring_stress", "friction.limiting_coefficient", "friction.thinning",
)  # fmt: skip

TAKES = {"eyring": (STRESS, THINNING), "limiting": PARAMETERS}
NEEDS = {"eyring": (STRESS,), "limiting": (LIMIT,)}


def friction_choices(tables):
    """What friction.model makes of its parameters, where it is given, be it as unset."""
    section = tables.get("friction")
    if isinstance(section, dict) and "model" in section:
        model = section["model"]
        said = "without friction.model" if model is None else f'where friction.model = "{model}"'
        model = model if isinstance(model, str) else ""
        yield Choice(said, PARAMETERS, TAKES.get(model, ()), NEEDS.get(model, ()))


def check_friction(config):
    """Raise ConfigError where the film cannot be thinned as it is asked."""
    section = config.friction
    if section.thinning and section.eyring_stress is None:
        raise ConfigError("friction.thinning = True: needs friction.eyring_stress")
    least, most = range_of(config, "motion.angle")
    if _thins(config) and (least < most or least % 90.0):
        angle, must = (f"{least:g}", "be") if least == most else (shown(config.motion.angle), "stay at")
        raise ConfigError(
            f"motion.angle = {angle}: with friction.thinning it must {must} a multiple of 90; "
            "friction.thinning = false leaves the film as it is"
        )


def friction_from(config):
    """The `Friction` of a `Config`."""
    section = config.friction
    return Friction(
        _rheology(section, config.lubricant.temperature),
        config.motion.slip,
        section.boundary_coefficient,
        _thins(config),
    )


def _rheology(section, temperature):
    if is_own(section.model):
        return OwnRheology(OwnFunction(section.model), temperature)
    below = Newtonian() if section.eyring_stress is None else Eyring(section.eyring_stress)
    return Limiting(section.limiting_coefficient, below) if section.model == "limiting" else below


def _thins(config):
    section, slides = config.friction, config.motion.slip != 0.0
    is_asked = section.eyring_stress is not None and section.thinning is not False
    return is_asked and slides


def thinning_words(contact):
    """What formulas do not know where shear thins the film; nothing elsewhere."""
    if contact.friction.thins:
        yield "shear thins the oil: formulas do not know of it, and the inlet has fewer cells than they say"
