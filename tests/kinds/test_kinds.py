import pytest

from mgehl.config import KEYS, SECTIONS
from mgehl.kinds import KINDS, kind_choice

every_kind = pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)


@every_kind
def test_what_a_kind_takes_exists(kind):
    assert set(kind.takes) <= {*KEYS, *SECTIONS}
    assert {*kind.essential, *kind.short} <= set(KEYS)


def test_every_key_is_of_use_to_some_kind():
    choices = [kind_choice(kind) for kind in KINDS.values()]
    assert [key for key in KEYS if all(choice.means_nothing(key) for choice in choices)] == []
