"""One value of a configuration against the rules of its key: kind, unit, range, choices."""

import re
import sys
from dataclasses import field
from functools import cache
from numbers import Real
from operator import ge, gt, le

import numpy as np

from mgehl.errors import ConfigError

AUTO = "auto"
"""A domain that is chosen by the contact's film."""

FARTHEST = 1000.0
"""Largest distance of the domain's edge, in semi-axes of the contact."""

OWN = "FILE.py:FUNCTION"
"""How a user's own function is named."""

LONGEST_SHOWN = 100
"""Characters of a wrong value that a message repeats."""

_UNIT = r"[A-Za-zµ°]+(?:(?:\^|\*\*)-?\d)?"
_QUANTITY = re.compile(rf"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*((?:1\s*)?/)?\s*({_UNIT}(?:[ */]+{_UNIT})*)?")
_NO_MATCH = re.match("(?P<number>)(?P<per>)(?P<units>)", "")
"""A quantity such as "7.5 mm/s" or "18.2 1/GPa", and one without a number, which no float reads."""

_PRINTED = (
    (re.compile("\u03bc"), lambda _: "\u00b5"),  # the Greek letter, and the sign that looks like it
    (re.compile(r"[·⋅∙]"), lambda _: "*"),
    (re.compile(r"(?<=[A-Za-z])(?<![\d.][eE])-(?=\d\b)"), lambda _: "^-"),
    (re.compile(r"(⁻?)([¹²³])"), lambda m: f"^{'-' if m[1] else ''}{'¹²³'.index(m[2]) + 1}"),
    (re.compile(r"/\s*\(([^()/]*)\)"), lambda m: "/" + "/".join(re.split(r"[ *]+", m[1].strip()))),
    (re.compile(r"(?<=[A-Za-z])(?<![\d.][eE])(?=\d\b)"), lambda _: "^"),
    (re.compile(r"(?<=[A-Za-z])\.(?=[A-Za-z])"), lambda _: "*"),
    (re.compile(r"\b(m?)Pas\b"), lambda m: f"{m[1]}Pa*s"),
    (re.compile(r"\bNs\b"), lambda _: "N*s"),
    (re.compile(r"\bfpm\b"), lambda _: "ft/min"),
    (re.compile(r"(?<=\d)\s*(?:(?:r|U|rev|\s1)? ?/ ?min|\smin\^-1|(?i:rpm|upm))$"), lambda _: " rpm"),
    (re.compile("[\u00c5\u212b]"), lambda _: "angstrom"),
    (re.compile(r"(?<=/)\s*(?:°C|degC)\b"), lambda _: "K"),  # a difference
    (re.compile(r"(?<=[WJ]) */ *(m|kg|m\^?3)[ *]*K\b"), lambda m: f"/{m[1].replace('m3', 'm^3')}/K"),
)
"""How data sheets print units that pint reads in another form: mPa·s, mm²/s, mm s-1, W/(m K), mPas,
kg/m3, mPa.s, Ns/m2, fpm, r/min, 1/min, RPM, Upm, and the angstrom's sign."""

_PERCENT = re.compile(r"\s*([-+]?\d*\.?\d+(?:[eE][-+]?\d+)?)\s*%\s*")

EXAMPLES = {"K": "60 degC", "rad/s": "6000 rpm", "1/Pa": "20 1/GPa", "Pa*s": "40 mPa*s"}
"""Values of units that people seldom say in SI."""

OF_TABLES = (".csv", ".txt", ".tsv", ".dat")
"""How files end that a key without a course in time was given."""

ANGLES = ("revolution", "turn", "radian", "degree", "grade")
"""Units of which an angle or a rotation must have one: pint takes 100 Hz for 100 rad/s, and 5 for 5 rad."""

LEFT_OUT = ("pandas", "xarray", "dask", "pint_pandas")
"""What pint would import for the sake of its arrays, in two thirds of the time that pint takes."""


class WrongUnitError(ConfigError):
    """A quantity in a unit of another kind."""


