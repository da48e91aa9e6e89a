"""Errors of the user's making."""

import pickle

import pytest

from mgehl.errors import ConfigError, OptionError, OutputError, UserError

KINDS = (UserError, ConfigError, OptionError, OutputError)


@pytest.mark.parametrize("kind", KINDS)
def test_the_message_is_one_line(kind):
    assert str(kind("a\nb\r\nc\x85d\u2028e")) == "a b c d e"


@pytest.mark.parametrize("kind", KINDS)
def test_it_can_be_sent_to_other_ranks(kind):
    sent = pickle.loads(pickle.dumps(kind("why")))
    assert type(sent) is kind and str(sent) == "why"
