"""What errors say in one line, and what tables hold."""

import csv

import pytest

from mgehl.errors import UserError


def refusal(call, *arguments, error=UserError, **named):
    """The message of the error that a call raises."""
    with pytest.raises(error) as caught:
        call(*arguments, **named)
    message = str(caught.value)
    assert message and "\n" not in message
    return message


def status_of(*words):
    """The exit status of a command line that this process executes."""
    from mgehl.cli import main

    try:
        return main(list(words))
    except SystemExit as stop:
        return stop.code or 0


def counting(function, steps):
    """A function that ends the process, as it were, after so many calls of some."""

    def call(*arguments, **named):
        if next(steps, None) is None:
            raise KeyboardInterrupt
        return function(*arguments, **named)

    return call


def rows_of(path):
    """The rows of a CSV file by the names of its columns."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))
