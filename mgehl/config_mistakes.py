"""What is wrong with a configuration as a whole, in a line that names the key."""

import difflib
from contextlib import contextmanager
from dataclasses import asdict

from mgehl.config_value import shown
from mgehl.errors import ConfigError
from mgehl.kinds import choices
from mgehl.kinds.derived import words_of


@contextmanager
def naming_words(tables, number):
    """Let what is wrong with a number begin with the words that it follows from."""
    try:
        yield
    except ConfigError as error:
        raise ConfigError(f"{', '.join(words_of(tables, number))}: {error}") from None


def check_together(config, tables):
    """Rules that concern more than one key."""
    nodes = config.grid.nodes
    if (nodes - 1) & (nodes - 2):
        lower = 2 ** ((nodes - 1).bit_length() - 1) + 1
        raise ConfigError(f"grid.nodes = {nodes}: must be 2^k + 1, such as {lower} or {2 * lower - 1}")
    for choice in choices(asdict(config)):
        _check_choice(choice, config, tables)


def _check_choice(choice, config, tables):
    """Keys that are given must mean something beside a choice; those that it needs must be given."""
    for section, table in tables.items():
        for key, value in table.items():
            if f"{section}.{key}" in choice.gives:
                raise ConfigError(
                    f"{section}.{key} = {shown(value)}: follows already {choice.said}: give one of them"
                )
            if choice.means_nothing(f"{section}.{key}"):
                raise ConfigError(f"{section}.{key} = {shown(value)}: means nothing {choice.said}")
    for key in choice.needs:
        if config.value(key) is None:
            raise ConfigError(f"{key}: must be given {choice.said}")


def check_section(name, table):
    """A section has keys."""
    if not isinstance(table, dict):
        raise ConfigError(f"{name} = {shown(table)}: is a section, its keys go under [{name}]")


def closest(name, known):
    """The nearest of some names, at the end of a message."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    return f"; did you mean {close[0]}?" if close else f"; known are {', '.join(known)}"


def closest_key(key, keys):
    """The nearest of some keys, of this section if one is near, else of any."""
    close = difflib.get_close_matches(key, keys, n=1, cutoff=0.6)
    near = [each for each in keys if each.endswith(f".{key.rpartition('.')[2]}")] or close
    return f"; did you mean {near[0]}?" if near else ""
