"""What a user can mend: one line on standard error, exit status 2."""


class UserError(Exception):
    """A mistake in the input or in the surroundings; the message is one line for the user.

    Names that users give may hold line breaks: these become spaces.
    """

    def __init__(self, message):
        super().__init__(" ".join(str(message).splitlines()))


class ConfigError(UserError, ValueError):
    """A configuration that cannot be used."""


class OptionError(UserError):
    """A PETSc option that this solver cannot follow."""


class OutputError(UserError):
    """A file or a directory that cannot be read or written."""
