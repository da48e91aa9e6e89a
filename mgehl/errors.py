"""What a user can mend: one line on standard error, exit status 2."""


class UserError(Exception):
    """A mistake in the input or in the surroundings; the message is one line for the user."""


class ConfigError(UserError, ValueError):
    """A configuration that cannot be used."""


class OptionError(UserError):
    """A PETSc option that this solver cannot follow."""


class OutputError(UserError):
    """A file or a directory that cannot be read or written."""
