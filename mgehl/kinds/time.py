"""What changes with time: keys of [time], and the `Scene` that they and the motion make."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mgehl.config_value import WrongUnitError, number, read_quantity, word
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, given
from mgehl.kinds.own import naming
from mgehl.kinds.surface_kinds import every_surface, number_of, share_of
from mgehl.model.course import SAMPLES, Recorded, Table, course_of
from mgehl.model.frame import direction
from mgehl.model.own_function import is_own
from mgehl.model.scene import CLOSE, Scene, directions
from mgehl.model.text_table import unit_words


@dataclass(frozen=True)
class TimeSection:
    # fmt: off
    end: float | None = number(None, "time at which a run in time ends (unset: a steady state)", "s",
        above=0.0, high=1e9)
    step: float | None = number(None, "step in time (unset: by the cells that surfaces go, and by the "
        "error)", "s", above=0.0, high=1e9)
    tolerance: float = number(1e-3, "residual that a step may leave, over that with which it begins",
        above=0.0, high=0.1)
    save_every: float | None = number(None, "time after which the next step's fields are kept (unset: "
        "50 in a run)", "s", above=0.0, high=1e9)
    until: str = word("end", "when it ends: at time.end, or before when mean gap and load on solids "
        "over passages have settled, at a speed and a load that stay",
        ("end", "settled"))
    # fmt: on


SINGLE = "shN°"
"""Headings of one letter that are units: c is no speed of light, and t no tonne."""

MOST_TURNED = 36000.0
"""Degrees, a hundred turns, to which a direction may go."""

ONLY_IN_TIME = {
    "motion.speed": "m/s", "motion.angle": "deg", "contact.load": "N", "contact.load_per_length": "N/m",
}  # fmt: skip
"""Keys that may be a course of time, and their units."""

SLOWEST = 1e-12
"""m/s that surfaces of a steady film have at the least."""

UNIT_OF_REST = 1e-3
"""Speed in m/s in whose units a run is solved throughout which surfaces stand still."""

MOST_STEPS = 1e6
"""Steps of a run that may be asked for."""

NEEDED = {"solver.method": "newton-mg", "discretization.contact_model": "lcic"}
"""What a run in time is made for alone."""


def time_choices(tables):
    """To a steady state keys of [time] mean nothing."""
    within = "time.step", "time.save_every"
    if given(tables, within) and not given(tables, ["time.end"]):
        yield Choice("without time.end", within)


def is_table(key, value):
    """Whether a key's value names a table of time."""
    return key in ONLY_IN_TIME and isinstance(value, str) and not is_own(value)


def course(key, value):
    """The `Course` of a key: of a table by the names and units in its heading, else in SI units."""
    found, name = course_of(value), f"{key} = {value!r}"
    if not isinstance(found, Table) or len(heading := found.heading) < 2:
        return found
    column = _column_of(name, heading, key) if len(heading) > 2 else 1
    units = (heading[0], "s"), (heading[column], ONLY_IN_TIME[key])
    scale = tuple(_in_si(name, *each) or 1.0 for each in units)
    return replace(found, scale=scale, column=column)


def _column_of(name, heading, key):
    """Which of several columns is that of a key: the only one in its unit, or of its name. Raises
    ConfigError."""
    in_unit, named, own_name = [], [], key.rpartition(".")[2].split("_")[0]
    for k, words in enumerate(heading[1:], 1):
        try:
            in_unit += [k] if _in_si(name, words, ONLY_IN_TIME[key]) else []
        except ConfigError:
            continue
        named += [k] if words.lower().startswith(own_name) else []
    for found in (in_unit, named):
        if len(found) == 1:
            return found[0]
    columns = ", ".join(map(repr, heading[1:]))
    must = f"must be one in {ONLY_IN_TIME[key]}, or one whose name begins with {own_name!r}"
    raise ConfigError(f"{name}: which of its columns {columns} is meant? {must}")


