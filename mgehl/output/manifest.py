"""manifest.json: which files make a result together, and by what each of them is known.

It is written last. A directory whose files are not those of its manifest is not read: one of them is of
another run, was edited, or is damaged.

    format, mgehl   the version of this layout, and of the program
    kind            "run" or "study"
    identity        of the run, a number that no other has
    files           name in the directory: SHA-256 of the file
    origins         of a law in laws/: where its file was, counted from the directory
    replaces        files of the result that was there before, while they are being replaced
    seal            SHA-256 of all that
"""

import hashlib
import json
import re
import uuid
from dataclasses import asdict, dataclass, field
from pathlib import Path

from mgehl.errors import OutputError, one_line
from mgehl.output.whole_file import is_plain, write_whole
from mgehl.version import VERSION

NAME = "manifest.json"
FORMAT = 1
LARGEST = 10**7
"""Bytes; no manifest is as large."""

_NAME = re.compile(r"(laws/)?[^/\0]+")
_HASH = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True)
class Manifest:
    """What manifest.json holds."""

    kind: str
    identity: str
    files: dict
    origins: dict = field(default_factory=dict)
    replaces: dict = field(default_factory=dict)
    format: int = FORMAT
    mgehl: str = VERSION

    def write(self, directory):
        """Put it into a directory. Raises OutputError."""
        plain = asdict(self)
        write_whole(Path(directory) / NAME, json.dumps(plain | {"seal": _seal(plain)}, indent=2) + "\n")

    def wrong(self, directory, optional=()):
        """Names of files that are not as they were written, in order; `optional` ones may be missing."""
        for name, known in sorted(self.files.items()):
            path = Path(directory) / name
            if not (name in optional and not path.exists()) and checksum(path) != known:
                yield name


def new_identity():
    """A number that no other run has."""
    return uuid.uuid4().hex


def checksum(path):
    """SHA-256 of a plain file; None where there is none that can be read."""
    if not is_plain(path):
        return None
    try:
        with Path(path).open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return None


def checksums(directory, names):
    """{name: checksum} of files of a directory. Raises OSError."""
    return {name: hashlib.sha256((Path(directory) / name).read_bytes()).hexdigest() for name in names}


def read_manifest(directory):
    """The `Manifest` of a directory; None where there is none.

    Raises OutputError where it is damaged, was edited, or is of another version.
    """
    path = Path(directory) / NAME
    if not path.is_symlink() and not path.exists():
        return None
    try:
        plain = json.loads(_text(path))
        seal = plain.pop("seal")
        if seal != _seal(plain):
            raise ValueError("it was edited")
        if plain["format"] != FORMAT:
            raise OutputError(
                f"{path}: was written by mgehl {plain['mgehl']}, and {VERSION} cannot read it"
            )
        return _checked(Manifest(**plain))
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise OutputError(f"{path}: is damaged: {one_line(error)}") from None


def _text(path):
    if not is_plain(path):
        raise ValueError("it is no plain file")
    with path.open("rb") as file:
        return file.read(LARGEST).decode()


def _checked(manifest):
    """It names files of its own directory alone."""
    for name, known in [*manifest.files.items(), *manifest.replaces.items()]:
        if not _NAME.fullmatch(name) or {".", ".."} & set(name.split("/")) or not _HASH.fullmatch(known):
            raise ValueError(f"it names {name!r}")
    if not re.fullmatch(r"[0-9a-f]{32}", manifest.identity):
        raise ValueError("it has no identity")
    return manifest


def _seal(plain):
    return hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()
