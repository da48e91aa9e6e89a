"""Surfaces of dry contacts for tests: those of study dry, which a public code has solved."""

from dataclasses import dataclass

from mgehl.model.surface import Surface
from mgehl.studies import dry_surfaces
from mgehl.studies.dry import SURFACES


@dataclass(frozen=True)
class Known(Surface):
    """A function of `studies.dry_surfaces`, as a contact takes it."""

    name: str

    def height(self, x, y):
        return getattr(dry_surfaces, self.name)(x, y)


def surface(name):
    """By what study dry calls it; None of the smooth one."""
    return Known(SURFACES[name]) if SURFACES[name] else None