def own_courses(config):
    """{key: values at even times until time.end} of keys whose course is a function of the user's own."""
    found = {key: course(key, config.value(key)) for key in ONLY_IN_TIME if is_own(config.value(key))}
    times = np.linspace(0.0, config.time.end or 0.0, SAMPLES)
    return {key: np.array([each.value(t) for t in times]) for key, each in found.items()}


def with_recorded(tables, courses):
    """Nested tables with what own courses gave, as `own_courses` has it, in the place of their functions.

    Raises KeyError where one is not known.
    """
    laid = {section: dict(table) for section, table in tables.items()}
    for key in ONLY_IN_TIME:
        section, _, name = key.partition(".")
        if is_own(value := laid.get(section, {}).get(name)):
            laid[section][name] = Recorded.of(value, laid["time"]["end"], courses[key])
    return laid


def _in_si(name, heading, unit):
    """The unit that a column's heading tells, in SI; None where it is but a name. Raises ConfigError."""
    words = unit_words(heading)
    is_name, tells = heading in words and "/" not in heading, "tells no unit of its column"
    for found in words:
        if found == heading and len(found) == 1 and found not in SINGLE:
            continue
        try:
            return read_quantity(name, f"1 {found}", unit)
        except WrongUnitError:
            is_name = is_name and len(found) == 1  # t is a tonne, too
            tells = f"tells the unit {found!r}"
        except ConfigError:
            continue
    if is_name:
        return None
    raise ConfigError(f"{name}: its heading {heading!r} {tells}; must be such as [{unit}]")


def of_first_load(config):
    """Words after what is that of the first load, where the load is a course; else empty."""
    return ", of the first load" if isinstance(config.value(config.kind.load_key), str) else ""


def of_formulas(config):
    """Words after what formulas tell of a contact that changes with time; else empty."""
    fastest = ", at the largest speed" if isinstance(config.motion.speed, str) else ""
    turns = ", in the first direction" if len(set(range_of(config, "motion.angle"))) > 1 else ""
    return f"{of_first_load(config)}{fastest}{turns}"


def reference(config, key):
    """A number for the value of a key that may be a course: its largest size until time.end.

    Of the angle the first one; of the load, too, if there is any. Of surfaces that stand still a unit.
    """
    value, (least, most) = config.value(key), range_of(config, key)
    if key == "motion.speed":
        return max(abs(least), abs(most)) or UNIT_OF_REST
    if not isinstance(value, str):
        return value
    first = course(key, value).value(0.0)
    return first if first > 0.0 or key == "motion.angle" else most


def stands_still(config):
    """Whether the surfaces do throughout a run in time: what flows is squeezed."""
    return config.is_in_time and config.moes.M is None and not any(range_of(config, "motion.speed"))


def _ends_at_rest(config):
    """Whether surfaces stand still when a run in time ends."""
    if not config.is_in_time or config.moes.M is not None:
        return False
    return course("motion.speed", config.motion.speed).value(config.time.end) == 0.0


def check_motion(config):
    """Raise ConfigError where a steady film has no motion."""
    speed = config.motion.speed
    if isinstance(speed, str) or config.moes.M is not None or speed >= SLOWEST:
        return
    if config.time.end is None or speed > 0.0:
        still = '; bodies stand still in time (time.end), or where discretization.contact_model = "dry"'
        more = still if config.kind.is_loaded else ""
        raise ConfigError(f"motion.speed = {speed:g}: must be at least {SLOWEST:g}{more}")


def check_courses(config):
    """Raise ConfigError where a course is none, or where there is no time for it."""
    step, end = config.time.step, config.time.end
    for key in ONLY_IN_TIME:
        value = config.value(key)
        if not isinstance(value, str):
            continue
        if wrong := _wrong_with(key, value, end):
            raise ConfigError(f"{key} = {value!r}: {wrong}")
        if config.time.until == "settled" and course(key, value).stays_from(end) >= end:
            raise ConfigError(f'time.until = "settled": must be "end" where {key} changes until time.end')
    if config.time.until == "settled" and _ends_at_rest(config):
        raise ConfigError('time.until = "settled": must be "end" where motion.speed is 0 at time.end')
    if end is None:
        if config.time.until == "settled":
            raise ConfigError('time.until = "settled": means nothing without time.end')
        return
    for key in ("step", "save_every"):
        asked = getattr(config.time, key)
        if asked is not None and asked > end:
            raise ConfigError(f"time.{key} = {asked:g}: must be at most {end:g}, time.end")
    if step is not None and step < end / MOST_STEPS:
        raise ConfigError(f"time.step = {step:g}: must be at least {end / MOST_STEPS:g} until time.end")
    for key, needed in NEEDED.items():
        if config.value(key) != needed:
            raise ConfigError(f'{key} = "{config.value(key)}": must be "{needed}" in time (time.end)')
    if not config.kind.is_loaded:
        raise ConfigError(f'contact.kind = "{config.contact.kind}": a run in time (time.end) needs a load')