def number(default, help, unit=None, low=None, high=None, above=None, own=None, instead=""):
    """A key with a number from `low`, or `above` another, to `high`: a field whose metadata are its rules.
    `own` reads a word in its place, such as a function of the user's own, whose path counts from a
    directory, or returns None. `instead` names the key for what people often give here in another unit."""
    limits = {"above": above, "low": low, "high": high}
    return _key(default, help, float, unit=unit, own=own, instead=instead, **limits)


def whole(default, help, low, high=None):
    """A key with a whole number."""
    return _key(default, help, int, low=low, high=high)


def word(default, help, choices=None, own=None, own_name=OWN, also=None):
    """A key with one of some words, or with what `own` reads, called `own_name` in messages. `also` has
    other names of the words."""
    words = (*(choices or ()), *([own_name] if own else []))
    return _key(default, help, str, choices=choices, own=own, words=words, also=also or {})


def switch(default, help):
    """A key that is true or false."""
    return _key(default, help, bool)


def interval(default, help):
    """A key with the two ends of a domain, or "auto"."""
    return _key(default, help, tuple, words=(AUTO,))


_RULES = dict.fromkeys(("unit", "above", "low", "high", "choices", "own")) | {
    "instead": "",
    "words": (),
    "also": {},
}


def _key(default, help, kind, **rules):
    return field(default=default, metadata=_RULES | {"help": help, "kind": kind} | rules)


def shown(value):
    """A value as it stands in a message: no longer than a line."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):
        return f"<{type(value).__name__} too long to show>"  # a number of 5000 digits, for one
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}..."


def read_value(key, rules, value):
    """The value that `value`, as read from TOML, stands for. Raises ConfigError."""
    kind = rules["kind"]
    if (word := chosen(rules, value)) is not None:
        return word
    if rules["own"] and (own := rules["own"](value)):
        return own
    if kind is float or kind is int:
        return _number(key, rules, value)
    if kind is tuple:
        return _interval(key, value)
    if kind is bool and isinstance(value, bool | np.bool_):
        return bool(value)
    raise ConfigError(f"{key} = {shown(value)}: must be {describe_rules(rules)}")


def chosen(rules, value):
    """The one of a key's words that a value is; None if it is none of them."""
    if rules["also"] and isinstance(value, int):
        value = str(value)  # 52100, a steel
    if rules["kind"] is not str or not isinstance(value, str):
        return None
    names = {_plain(word): word for word in (*rules["also"], *(rules["choices"] or ()))}
    word = names.get(_plain(value))
    return rules["also"].get(word, word)


def _plain(word):
    """A word as people type it: in letters of either size, with or without spaces and hyphens."""
    return re.sub(r"[\s_-]", "", word.replace("\u03bc", "\u00b5")).casefold()


def read_quantity(name, text, unit):
    """The SI number above 0 that the word of a command line stands for. Raises ConfigError."""
    try:
        value = float(text)
    except ValueError:
        value = text
    return read_value(name, number(0.0, "", unit, above=0.0).metadata, value)


def _number(key, rules, given):
    value = given
    if isinstance(value, str) and rules["unit"] is not None:
        value = _with_unit(key, rules["unit"], value, rules["instead"])
    is_whole = rules["kind"] is int
    if isinstance(value, str) and not is_whole and (percent := _PERCENT.fullmatch(value)):
        value = 0.01 * float(percent[1])
    if not _is_number(value) or (is_whole and value != int(value)) or not _in_range(rules, value):
        wrong = given if _is_number(value) else value
        raise ConfigError(f"{key} = {shown(wrong)}: must be {_describe_range(rules)}")
    return rules["kind"](value)


def _is_number(value):
    """A finite number that a double holds, numpy's included."""
    is_real = isinstance(value, Real) and not isinstance(value, bool)
    return is_real and abs(value) <= sys.float_info.max


