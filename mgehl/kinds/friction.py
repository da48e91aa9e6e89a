"""[friction]: which keys a law of the sheared oil takes, and the `Friction` that they make."""

from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, value_of
from mgehl.model.own_function import OwnFunction, is_own
from mgehl.model.own_laws import OwnRheology
from mgehl.model.rheology import Eyring, Friction, Limiting, Newtonian

PARAMETERS = STRESS, LIMIT, THINNING = (
    "friction.eyring_stress", "friction.limiting_coefficient", "friction.thinning",
)  # fmt: skip

TAKES = {"eyring": (STRESS, THINNING), "limiting": PARAMETERS}
NEEDS = {"eyring": (STRESS,), "limiting": (LIMIT,)}


def friction_choice(tables):
    """The `Choice` of friction.model; None where nothing is said of it, be it that it is unset."""
    section = tables.get("friction")
    if not isinstance(section, dict) or "model" not in section:
        return None
    model = value_of(tables, "friction.model")
    said = "without friction.model" if model is None else f'where friction.model = "{model}"'
    model = model if isinstance(model, str) else ""
    return Choice(said, PARAMETERS, TAKES.get(model, ()), NEEDS.get(model, ()))


def check_friction(config):
    """Raise ConfigError where the film cannot be thinned as it is asked."""
    section, motion = config.friction, config.motion
    if section.thinning and section.eyring_stress is None:
        raise ConfigError("friction.thinning = True: needs friction.eyring_stress")
    if section.thinning and isinstance(motion.speed, str):
        raise ConfigError("friction.thinning = True: needs a motion.speed that stays the same")
    if _thins(config) and motion.angle % 90.0:
        raise ConfigError(
            f"motion.angle = {motion.angle:g}: with friction.thinning it must be a multiple of 90; "
            "friction.thinning = false leaves the film as it is"
        )


def friction_from(config):
    """The `Friction` of a `Config`."""
    section = config.friction
    return Friction(
        _rheology(section), config.motion.slide_to_roll, section.boundary_coefficient, _thins(config)
    )


def _rheology(section):
    if is_own(section.model):
        return OwnRheology(OwnFunction(section.model))
    below = Newtonian() if section.eyring_stress is None else Eyring(section.eyring_stress)
    return Limiting(section.limiting_coefficient, below) if section.model == "limiting" else below


def _thins(config):
    section, slides = config.friction, config.motion.slide_to_roll != 0.0
    is_asked = section.eyring_stress is not None and section.thinning is not False
    return is_asked and slides and not isinstance(config.motion.speed, str)