def _wrong_with(key, value, end):
    """What is wrong with a course until `end`; None where nothing is."""
    if end is None:
        return "changes with time, and time.end is not given"
    with naming(f"{key} = {value!r}"):
        found = course(key, value)
        found.check(end)
    least, most = found.range(end)
    if key == "motion.angle":
        turned = max(least, most, key=abs)
        return (
            None if abs(turned) <= MOST_TURNED else f"turns to {turned:g}; must stay within {MOST_TURNED:g}"
        )
    if key != "motion.speed":
        return None if least > 0.0 else f"falls to {least:g}; must stay above 0"
    return "begins below 0; turn motion.angle by 180 degrees" if found.value(0.0) < 0.0 else None


def range_of(config, key):
    """The least and the largest value of a key that may be a course, until time.end."""
    value = config.value(key)
    if not isinstance(value, str):
        return value, value
    with naming(f"{key} = {value!r}"):
        return course(key, value).range(config.time.end or 0.0)


def extremes(config, contact):
    """The contact at its least and at its largest load until time.end; it alone where that stays."""
    loads = range_of(config, config.kind.load_key)
    if config.moes.M is not None or loads[0] == loads[1]:
        return (contact,)
    return tuple(replace(contact, load=load) for load in loads)


def towards_all(config, contact):
    """The contact with the motion in each of its directions until time.end."""
    if not config.is_in_time:
        return [contact]
    angles = directions(course("motion.angle", config.motion.angle), config.time.end)
    return [contact.turned(angle) for angle in angles]


def begins_at_rest(config):
    """Whether a run in time begins with surfaces at rest: from the dry contact."""
    if not config.is_in_time or config.moes.M is not None:
        return False
    return course("motion.speed", config.motion.speed).value(0.0) == 0.0


PARTS = 200
"""Parts of a run whose ways are added up to find how far a surface gets."""


def ways_of(config, contact, name, begin=(0.0, 0.0)):
    """The farthest ways (x, y) in m that the surface of a section goes in time; none of one that rests.

    The mean surface has gone the path `begin` before.
    """
    section = getattr(config, name)
    share = share_of(section.body, config.motion.slip)
    if not config.is_in_time or share == 0.0 or config.moes.M is not None:
        return []
    scene, times = scene_of(config, contact), np.linspace(0.0, config.time.end, PARTS + 1)
    path = share * np.cumsum([begin, *(scene.way(*ends) for ends in pairwise(times))], axis=0)
    towards = np.array([direction(angle) for angle in np.arange(0.0, 360.0, CLOSE)])
    farthest = np.unique(np.argmax(path @ towards.T, axis=0))
    return [(x, y) for x, y in path[farthest].tolist() if x or y]


def scene_of(config, contact):
    """The `Scene` of a run in time; the `contact` has the largest speed and the first load."""
    key, by_moes = config.kind.load_key, config.moes.M is not None
    load = course(key, contact.load if by_moes else config.value(key))
    speed = course("motion.speed", contact.speed if by_moes else config.motion.speed)
    slip, angle = config.motion.slip, course("motion.angle", config.motion.angle)
    surfaces = tuple(
        (surface, share_of(body, slip), number_of(body, slip)) for _, surface, body in every_surface(config)
    )
    return Scene(contact, speed, load, surfaces, config.time.end, angle)
