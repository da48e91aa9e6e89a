import pytest

from mgehl.config import KEYS, SECTIONS, config_from_tables
from mgehl.kinds import KINDS, contact_from, kind_choice, mesh_from

every_kind = pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)


def config_of(kind):
    return config_from_tables({"contact": {"kind": kind.name}, "grid": {"nodes": 65}})


@every_kind
def test_what_a_kind_takes_exists(kind):
    assert set(kind.takes) <= {*KEYS, *SECTIONS}
    assert {*kind.essential, *kind.short} <= set(KEYS)


def test_every_key_is_of_use_to_some_kind():
    choices = [kind_choice(kind) for kind in KINDS.values()]
    assert [key for key in KEYS if all(choice.means_nothing(key) for choice in choices)] == []


@every_kind
def test_it_is_found_by_its_name_and_builds_its_model(kind):
    config = config_of(kind)
    contact = contact_from(config)
    assert config.kind is kind
    assert type(contact) is kind.model and contact.is_loaded == kind.is_loaded
    assert mesh_from(config, contact).nx == 65


@every_kind
def test_the_essentials_are_a_contact_of_that_kind(kind):
    tables = {}
    for name, value in kind.essential.items():
        section, _, key = name.partition(".")
        tables.setdefault(section, {})[key] = value
    assert config_from_tables(tables).kind is kind
