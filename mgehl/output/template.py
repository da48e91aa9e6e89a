"""A commented configuration of a kind of contact: every key with its meaning, unit, range and default."""

import textwrap
from dataclasses import fields

import tomli_w

from mgehl.config import FOREIGN, SECTIONS
from mgehl.config_value import describe_rules

ESSENTIAL = {
    "point": {
        "contact.kind": "point", "contact.load": "800 N",
        "contact.radius_x": "12.7 mm", "contact.radius_y": "12.7 mm",
        "contact.reduced_modulus": "219.78 GPa",
        "lubricant.viscosity": "0.096 Pa*s", "lubricant.pressure_viscosity": "18.2 1/GPa",
        "motion.speed": "0.5 m/s", "grid.nodes": 129, "solver.start": "film",
    },
    "line": {
        "contact.kind": "line", "contact.load_per_length": "1859 N/mm",
        "contact.radius_x": "12.7 mm", "contact.reduced_modulus": "219.78 GPa",
        "lubricant.viscosity": "0.096 Pa*s", "lubricant.pressure_viscosity": "18.2 1/GPa",
        "motion.speed": "100 mm/s", "grid.nodes": 1025, "grid.x": [-2.5, 1.6], "solver.start": "film",
    },
    "wedge": {
        "contact.kind": "wedge", "wedge.exit": "20 mm", "wedge.inlet": "50 mm", "wedge.width": "20 mm",
        "wedge.slope": 1e-3, "wedge.pillar": "square",
        "wedge.pillar_x": "35 mm", "wedge.pillar_y": "0 mm", "wedge.pillar_size": "8 mm",
        "lubricant.viscosity": "0.096 Pa*s", "motion.speed": "1 m/s", "grid.nodes": 129,
    },
}  # fmt: skip
"""What a case of each kind is made of, with values that converge in seconds. Other keys stay comments."""

WIDTH = 100

HEAD = """\
# {title}

# Change what differs in your case, then: mpiexec -n 2 python -m mgehl run {file}
# (before a long run: mgehl check {file}). Numbers are SI; a string may carry a unit, such as "7.5 mm/s".
# A key that is a comment has the value that stands there; without one it is not set.
"""

TITLES = {
    "point": "A lubricated point contact: a ball or an ellipsoid on a flat.",
    "line": "A lubricated line contact: a cylinder on a flat, per length.",
    "wedge": "A rigid wedge bearing, with a pillar or a blocked exit in its film.",
}


def template(kind, file):
    """The text of a new configuration of this kind, to be saved as `file`."""
    parts = [HEAD.format(title=TITLES[kind], file=file)]
    for name, section in SECTIONS.items():
        keys = [key for key in fields(section) if not {name, f"{name}.{key.name}"} & set(FOREIGN[kind])]
        if keys:
            parts.append("\n\n".join([f"[{name}]", *(_entry(kind, name, key) for key in keys)]) + "\n")
    return "\n".join(parts)


def _entry(kind, section, key):
    """A key with what it means and takes, live if it is essential."""
    about = textwrap.wrap(f"{key.metadata['help']} ({describe_rules(key.metadata)})", WIDTH - 2)
    essential = ESSENTIAL[kind].get(f"{section}.{key.name}")
    line = _line(key.name, key.default if essential is None else essential)
    return "\n".join([f"# {text}" for text in about] + [line if essential is not None else f"# {line}"])


def _line(name, value):
    """TOML of one key; of one that is not set its name alone."""
    if value is None:
        return f"{name} ="
    if isinstance(value, tuple | list):
        return f"{name} = [{', '.join(map(str, value))}]"
    return tomli_w.dumps({name: value}).strip()
