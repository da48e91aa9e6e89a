"""Keys that follow from others: what engineers give, in place of the numbers that are solved.

One key for each number: what follows from words cannot be given beside them. `Config` has the numbers as if
they had been given, so that nobody else knows the words.
"""

from dataclasses import dataclass
from itertools import combinations

from mgehl.kinds.choice import Choice, value_of


@dataclass(frozen=True)
class Derived:
    """A key that follows from others."""

    key: str
    value: float
    how: str
    """In a few words."""


def _of_both(*names):
    return tuple(f"{body}.{name}" for body in ("body_1", "body_2") for name in names)


FOLLOWS = (
    (("contact.reduced_modulus",), _of_both("material", "modulus", "poisson")),
    (
        ("contact.radius_x", "contact.radius_y"),
        _of_both("diameter", "radius_x", "radius_y", "conformity"),
    ),
    (
        ("motion.speed", "motion.slide_to_roll"),
        (*_of_both("speed", "rotation", "rotation_radius"), "motion.ring_rotation"),
    ),
    (
        ("lubricant.viscosity",),
        (
            "lubricant.oil", "lubricant.kinematic_viscosity", "lubricant.kinematic_viscosity_40",
            "lubricant.kinematic_viscosity_100",
        ),
    ),
    (("lubricant.pressure_viscosity",), ("lubricant.oil",)),
)  # fmt: skip
"""(Keys, the words that they follow from)."""

EITHER = (
    *(
        (f"{body}.{one}", f"{body}.{other}")
        for body in ("body_1", "body_2")
        for one, other in (
            ("material", "modulus"), ("material", "poisson"), ("diameter", "radius_x"),
            ("radius_y", "conformity"), ("roughness", "Ra"), ("speed", "rotation"),
        )
    ),
    *(("motion.ring_rotation", word) for word in _of_both("speed", "rotation")),
    *combinations(
        ("lubricant.oil", "lubricant.kinematic_viscosity", "lubricant.kinematic_viscosity_40"), 2
    ),
)  # fmt: skip
"""Pairs of which one alone may be given."""

NEEDS = {
    **{f"{body}.modulus": (f"{body}.poisson",) for body in ("body_1", "body_2")},
    **{f"{body}.poisson": (f"{body}.modulus",) for body in ("body_1", "body_2")},
    **{f"{body}.rotation_radius": (f"{body}.rotation",) for body in ("body_1", "body_2")},
    "lubricant.oil": ("lubricant.temperature",),
    "lubricant.kinematic_viscosity": ("lubricant.density",),
    "lubricant.kinematic_viscosity_40": (
        "lubricant.kinematic_viscosity_100", "lubricant.temperature", "lubricant.density",
    ),
    "lubricant.kinematic_viscosity_100": ("lubricant.kinematic_viscosity_40",),
}  # fmt: skip
"""{word: what must be given with it}."""

HEIGHTS = "contact.surface", "surface.kind", "surface.file", "second_surface.kind", "second_surface.file"
"""Heights that are solved: lambda is by them, and not by a number."""


def word_choices(tables):
    """Every `Choice` that the words in nested values make."""

    def given(words):
        return [word for word in words if value_of(tables, word) is not None]

    for one, other in EITHER:
        for word, beside in ((one, other), (other, one)):
            if given((word,)):
                yield Choice(f"with {word}", (beside,))
    for targets, words in FOLLOWS:
        if found := given(words):
            yield Choice(f"with {found[0]}", (), gives=targets)
    if given(("lubricant.oil",)):
        yield Choice("with lubricant.oil", ("lubricant.viscosity_law",))
    for word in given(NEEDS):
        yield Choice(f"with {word}", (), needs=NEEDS[word])
    if found := given(HEIGHTS):
        yield Choice(f"with {found[0]}", _of_both("roughness", "Ra"))


def overridden(tables):
    """A `Choice` for each number in nested values of settings: the words that it stands for are gone."""
    for targets, words in FOLLOWS:
        for target in targets:
            if value_of(tables, target) is not None:
                yield Choice(f"with {target}", words)
