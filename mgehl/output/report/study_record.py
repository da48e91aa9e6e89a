"""study.json: which study wrote a directory, on which grids, with which software."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import dacite

from mgehl.errors import OutputError
from mgehl.output.whole_file import write_whole

NAME = "study.json"


@dataclass(frozen=True)
class StudyRecord:
    """What was asked for, and what computes it."""

    name: str
    nodes: tuple
    """Grids that were asked for; empty for the study's own."""
    branch: str
    mean: str
    ranks: int
    versions: dict
    boundary_film: float | None = None
    """In m, that study rough was asked for; None for its own, and of other studies."""
    cases: int | None = None
    """That study mixed was asked for, as `seed`; None as above."""
    seed: int | None = None


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
