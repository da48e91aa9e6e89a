"""One value of a configuration against the rules of its key: kind, unit, range, choices."""

import re
import sys
from dataclasses import field
from functools import cache

from mgehl.errors import ConfigError

FARTHEST = 100.0
"""Largest distance of the domain's edge, in semi-axes of the contact."""

OWN = "FILE.py:FUNCTION"
"""How a user's own function is named."""

_UNIT = r"[A-Za-zµ°]+(?:(?:\^|\*\*)-?\d)?"
_QUANTITY = re.compile(rf"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*((?:1\s*)?/)?\s*({_UNIT}(?:[ */]+{_UNIT})*)?")
_NO_MATCH = re.match("(?P<number>)(?P<per>)(?P<units>)", "")
"""A quantity such as "7.5 mm/s" or "18.2 1/GPa", and one without a number, which no float reads."""


def key_field(
    default, help, unit=None, above=None, low=None, high=None, choices=None, kind=float, own=None
):
    """A dataclass field that carries its rules as metadata.

    `own`, of a word, reads what is none of the choices, a function of the user's own; it returns None
    for what it cannot read.
    """
    rules = {
        "help": help, "unit": unit, "above": above, "low": low, "high": high,
        "choices": choices, "kind": kind, "own": own,
        "words": (*(choices or ()), *([OWN] if own else [])),
    }  # fmt: skip
    return field(default=default, metadata=rules)


def read_value(key, rules, value):
    """The value that `value`, as read from TOML, stands for. Raises ConfigError."""
    if rules["kind"] is str:
        return _word(key, rules, value)
    if rules["kind"] is tuple:
        return _interval(key, value)
    if rules["kind"] is bool:
        if not isinstance(value, bool):
            raise ConfigError(f"{key} = {value!r}: must be true or false")
        return value
    number = _number(key, rules, value)
    if not _in_range(rules, number):
        raise ConfigError(f"{key} = {value!r}: must be {_describe_range(rules)}")
    return number


def _word(key, rules, value):
    read = rules["own"]
    if value in (rules["choices"] or ()):
        return value
    if read and (own := read(value)):
        return own
    one_of = "one of " if len(rules["words"]) > 1 else ""
    raise ConfigError(f"{key} = {value!r}: must be {one_of}{', '.join(rules['words'])}")


def _number(key, rules, value):
    if isinstance(value, str) and rules["unit"] is not None:
        value = _with_unit(key, rules["unit"], value)
    if not _is_number(value):
        raise ConfigError(f"{key} = {value!r}: must be {_describe_range(rules)}")
    if rules["kind"] is int:
        if value != int(value):
            raise ConfigError(f"{key} = {value!r}: must be {_describe_range(rules)}")
        return int(value)
    return float(value)


def _is_number(value):
    """A finite number that a double holds."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= sys.float_info.max


def _with_unit(key, unit, text):
    """The SI magnitude of a string such as "7.5 mm/s"."""
    import pint  # slow to import, so only where a unit is met

    example = f'a number in {unit or "no unit"} or a string such as "1 {unit}"'
    # Only a number and a unit: pint would also evaluate an expression, 9**9**9 for one.
    number, per, units = (_QUANTITY.fullmatch(text.strip()) or _NO_MATCH).groups()
    try:
        quantity = float(number) * _units()(f"{'1/' if per else ''}{units or 'dimensionless'}")
        return float(quantity.to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError:
        raise ConfigError(f"{key} = {text!r}: wrong unit; must be {example}") from None
    except Exception:
        raise ConfigError(f"{key} = {text!r}: not understood; must be {example}") from None


@cache
def _units():
    import pint

    return pint.UnitRegistry()


def _in_range(rules, number):
    above, low, high = rules["above"], rules["low"], rules["high"]
    return (
        (above is None or number > above)
        and (low is None or number >= low)
        and (high is None or number <= high)
    )


def _describe_range(rules):
    what = "a whole number" if rules["kind"] is int else "a number"
    if rules["unit"]:
        what += f" in {rules['unit']} (or a string with a unit)"
    limits = []
    for word, name in (("above", "above"), ("low", "at least"), ("high", "at most")):
        if rules[word] is not None:
            limits.append(f"{name} {rules[word]:g}")
    return " ".join([what, " and ".join(limits)]).strip()


def _interval(key, value):
    numbers = isinstance(value, list | tuple) and len(value) == 2
    numbers = numbers and all(_is_number(end) for end in value)
    if not numbers or not (-FARTHEST <= value[0] < -1.0 and 1.0 < value[1] <= FARTHEST):
        raise ConfigError(
            f"{key} = {value!r}: must be two numbers [first < -1, last > 1] within {FARTHEST:g}"
        )
    return float(value[0]), float(value[1])
