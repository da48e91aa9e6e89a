"""Sections of a run's page that every kind of contact has."""

from dataclasses import fields
from itertools import groupby
from pathlib import Path

from mgehl.config import SECTIONS
from mgehl.model.own_function import file_and_function
from mgehl.output.files import plain_result
from mgehl.output.report.page import Cell, Section, Text, number, table


def configuration_section(config):
    """Every key that the contact heeds, by sections; what differs from the default is in bold."""
    rows = []
    for name in SECTIONS:
        own = _key_rows(name, getattr(config, name), config)
        rows += [(Cell(f"[{name}]"),), *own] if own else []
    caption = (
        "Values that were used; in bold those that differ from the default, with the default beside them"
    )
    whole = table(caption, ("key", "value", "instead of", "meaning"), rows)
    return Section("configuration", "Configuration", (whole,))


def _key_rows(name, section, config):
    unused = set(config.unused)
    if name in unused:
        return []
    keys = [key for key in fields(section) if f"{name}.{key.name}" not in unused]
    return [_key_row(name, key, getattr(section, key.name)) for key in keys]


def _key_row(section, key, value):
    used, default = (setting(each, key.metadata["unit"]) for each in (value, key.default))
    changed = used != default
    return (
        Cell(f"{section}.{key.name}", "code"),
        Cell(used, "changed" if changed else ""),
        default if changed else "",
        key.metadata["help"],
    )


def setting(value, unit=None):
    """A value of the configuration as text; ten digits tell apart all that anyone would write."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value:.10g} {unit or ''}".strip()
    if value is None:
        return "unset"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return " to ".join(map(setting, value))
    if own := file_and_function(value):
        return f"{Path(own[0]).name}:{own[1]}"
    return str(value)


HISTORY_NAMES = {
    "grid": "nodes", "speed_mm_s": "speed, mm/s", "central_film_nm": "central film, nm",
    "minimum_film_nm": "minimum film, nm", "seconds": "time, s", "e_p": "e^p", "e_p_lubr": "e^p of fluid",
    "e_p_solid": "e^p of contact",
}  # fmt: skip
"""Headings of columns of history.csv that are not plain words."""

LONG_HISTORY = 400
"""Cycles on one grid beyond which the page leaves out those in between: relaxation takes thousands."""


def history_section(rows, drawn=()):
    """Pictures `drawn` of the history, the last cycle of every grid, and all cycles, folded."""
    if not rows:
        return Section("history", "Convergence history", (Text("No cycle was recorded."),))
    grids = [list(cycles) for _, cycles in groupby(rows, key=lambda row: row["grid"])]
    heads = [HISTORY_NAMES.get(name, name.replace("_", " ")) for name in rows[0]]
    last = [_history_row(cycles[-1]) for cycles in grids]
    shown = [row for cycles in grids for row in _thinned(cycles)]
    every = "Every cycle" if len(shown) == len(rows) else f"{len(shown)} of {len(rows)} cycles"
    return Section(
        "history",
        "Convergence history",
        (
            *drawn,
            table("The last cycle on every grid", heads, last),
            table(every, heads, map(_history_row, shown), folded=True),
        ),
    )


def _thinned(cycles):
    """At most about `LONG_HISTORY` cycles, the last one among them."""
    stride = -(-len(cycles) // LONG_HISTORY)
    return cycles[::-stride][::-1]


def _history_row(row):
    return [number(value, 4) for value in row.values()]


def versions_section(versions):
    """What computed the run."""
    rows = [(name, Cell(text, "code")) for name, text in versions.items()]
    return Section(
        "versions", "Versions", (table("Software that computed this run", ("name", "version"), rows),)
    )


LISTED = {"nodes", "contradictions", "grids"}
"""Lists of nodes and of grids in a result, which have tables of their own."""


def record_section(result):
    """All of result.json, folded, a row for each number."""
    rows = [(Cell(name, "code"), text) for name, text in _leaves(plain_result(result))]
    whole = table("All fields of result.json", ("field", "value"), rows, folded=True)
    return Section("record", "The whole record", (whole,))


def _leaves(tree, path=""):
    """Pairs of a dotted name and a text for everything that nested dictionaries hold."""
    for name, value in tree.items():
        if isinstance(value, dict):
            yield from _leaves(value, f"{path}{name}.")
        else:
            yield path + name, _field(name, value)


def _field(name, value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if name in LISTED and isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    if name in ("x_nodes", "y_nodes"):
        return span(value)
    return number(value, 10)


def span(ends):
    """First and last node of a stretch."""
    return f"{ends[0]} to {ends[1]}" if ends else "none"