def _with_unit(key, unit, text, instead=""):
    """The SI magnitude of a string such as "7.5 mm/s"."""
    example = f'a number in {unit or "no unit"} or a string such as "{EXAMPLES.get(unit, f"1 {unit}")}"'
    # Only a number and a unit: pint would also evaluate an expression, 9**9**9 for one.
    plain = text.strip()
    for printed, typed in _PRINTED:
        plain = printed.sub(typed, plain)
    number, per, units = (_QUANTITY.fullmatch(plain) or _NO_MATCH).groups()
    try:
        if unit == "K":  # degrees have their zero elsewhere, and do not multiply; C is coulomb to pint
            units = {"C": "degC", "F": "degF"}.get(units, units)
            return float(_units().Quantity(float(number), units).to(unit).magnitude)
        quantity = float(number) * _units()(f"{'1/' if per else ''}{units or 'dimensionless'}")
        if unit in ("rad/s", "deg") and not any(word in str(quantity.units) for word in ANGLES):
            what = "of what, turns or radians?" if units else "has no unit;"
            raise ConfigError(f"{key} = {shown(text)}: {what} must be {example}")
        return float(quantity.to(unit or "dimensionless").magnitude)
    except ConfigError:
        raise
    except _pint().DimensionalityError:
        wrong, other = "wrong unit" if units else "has no unit", f"; {instead}" if instead else ""
        if unit == "N" and quantity.check("[mass]"):
            wrong = "is a mass, its weight is in kgf or lbf"
        raise WrongUnitError(f"{key} = {shown(text)}: {wrong}; must be {example}{other}") from None
    except Exception:
        why = "not understood"
        if text.strip().lower().endswith(OF_TABLES):
            why = "follows no table: only speed, angle and load change with time"
        raise ConfigError(f"{key} = {shown(text)}: {why}; must be {example}") from None


@cache
def _units():
    return _pint().UnitRegistry()


@cache
def _pint():
    """The library of units: slow to import, so only where a unit is met, and without what is `LEFT_OUT`.
    What the program has imported before, pint knows as ever."""
    left_out = [name for name in LEFT_OUT if name not in sys.modules]
    sys.modules.update(dict.fromkeys(left_out))  # whoever imports one of them is told that it is not there
    try:
        import pint
    finally:
        for name in left_out:
            del sys.modules[name]
    return pint


LIMITS = {"above": ("above", gt), "low": ("at least", ge), "high": ("at most", le)}
"""How a number stands to each limit of its key."""


def _in_range(rules, value):
    return all(holds(value, rules[end]) for end, (_, holds) in LIMITS.items() if rules[end] is not None)


def _describe_limits(rules):
    told = (f"{words} {rules[end]:g}" for end, (words, _) in LIMITS.items() if rules[end] is not None)
    return " and ".join(told)


def _describe_range(rules):
    what = "a whole number" if rules["kind"] is int else "a number"
    unit = f" in {rules['unit']} (or a string with a unit)" if rules["unit"] else ""
    return f"{what}{unit} {_describe_limits(rules)}".strip()


def _interval(key, value):
    value = value.tolist() if hasattr(value, "tolist") else value  # numpy's
    if isinstance(value, str) and value.casefold() == AUTO:
        return AUTO
    is_pair = isinstance(value, list | tuple) and len(value) == 2 and all(map(_is_number, value))
    if not is_pair or not (-FARTHEST <= value[0] < -1.0 and 1.0 < value[1] <= FARTHEST):
        raise ConfigError(
            f'{key} = {shown(value)}: must be "auto", or two numbers [first < -1, last > 1] '
            f"within {FARTHEST:g}"
        )
    return float(value[0]), float(value[1])


def describe_rules(rules):
    """What a key takes, in words: "one of barus, roelands", "N, at least 1e-06 and at most 1e+09"."""
    if rules["kind"] is tuple:
        return f"auto, or two numbers, the first below -1 and the last above 1, within {FARTHEST:g}"
    if rules["words"]:
        one_of = "one of " if len(rules["words"]) > 1 else ""
        return one_of + ", ".join(rules["words"])
    if rules["kind"] is bool:
        return "true or false"
    if rules["unit"]:
        return f"{rules['unit']}, {_describe_limits(rules)}"
    return _describe_range(rules)
