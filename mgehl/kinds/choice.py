"""Which keys count: what a configuration chooses takes keys and needs some; the others are then a mistake.

A kind of contact, a kind of surface, a coating, Moes numbers and a contact without a fluid are all choices.
`mgehl.kinds.choices` has those of a configuration; everything that asks whether a key counts asks them.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Choice:
    """What one choice makes of keys. Keys are "section.key"; a section stands for all of its keys."""

    said: str
    """The choice at the end of a message, such as 'where contact.kind = "line"'."""
    about: tuple | None = ()
    """Keys that it decides about; None for all."""
    takes: tuple = ()
    """Those of them that count. Giving another one is a mistake."""
    needs: tuple = ()
    """Keys that must be given."""
    idle: tuple = ()
    """Keys that may be given, though they do nothing: they are kept for another choice."""
    gives: tuple = ()
    """Keys whose values follow from it. Giving one is a mistake; all the same it counts."""

    def means_nothing(self, key):
        """Whether it is a mistake to give a key beside this choice."""
        return key in self.gives or self.leaves_out(key)

    def leaves_out(self, key):
        """Whether a key does not count beside this choice."""
        return (self.about is None or named(key, self.about)) and not named(key, self.takes)


def named(key, names):
    """Whether a key, or its section, is among some names."""
    return key in names or key.partition(".")[0] in names


def value_of(tables, key):
    """The value of "section.key" in nested values, be they right or wrong; None without one."""
    section, _, name = key.partition(".")
    table = tables.get(section)
    return table.get(name) if isinstance(table, dict) else None


def given(tables, keys):
    """Those of some keys that nested values give."""
    return [key for key in keys if value_of(tables, key) is not None]


def word_of(tables, key):
    """As `value_of`, where the value is a word."""
    value = value_of(tables, key)
    return value if isinstance(value, str) else None


@dataclass(frozen=True)
class Derived:
    """A key that follows from others."""

    key: str
    value: float
    how: str
    """In a few words."""
