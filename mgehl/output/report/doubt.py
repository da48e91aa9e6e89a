"""Numbers of a state that did not converge are marked as such everywhere on a page."""

from dataclasses import replace

INPUT = ("checks", "groups", "scales")
"""Anchors of sections that have their own judgements, or mostly what the run was given."""

GIVEN = ("lambda", "cells in the inlet")
"""Numbers on top of a page that follow from what was given, whether a run converges or not."""


def mark_of(result):
    """The mark on the numbers of a `Result` or its like; empty where it converged."""
    if result.converged:
        return ""
    return "in doubt" if result.settled else "not converged"


def marked(words, mark):
    """Words with the mark, if there is one."""
    return f"{words} ({mark})" if mark else words


def marked_numbers(numbers, mark):
    """Pairs of a name and a number, on top of a page, named with the mark."""
    return tuple((name if name in GIVEN else marked(name, mark), number) for name, number in numbers)


def marked_sections(sections, mark):
    """Sections of an answer, their tables named with the mark."""
    return tuple(each if each.anchor in INPUT else _marked(each, mark) for each in sections)


def _marked(section, mark):
    blocks = [
        replace(block, caption=marked(block.caption, mark)) if block.block == "table" else block
        for block in section.blocks
    ]
    return replace(section, blocks=tuple(blocks))
