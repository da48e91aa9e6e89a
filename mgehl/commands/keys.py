"""mgehl keys: list every configuration key

List every configuration key with its meaning, choices, default and unit.

example: mgehl keys
"""

from dataclasses import fields

from mgehl.config import SECTIONS
from mgehl.saying import columns, folded

NAME = 33
"""Columns of a key's name and the space after it."""


def execute(_options):
    """Print the list; on a terminal its lines are broken at spaces."""
    width = columns()
    print(*(folded(line, " " * NAME, width) for line in describe_keys().splitlines()), sep="\n")


def describe_keys():
    """Every configuration key with its default, unit and meaning, a line each."""
    lines, told = [], {}
    for name, section in SECTIONS.items():
        if section in told:
            lines.append(f"{name + '.*':{NAME - 1}} the keys of {told[section]} once more")
            continue
        told[section] = name
        for key in fields(section):
            rules = key.metadata
            choices = f" ({', '.join(rules['words'])})" if rules["words"] else ""
            unit = f" {rules['unit']}" if rules["unit"] else ""
            default = f"unset{unit and ','}{unit}" if key.default is None else f"{key.default}{unit}"
            lines.append(f"{name + '.' + key.name:{NAME - 1}} {rules['help']}{choices} [{default}]")
    return "\n".join(lines)
