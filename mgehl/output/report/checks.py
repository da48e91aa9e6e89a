"""Rows of the table of checks: what was found, what is allowed, and the judgement."""

from mgehl.output.report.page import BAD, DOUBTFUL, GOOD, Cell, number

HOLDS, CARE, BROKEN = Cell("holds", GOOD), Cell("to be read with care", DOUBTFUL), Cell("broken", BAD)
UNDECIDED = Cell("not decided on this grid", DOUBTFUL)

CHECKS, CHECK_HEADS = "What was checked on the final state", ("check", "found", "allowed", "verdict")


def limited(name, value, limit):
    """The row of a check that |value| <= limit; what is not finite breaks it."""
    holds = value is not None and abs(value) <= limit
    return name, number(value, 2), f"{limit:g}", HOLDS if holds else BROKEN


def absent(name, amount, found=None, otherwise=BROKEN, holds=HOLDS):
    """The row of a check that there is none of something; `found` is said instead of the amount."""
    return name, found or str(amount), "0", holds if amount == 0 else otherwise


def informing(name, value):
    """A row beside checks that judges nothing."""
    return name, number(value, 2), "", Cell("for information", "muted")
