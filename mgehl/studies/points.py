"""Points of a sweep: keys and the values that they take, "1e-4..1 m/s:20", "50,100,200 N" or a list.

The path is a snake: from one point to the next a single key changes, by one value.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from math import prod

import numpy as np

from mgehl.config import KEYS, Config, checked_key
from mgehl.errors import ConfigError

MOST_POINTS = 10000

WAYS = "there", "back"

DECADE = 10.0
"""Last over first value beyond which the values of a range are of equal ratio."""

_NUMBER = r"[-+]?(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][-+]?\d+)?"
_RANGE = re.compile(
    rf"(?:(?P<how>lin|log)\()?\s*(?P<first>{_NUMBER})\.\.(?P<last>{_NUMBER})"
    r"\s*(?P<unit>[^:()]*?)\s*:\s*(?P<count>\d+)\s*(?(how)\))"
)
_ITEM = re.compile(rf"\s*({_NUMBER})\s*(.*?)\s*")


@dataclass(frozen=True)
class Axis:
    """A key and its values in SI units, in the order in which they are taken."""

    key: str
    values: tuple

    @property
    def name(self):
        """Of its dimension."""
        return self.key.replace(".", "_")

    @property
    def unit(self):
        """ "1" where it has none."""
        return KEYS[self.key].metadata["unit"] or "1"


def axis_of(config, key, values):
    """The `Axis` of a key; values are a list, or a text such as "1e-4..1 m/s:20" or "50,100,200 N". Raises
    ConfigError where the key cannot be swept, or where the values are none that it takes."""
    checked_key("--over", key)
    rules = KEYS[key].metadata
    if rules["kind"] not in (int, float):
        raise ConfigError(f"--over {key}: cannot be swept: only keys with a number can")
    if key.startswith("time."):
        raise ConfigError(f"--over {key}: cannot be swept: [time] tells of one run")
    values = values if isinstance(values, Iterable) else [values]
    found = _values(config, key, values) if isinstance(values, str) else _read(config, key, values)
    if len(found) < 2:
        raise ConfigError(f"--over {key}: has fewer than two values")
    if len({*found}) < len(found):
        raise ConfigError(f"--over {key}: has the same value twice")
    return Axis(key, tuple(found))


def first_of(text):
    """The first value that a text names, as `--set` takes it; the text where it names none."""
    if match := _RANGE.fullmatch(text.strip()):
        return f"{match['first']} {match['unit']}".strip()
    items = [_ITEM.fullmatch(item) for item in text.split(",")]
    return f"{items[0][1]} {items[0][2] or items[-1][2]}".strip() if all(items) else text


def _values(config, key, text):
    """The values that a text names."""
    told = f'--over {key}="{text}"'
    found = _of_range if ".." in text else _of_list
    return found(config, key, text, told)


def _of_list(config, key, text, told):
    """Those of "50,100,200 N"; messages begin with what was `told`."""
    items = [_ITEM.fullmatch(item) for item in text.split(",")]
    if not all(items):
        raise ConfigError(f'{told}: must be as "50,100,200 N" or "50..200 N:4"')
    if grouped := next((item[1] for item in items if re.match(r"[-+]?0\d", item[1])), None):
        raise ConfigError(f"{told}: {grouped} is no number: commas separate values, thousands need none")
    units = [item[2] for item in items]
    if any(units[:-1]) and not all(units):
        raise ConfigError(f"{told}: give each number its unit, or all of them one at the end")
    return _read(config, key, [_word(item[1], item[2] or units[-1]) for item in items])


def _of_range(config, key, text, told):
    """Those of "1e-4..1 m/s:20"; those between the ends have six digits."""
    match = _RANGE.fullmatch(text.strip())
    if not match:
        raise ConfigError(f'{told}: must be as "1e-4..1 m/s:20" or "log(1e-4..1 m/s:20)"')
    how, first, last, unit, count = match.groups()
    if KEYS[key].metadata["unit"] and not unit:
        raise ConfigError(f"{told}: needs a unit, such as {KEYS[key].metadata['unit']}")
    first, last = _read(config, key, [_word(first, unit), _word(last, unit)])
    if first == last or not 2 <= int(count) <= MOST_POINTS:
        raise ConfigError(f"{told}: is empty: needs two ends that differ and 2 to {MOST_POINTS} values")
    positive = first > 0.0 and last > 0.0
    if how == "log" and not positive:
        raise ConfigError(f"{told}: log needs ends above 0")
    by_ratio = how == "log" or (how is None and positive and max(first, last) > DECADE * min(first, last))
    space = np.geomspace if by_ratio else np.linspace
    inner = [float(f"{each:.6g}") for each in space(first, last, int(count))[1:-1]]
    return _read(config, key, [first, *inner, last])


def _word(number, unit):
    return f"{number} {unit}" if unit else float(number)


def _read(config, key, values):
    """Values as the key takes them, in SI units."""
    return [config.with_({key: value}).value(key) for value in values]


@dataclass(frozen=True)
class Point:
    """A point of a sweep: its place in the arrays, the way it is met on, its configuration."""

    number: int
    place: tuple
    way: int
    config: Config

    @property
    def run(self):
        """Name of its directory."""
        return f"{self.number:03d}"


def points_of(config, axes, both_ways=False):
    """The `Point`s of a sweep in order. Raises ConfigError where one cannot be used."""
    keys = [axis.key for axis in axes]
    if not keys:
        raise ConfigError("--over: names no key; must be as motion.speed='1e-4..1 m/s:20'")
    if len({*keys}) < len(keys):
        raise ConfigError(f"--over {max(keys, key=keys.count)}: is given twice")
    if prod(len(axis.values) for axis in axes) > MOST_POINTS:
        raise ConfigError(f"--over: has more than {MOST_POINTS} points")
    if both_ways and config.is_in_time:
        raise ConfigError("--both-ways: every run in time (time.end) begins anew, so both ways are one")
    path = [(place, 0) for place in _snake([len(axis.values) for axis in axes])]
    path += [(place, 1) for place, _ in path[::-1]] if both_ways else []
    values = [{axis.key: axis.values[k] for axis, k in zip(axes, place, strict=True)} for place, _ in path]
    return [
        Point(number, *each, config.with_(own))
        for number, (each, own) in enumerate(zip(path, values, strict=True), 1)
    ]


def _snake(lengths):
    """Places of an array, each beside the one before; the first index goes fastest."""
    if not lengths:
        return [()]
    outer, inner = _snake(lengths[1:]), range(lengths[0])
    return [(k, *rest) for turn, rest in enumerate(outer) for k in (inner[::-1] if turn % 2 else inner)]
