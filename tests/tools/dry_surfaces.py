"""Surfaces and numbers of dry contacts for tests: those of study dry, which a public code has solved."""

from dataclasses import dataclass

from mgehl.model.surface import Surface
from mgehl.studies import dry_surfaces
from mgehl.studies.dry import REFERENCE, SURFACES

CONVOLUTIONS = {
    ("smooth", 129): 18, ("smooth", 257): 19, ("wavy 50 nm", 129): 20, ("wavy 50 nm", 257): 24,
    ("wavy 200 nm", 129): 23, ("wavy 200 nm", 257): 25, ("wavy 1 um", 129): 33, ("wavy 1 um", 257): 43,
    ("ridge 200 nm", 129): 24, ("ridge 200 nm", 257): 28, ("rough 50 nm", 129): 24,
    ("rough 50 nm", 257): 30, ("rough 200 nm", 129): 34, ("rough 200 nm", 257): 39,
    ("rough 500 nm", 129): 42, ("rough 500 nm", 257): 50,
}  # fmt: skip
"""At the most: what they took when this was written."""


@dataclass(frozen=True)
class Case:
    """What the public code finds of a surface on so many nodes; GPa and um."""

    surface: str
    nodes: int
    contact_nodes: int
    max_pressure: float
    approach: float
    convolutions: float

    def __str__(self):
        return f"{self.surface.replace(' ', '-')}-{self.nodes}"


CASES = [
    Case(*key, known.contact_nodes, known.max_pressure, known.approach, CONVOLUTIONS[key])
    for key, known in REFERENCE.items()
]


@dataclass(frozen=True)
class Known(Surface):
    """A function of `studies.dry_surfaces`, as a contact takes it."""

    name: str

    def height(self, x, y):
        return getattr(dry_surfaces, self.name)(x, y)


def surface(name):
    """By what study dry calls it; None of the smooth one."""
    return Known(SURFACES[name]) if SURFACES[name] else None
