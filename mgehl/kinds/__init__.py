"""The kinds of contact. Each module says which keys it takes, what it builds of them, what it is called.

A new kind is its physics in `mgehl.model`, a module here with its own section of keys, its name in
`KINDS` and its section in `mgehl.config.Config`. A key that only some kinds take is foreign to the
others without a word of theirs.
"""

from mgehl.kinds.line import LINE
from mgehl.kinds.own import naming_keys
from mgehl.kinds.point import POINT
from mgehl.kinds.wedge import WEDGE

KINDS = {kind.name: kind for kind in (POINT, LINE, WEDGE)}


def contact_from(config):
    """The contact that a `Config` describes."""
    return config.kind.contact(config)


def mesh_from(config, contact):
    """The finest mesh."""
    return config.kind.mesh(config, contact)


def settled(config, contact):
    """The `Config` with numbers in the place of "auto"."""
    return config.kind.settled(config, contact)


def check_contact(config, contact):
    """Raise ConfigError where values do not fit each other, though each is allowed."""
    with naming_keys(contact):
        config.kind.check(config, contact)
