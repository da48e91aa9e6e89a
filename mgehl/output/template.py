"""A commented configuration of a kind of contact: every key with its meaning, unit, range and default."""

import textwrap
from itertools import groupby

import tomli_w

from mgehl.config import KEYS
from mgehl.config_value import describe_rules
from mgehl.errors import printable
from mgehl.kinds import KINDS, kind_choice

WIDTH = 100

HEAD = """\
# {title}

# Change what differs in your case, then: mpiexec -n 2 python -m mgehl run {file}
# (before a long run: mgehl check {file}). Numbers are SI; a string may carry a unit, such as "7.5 mm/s".
# A key that is a comment has the value that stands there; without one it is not set.
"""


def template(kind, file):
    """The text of a new configuration of this kind, to be saved as `file`."""
    kind = KINDS[kind]
    parts, choice = [HEAD.format(title=kind.about, file=printable(str(file)))], kind_choice(kind)
    taken = [key for key in KEYS if not choice.means_nothing(key)]
    for section, keys in groupby(taken, lambda key: key.partition(".")[0]):
        entries = (_entry(KEYS[key], kind.essential.get(key)) for key in keys)
        parts.append("\n\n".join([f"[{section}]", *entries]) + "\n")
    return "\n".join(parts)


def _entry(key, essential):
    """A key with what it means and takes, live with the value of one that is essential."""
    about = textwrap.wrap(f"{key.metadata['help']} ({describe_rules(key.metadata)})", WIDTH - 2)
    line = _line(key.name, key.default if essential is None else essential)
    return "\n".join([f"# {text}" for text in about] + [line if essential is not None else f"# {line}"])


def _line(name, value):
    """TOML of one key; of one that is not set its name alone."""
    if value is None:
        return f"{name} ="
    if isinstance(value, tuple | list):
        return f"{name} = [{', '.join(map(str, value))}]"
    return tomli_w.dumps({name: value}).strip()
