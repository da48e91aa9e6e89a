"""What tells runs apart that are shown together: the keys in which their configurations differ."""

from dataclasses import fields
from pathlib import Path

from mgehl.config import SECTIONS
from mgehl.errors import UserError
from mgehl.kinds import KINDS
from mgehl.kinds.loaded import speed_words
from mgehl.output.laws import portable
from mgehl.output.pictures.titles import verdict

MOST_KEYS = 3
"""Keys that a label may name; runs that differ in more are called by their directories."""

DOMAIN = ("grid.x", "grid.y")

_SHORT = {
    "grid.nodes": lambda nodes: f"{nodes} nodes",
    "motion.speed": speed_words,
    "discretization.face_mobility": lambda mean: f"{mean} mean",
    "discretization.couette": lambda scheme: f"scheme {scheme}",
    "solver.start": lambda start: f"from {start}",
    "solver.method": str,
} | {key: words for kind in KINDS.values() for key, words in kind.short.items()}
"""Keys whose values speak for themselves."""


def run_names(directories):
    """The last part of each run directory's path, or as many as tell them apart.

    Raises UserError where a directory is given twice.
    """
    parts = [Path(directory).resolve().parts for directory in directories]
    for each, directory in zip(parts, directories, strict=True):
        if parts.count(each) > 1:
            raise UserError(f"{directory}: is given twice")
    depth = 1
    while len({each[-depth:] for each in parts}) < len(parts):
        depth += 1
    return ["/".join(each[-depth:]) for each in parts]


def labels(solutions, names):
    """A label for each run: what differs of its configuration, or its name where that says too much.

    A run that did not converge says so.
    """
    results = [solution.result for solution in solutions]
    return [_judged(each, result) for each, result in zip(_said(solutions, names), results, strict=True)]


def _judged(text, result):
    return text if result.converged else f"{text} ({verdict(result)})"


def _said(solutions, names):
    tables = [_flat(solution.config) for solution in solutions]
    keys = [key for key in dict.fromkeys(key for table in tables for key in table) if _differs(tables, key)]
    # A domain that follows from the other keys says nothing more.
    keys = [key for key in keys if key not in DOMAIN] or keys
    said = [", ".join(_say(key, table[key]) for key in keys if key in table) for table in tables]
    if not keys or len(keys) > MOST_KEYS or len(set(said)) < len(said):
        return list(names)
    return said


def _flat(config):
    return {
        f"{section}.{key}": value
        for section, table in portable(config).items()
        for key, value in table.items()
    }


def _differs(tables, key):
    return any(table.get(key) != tables[0].get(key) for table in tables)


def _say(key, value):
    """A key and its value, in a few words with the unit."""
    if key in _SHORT:
        return _SHORT[key](value)
    text = f"{value:.6g}" if isinstance(value, float) else str(value).lower()
    return f"{key} {text} {_unit(key)}".rstrip()


def _unit(key):
    section, _, name = key.partition(".")
    return next(each.metadata["unit"] for each in fields(SECTIONS[section]) if each.name == name) or ""
