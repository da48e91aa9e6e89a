"""study.json: which study wrote a directory, what it was asked for, with which software."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import dacite

from mgehl.errors import OutputError
from mgehl.output.whole_file import write_whole

NAME = "study.json"


@dataclass(frozen=True)
class StudyRecord:
    """What was asked for, and what computes it; what is empty or None is the study's own."""

    name: str
    nodes: tuple
    ranks: int
    versions: dict
    branch: str = "both"
    """Of study transition."""
    settings: tuple = ()
    """Of --set, "section.key=value", for every case."""
    cases: int | None = None
    """How many are drawn by chance, as `seed`."""
    seed: int | None = None
    files: tuple = ()
    """Tables and pictures that it wrote; none until it has finished."""


def write_record(directory, record):
    """Write study.json. Raises OutputError where it cannot be written."""
    write_whole(Path(directory) / NAME, json.dumps(asdict(record), indent=2) + "\n")


def read_record(directory):
    """The `StudyRecord` of a directory; None without one, as of studies of an earlier version.

    Raises OutputError where it is damaged.
    """
    path = Path(directory) / NAME
    try:
        return dacite.from_dict(StudyRecord, json.loads(path.read_text()), dacite.Config(cast=[tuple]))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError, dacite.DaciteError) as error:
        raise OutputError(f"{path}: cannot be read: {' '.join(str(error).split())[:120]}") from None
