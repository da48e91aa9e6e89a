"""Keys that follow from others: what engineers give, in place of the numbers that are solved.

One key for each number: what follows from words cannot be given beside them. `Config` has the numbers as if
they had been given, so that nobody else knows the words.
"""

from itertools import combinations

from mgehl.config_value import shown
from mgehl.errors import ConfigError
from mgehl.kinds.bodies import BODIES, ELASTICITY, GEOMETRY, MOTION, SPEEDS, keys
from mgehl.kinds.choice import Choice, given, value_of

OILS = "lubricant.oil", "lubricant.kinematic_viscosity", "lubricant.kinematic_viscosity_40"
OIL_AT_100 = "lubricant.kinematic_viscosity_100"

FOLLOWS = (
    (("contact.reduced_modulus",), keys(ELASTICITY)),
    (("contact.radius_x", "contact.radius_y"), keys(GEOMETRY)),
    (("motion.speed", "motion.slide_to_roll"), MOTION),
    (("motion.speed",), ("motion.ring_rotation",)),
    (("lubricant.viscosity",), (*OILS, OIL_AT_100)),
    (("lubricant.pressure_viscosity",), ("lubricant.oil",)),
)
"""(Keys, the words that they follow from)."""

NUMBERS = {number for numbers, _ in FOLLOWS for number in numbers}

_EITHER = (
    ("material", "modulus"), ("material", "poisson"), ("diameter", "radius_x"), ("radius_y", "conformity"),
    ("roughness", "Ra"), ("speed", "rotation"),
)  # fmt: skip
EITHER = (
    *((f"{body}.{one}", f"{body}.{other}") for body in BODIES for one, other in _EITHER),
    *(("motion.ring_rotation", word) for word in keys(SPEEDS)),
    *combinations(OILS, 2),
)
"""Pairs of which one alone may be given."""

_NEEDS = {"modulus": "poisson", "poisson": "modulus", "rotation_radius": "rotation"}
NEEDS = {
    **{f"{body}.{word}": (f"{body}.{needed}",) for word, needed in _NEEDS.items() for body in BODIES},
    "lubricant.oil": ("lubricant.temperature",),
    "lubricant.kinematic_viscosity": ("lubricant.density",),
    "lubricant.kinematic_viscosity_40": (OIL_AT_100, "lubricant.temperature", "lubricant.density"),
    OIL_AT_100: ("lubricant.kinematic_viscosity_40",),
}
"""{word: what must be given with it}."""

USERS = {
    "lubricant.temperature": ("lubricant.oil", "lubricant.kinematic_viscosity_40"),
    "lubricant.density": ("lubricant.kinematic_viscosity", "lubricant.kinematic_viscosity_40"),
    OIL_AT_100: ("lubricant.kinematic_viscosity_40",),
    **{f"{body}.rotation_radius": (f"{body}.rotation",) for body in BODIES},
}
"""{word: those of which one must be given, or it means nothing}."""

HEIGHTS = "contact.surface", "surface.kind", "surface.file", "second_surface.kind", "second_surface.file"
"""Heights that are solved: lambda is by them, and not by a number."""


def word_choices(tables):
    """Every `Choice` that the words in nested values make."""
    for one, other in EITHER:
        for word, beside in ((one, other), (other, one)):
            if given(tables, [word]):
                yield Choice(f"with {word}", (beside,))
    for targets, words in FOLLOWS:
        if found := given(tables, words):
            yield Choice(f"with {found[0]}", gives=targets)
    if given(tables, ["lubricant.oil"]):
        yield Choice("with lubricant.oil", ("lubricant.viscosity_law",))
    for word in given(tables, NEEDS):
        yield Choice(f"with {word}", needs=NEEDS[word])
    for word in given(tables, USERS):
        if not given(tables, USERS[word]):
            yield Choice(f"without {' or '.join(USERS[word])}", (word,))
    if found := given(tables, HEIGHTS):
        yield Choice(f"with {found[0]}", keys(("roughness", "Ra")))


def overridden(tables):
    """A `Choice` for each number in nested values of settings: the words that it stands for are gone."""
    for targets, words in FOLLOWS:
        for target in given(tables, targets):
            yield Choice(f"with {target}", words)


def orphans(tables, settings):
    """Numbers that settings leave without words: other words of nested values gave them, too, and go. So of
    the speeds of two bodies the mean stays where motion.slide_to_roll is set."""
    gone = {
        word for targets, words in FOLLOWS if given(settings, targets) and not given(settings, words)
        for word in given(tables, words)
    }  # fmt: skip
    numbers = (target for targets, words in FOLLOWS if gone & {*words} for target in targets)
    return [number for number in dict.fromkeys(numbers) if not given(settings, [number])]


def check_arms(tables, laid, settings):
    """Raise ConfigError where a radius of settings pushes out the arm by which a rotation is a speed."""
    radii = given(settings, ("contact.radius_x", "contact.radius_y"))
    for rotation, body, instead in (
        *((f"{body}.rotation", body, f"{body}.rotation_radius") for body in BODIES),
        ("motion.ring_rotation", BODIES[0], "motion.speed"),
    ):
        arms = [f"{body}.{name}" for name in ("rotation_radius", "radius_x", "diameter")]
        if radii and given(tables, arms) and given(laid, [rotation]) and not given(laid, arms):
            radius, arm = f"{radii[0]} = {shown(value_of(settings, radii[0]))}", given(tables, arms)[0]
            why = f"takes the place of {arm}, by which {rotation} is a speed"
            raise ConfigError(f"{radius}: {why}: set {instead}, too")


def beside(key):
    """The other numbers that follow from the words that a key may follow from, and those words."""
    groups = [(numbers, words) for numbers, words in FOLLOWS if key in numbers]
    return [each for numbers, _ in groups for each in numbers if each != key], [
        word for _, words in groups for word in words
    ]


def words_of(tables, number):
    """The words in nested values that a number follows from."""
    return [word for numbers, words in FOLLOWS if number in numbers for word in given(tables, words)]


def left_over(tables, laid, settings):
    """Words of nested values that nothing uses any more when settings are laid over them."""
    return [
        word for word, users in USERS.items()
        if given(tables, users) and not given(laid, users) and not given(settings, [word])
    ]  # fmt: skip
