"""Configurations that nobody would write, drawn from the rules of the keys themselves.

`raw_tables` draws nested values as TOML gives them, right and wrong ones; `solvable_tables` values
that may be a contact, on the smallest grid and with few steps.
"""

from math import log10

from hypothesis import strategies as st

from mgehl.config import KEYS as FIELDS
from mgehl.config import SECTIONS
from mgehl.kinds import KINDS as EVERY_KIND
from mgehl.kinds import kind_choice

KEYS = {tuple(name.split(".")): (key.metadata, key.default) for name, key in FIELDS.items()}
"""Rules and default of every key."""

KINDS = tuple(EVERY_KIND)

STEPS = (0, 1, 2, 3, 3, 3, 3, 20)
"""Of Newton's method: mostly too few to get anywhere, sometimes enough to converge."""

SMALLEST, LARGEST = 1e-30, 1e30
"""Of numbers whose key has no limit."""

JUNK = st.one_of(
    st.none(), st.booleans(), st.text(max_size=20), st.floats(), st.integers(),
    st.sampled_from([10**400, -(10**400), 1e308, 5e-324, -0.0, float("nan"), float("inf")]),
    st.lists(st.floats(), max_size=3), st.dictionaries(st.text(max_size=5), st.integers(), max_size=2),
    st.dates(),
    st.sampled_from(

        ["1 kg", "2 furlong", "9**9**9", "nan m", "inf Pa", "1e999 m/s", "1 m/s/s", "1/s", "1 m^-9", "- m"]
        + ["1 °", "1 m m m m", "1e-400 N", "0x10 m", "1_0 m", "", " ", "m", "1 degC", "1 dB", "1 bit"]
    ),
)  # fmt: skip
"""What no key asks for."""

NAMES = st.text(min_size=1, max_size=12) | st.sampled_from(["Contact", "loads", "grid.nodes", "[grid]"])
"""Of sections and keys that do not exist."""


def belongs(kind, section, key):
    """Whether a kind of contact has a use for a key."""
    return not kind_choice(EVERY_KIND[kind]).means_nothing(f"{section}.{key}")


@st.composite
def right_values(draw, rules):
    """A value that its key takes, from the whole of its range; sometimes with a unit."""
    if rules["choices"]:
        return draw(st.sampled_from(sorted(rules["choices"])))
    if rules["kind"] is bool:
        return draw(st.booleans())
    if rules["kind"] is tuple:
        return [-draw(st.floats(1.001, 100.0)), draw(st.floats(1.001, 100.0))]
    low, high = limits(rules)
    number = draw(st.floats(low, high) if low < 0.0 else logarithmic(low, high))
    return as_written(draw, rules, number)


@st.composite
def usual_values(draw, rules, default):
    """A value within two decades of the default, where there is one to multiply."""
    if rules["kind"] in (bool, tuple) or rules["choices"] or not default:
        return draw(right_values(rules))
    number = default * 10.0 ** draw(st.floats(-2.0, 2.0))
    low, high = limits(rules)
    return as_written(draw, rules, min(max(number, low), high))


def limits(rules):
    """Smallest and largest number of a key; where there is none, or zero, one far away."""
    return rules["low"] or rules["above"] or SMALLEST, rules["high"] or LARGEST


def logarithmic(low, high):
    """A number between two positive ones, all decades alike."""
    return st.floats(log10(low), log10(high)).map(lambda power: min(max(10.0**power, low), high))


def as_written(draw, rules, number):
    """A number as it may stand in a file: whole, bare, or a text with a unit."""
    if rules["kind"] is int:
        return int(number)
    if rules["unit"] and draw(st.integers(0, 9)) == 0:
        return f"{number!r} {rules['unit']}"
    return number


@st.composite
def raw_tables(draw):
    """Nested values as TOML gives them, in half of all cases with one to three mistakes."""
    kind = draw(st.sampled_from(KINDS))
    tables = {"contact": {"kind": kind}}
    own = [key for key in sorted(KEYS) if belongs(kind, *key) and key != ("contact", "kind")]
    for section, key in draw(st.lists(st.sampled_from(own), max_size=8, unique=True)):
        tables.setdefault(section, {})[key] = draw(right_values(KEYS[section, key][0]))
    if "grid" in tables and "nodes" in tables["grid"]:
        tables["grid"]["nodes"] = draw(st.sampled_from([65, 129, 257, 1025]))
    for _ in range(max(0, draw(st.integers(-3, 3)))):
        draw(st.sampled_from(MISTAKES))(draw, tables)
    return tables


def wrong_value(draw, tables):
    section, key = draw(st.sampled_from(sorted(KEYS)))
    put(tables, section, key, draw(JUNK))


def foreign_key(draw, tables):
    section, key = draw(st.sampled_from(sorted(KEYS)))
    put(tables, section, key, draw(right_values(KEYS[section, key][0])))


def unknown_key(draw, tables):
    put(tables, draw(st.sampled_from(sorted(SECTIONS))), draw(NAMES), draw(JUNK))


def unknown_section(draw, tables):
    tables[draw(NAMES)] = {"key": 1}


def no_section(draw, tables):
    tables[draw(st.sampled_from(sorted(SECTIONS)))] = draw(JUNK)


MISTAKES = (wrong_value, wrong_value, foreign_key, unknown_key, unknown_section, no_section)


def put(tables, section, key, value):
    if isinstance(tables.setdefault(section, {}), dict):
        tables[section][key] = value


@st.composite
def solvable_tables(draw):
    """Values that may be a contact, on 65 nodes and with few steps of every iteration.

    One in ten is from anywhere in its range.
    """
    kind = draw(st.sampled_from(KINDS))
    tables = {"contact": {"kind": kind}}
    fixed = {("contact", "kind"), ("grid", "nodes"), ("solver", "max_steps"), ("moes", "M"), ("moes", "L")}
    own = [key for key in sorted(KEYS) if belongs(kind, *key) and key not in fixed]
    for section, key in draw(st.lists(st.sampled_from(own), max_size=12, unique=True)):
        rules, default = KEYS[section, key]
        anywhere = draw(st.integers(0, 9)) == 0
        values = right_values(rules) if anywhere else usual_values(rules, default)
        put(tables, section, key, draw(values))
    if belongs(kind, "moes", "M") and draw(st.integers(0, 5)) == 0:
        use_moes_numbers(draw, tables)
    put(tables, "grid", "nodes", 65)
    put(tables, "solver", "max_steps", draw(st.sampled_from(STEPS)))
    if belongs(kind, "relaxation", "max_sweeps"):
        put(tables, "relaxation", "max_sweeps", draw(st.integers(1, 5)))
    return tables


def use_moes_numbers(draw, tables):
    """In the place of load and speed."""
    tables["contact"].pop("load", None)
    tables.pop("motion", None)
    for key in ("M", "L"):
        put(tables, "moes", key, draw(right_values(KEYS["moes", key][0])))
