"""What a user can mend: one line on standard error, exit status 2."""


def one_line(error: object, width: int = 120) -> str:
    """What an exception says, cut to one line."""
    return printable(" ".join(str(error).split()))[:width]


def printable(text: str) -> str:
    """A text as a terminal may have it: control characters, of whatever file, stand as escapes."""
    return "".join(each if each.isprintable() else _escaped(each) for each in text)


def _escaped(character: str) -> str:
    return " " if character == "\t" else character.encode("unicode_escape").decode()


class UserError(Exception):
    """A mistake in the input or in the surroundings; the message is one line for the user. Names that users
    give may hold line breaks: these become spaces; other control characters, escapes."""

    def __init__(self, message: object) -> None:
        super().__init__(printable(" ".join(str(message).splitlines())))


class ConfigError(UserError, ValueError):
    """A configuration that cannot be used."""


class OptionError(UserError):
    """A PETSc option that this solver cannot follow."""


class Stopped(Exception):
    """A run that was told to end before its time; what it had reached is on disk. `status` is the exit
    status: 128 and the signal's number, as a shell has it."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message, status)  # both, so that it can be sent from rank to rank
        self.status = status

    def __str__(self) -> str:
        return self.args[0]


class OutputError(UserError):
    """A file or a directory that cannot be read or written."""


class NoRunError(OutputError):
    """A directory that is no finished run."""
