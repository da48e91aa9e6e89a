"""The kinds of contact. Each module says which keys it takes, what it builds of them, what it is called. A
key that only some kinds take means nothing to the others without a word of theirs."""

from dataclasses import dataclass
from itertools import chain
from typing import Any

from mgehl.kinds.bodies import derived_from_bodies
from mgehl.kinds.choice import Choice, word_of
from mgehl.kinds.derived import word_choices
from mgehl.kinds.dry import fluid_choices
from mgehl.kinds.friction import friction_choices
from mgehl.kinds.heat import heat_choices
from mgehl.kinds.line import LINE
from mgehl.kinds.lubricant import derived_from_oil, law_choices
from mgehl.kinds.own import naming_keys
from mgehl.kinds.point import POINT, point_choices
from mgehl.kinds.surface import check_ways
from mgehl.kinds.surface_kinds import surface_choices
from mgehl.kinds.time import scene_of, time_choices
from mgehl.kinds.wedge import WEDGE, wedge_choices

KINDS = {kind.name: kind for kind in (POINT, LINE, WEDGE)}


def choices(tables):
    """Every `Choice` that nested values, a whole configuration's or settings, make, in mistakes' order."""
    kind = KINDS.get(word_of(tables, "contact.kind"))
    makers = (
        point_choices, surface_choices, time_choices, friction_choices, fluid_choices, wedge_choices,
        word_choices, heat_choices, law_choices,
    )  # fmt: skip
    return [*([kind_choice(kind)] if kind else []), *chain(*(maker(tables) for maker in makers))]


def kind_choice(kind):
    """The `Choice` of a `Kind`."""
    return Choice(f'where contact.kind = "{kind.name}"', None, ("contact.kind", *kind.takes))


def derived(config):
    """What follows from the words of a `Config`, a `Derived` each; there may not yet be such a key. Raises
    ConfigError where the words do not fit."""
    return (*derived_from_bodies(config), *derived_from_oil(config))


@dataclass(frozen=True)
class Case:
    """What is solved, as the user has it: made once, at the door, and handed on."""

    config: Any
    """The `Config`, its domain in numbers."""
    contact: Any
    mesh: Any
    """The finest."""

    @property
    def scene(self):
        """The `Scene` of a run in time."""
        return scene_of(self.config, self.contact)

    def check_ways(self, begin):
        """Raise ConfigError unless surfaces cover the contact in time, the mean one after a path in m."""
        check_ways(self.config, self.contact, begin)


def case_of(config, contact=None):
    """The `Case` of a `Config`, as it is."""
    contact = contact or contact_from(config)
    config = with_domain(config, contact)
    return Case(config, contact, mesh_from(config, contact))


def checked_case(config):
    """The `Case` of a `Config`. Raises ConfigError where values do not fit each other."""
    contact = contact_from(config)
    check_contact(config, contact)
    return case_of(config, contact)


def contact_from(config):
    """The contact that a `Config` describes."""
    return config.kind.contact(config)


def mesh_from(config, contact):
    """The finest mesh."""
    return config.kind.mesh(config, contact)


def with_domain(config, contact):
    """The `Config` with numbers in the place of "auto"."""
    return config.kind.with_domain(config, contact)


def check_contact(config, contact):
    """Raise ConfigError where values do not fit each other, though each is allowed."""
    with naming_keys(contact):
        config.kind.check(config, contact)
