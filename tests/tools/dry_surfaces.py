"""Surfaces of dry contacts for tests: those of study dry, which a public code has solved."""

from mgehl.model.own_function import OwnFunction
from mgehl.model.own_laws import OwnSurface
from mgehl.studies import dry_surfaces
from mgehl.studies.dry import SURFACES


def surface(name):
    """By what study dry calls it; None of the smooth one."""
    function = SURFACES[name]
    return OwnSurface(OwnFunction(f"{dry_surfaces.__file__}:{function}")) if function else None
