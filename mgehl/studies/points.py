"""Points of a sweep over several keys, in an order in which each is beside the one before.

The path is a snake: from one point to the next a single key changes, by one value.
"""

from dataclasses import dataclass
from math import prod

from mgehl.config import Config
from mgehl.errors import ConfigError
from mgehl.studies.axes import MOST_POINTS

WAYS = "there", "back"


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
    if len({*keys}) < len(keys):
        raise ConfigError(f"--over {max(keys, key=keys.count)}: is given twice")
    if prod(len(axis.values) for axis in axes) > MOST_POINTS:
        raise ConfigError(f"--over: has more than {MOST_POINTS} points")
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
