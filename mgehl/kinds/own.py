"""A user's own functions and files: the key is named where something is wrong with one of them."""

from contextlib import contextmanager

from mgehl.errors import ConfigError
from mgehl.model.own_function import OwnFunctionError
from mgehl.model.text_table import FileError


@contextmanager
def naming(said):
    """Turn what is wrong with a user's file or function into a ConfigError. It begins as `said`, a key and
    its value, which name a file already."""
    try:
        yield
    except OwnFunctionError as error:
        raise ConfigError(f"{said.partition(' ')[0]} = {error}") from None
    except FileError as error:
        raise ConfigError(f"{said}: {error.what if repr(error.path) in said else error}") from None


@contextmanager
def naming_keys(contact):
    """Turn what goes wrong in an own function of a contact into a ConfigError that names its key."""
    try:
        yield
    except OwnFunctionError as error:
        for key, place in _PLACES.items():
            if getattr(place(contact), "function", None) is error.function:
                raise ConfigError(f"{key} = {error}") from None
        raise


_PLACES = {
    "lubricant.viscosity_law": lambda contact: contact.lubricant.viscosity_law,
    "lubricant.density_law": lambda contact: contact.lubricant.density_law,
    "friction.model": lambda contact: contact.friction.rheology,
    "contact.surface": lambda contact: contact.surface,
    "contact.deformation": lambda contact: contact.deformation,
}
"""Where a contact keeps what a key describes."""
