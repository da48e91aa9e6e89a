"""Defaults of PETSc options that a user's own options overrule."""

from contextlib import contextmanager

from petsc4py import PETSc


@contextmanager
def by_default(prefix, **named):
    """In this block PETSc reads these options, except those that the user has given."""
    options = PETSc.Options(prefix)
    ours = {name: value for name, value in named.items() if not options.hasName(name)}
    for name, value in ours.items():
        options[name] = value
    try:
        yield
    finally:
        for name in ours:
            options.delValue(name)
