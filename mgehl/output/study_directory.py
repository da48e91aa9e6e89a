"""A study's directory: study.json says what was asked for. New tables are put together in a folder, and
replace the old ones at the end. Its cases are run directories, in runs/ or in runs/ of folders in it.
"""

import json
import os
import re
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import dacite

from mgehl.errors import OutputError, UserError
from mgehl.output.directory import clear_checkpoint
from mgehl.output.files import FIELDS
from mgehl.output.files import STUDY as NAME
from mgehl.output.laws import FOLDER as LAWS
from mgehl.output.stored import files_of
from mgehl.output.whole_file import clear_parts, is_folder, is_plain, remove_plain, write_whole, writing

UNFINISHED = "unfinished"
"""Folder of tables and pictures until all are there."""

RUNS = "runs"
"""Folder of run directories."""

_RUN = re.compile(r"\d{3,}|.*-[0-9a-f]{16}")
"""Names of run directories that sweeps and studies make."""

ENDINGS = {".csv", ".md", ".nc", ".png"}


@dataclass(frozen=True)
class StudyRecord:
    """What was asked for, and what computes it; what is empty or None is the study's own."""

    name: str
    nodes: tuple
    """Along each side, coarsest first."""
    ranks: int
    versions: dict
    branch: str = "both"
    """Of study transition: "down", "up" or "both"."""
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
    """The `StudyRecord` of a directory; None without one. Raises OutputError where it is damaged."""
    path = Path(directory) / NAME
    try:
        return dacite.from_dict(StudyRecord, json.loads(path.read_text()), dacite.Config(cast=[tuple]))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, TypeError, dacite.DaciteError) as error:
        raise OutputError(f"{path}: cannot be read: {' '.join(str(error).split())[:120]}") from None


def begin_study(directory, record, resume):
    """Make a locked directory ready for a study; return the folder to write to. Raises UserError where the
    directory is that of something else."""
    directory = Path(directory)
    stage = directory / UNFINISHED
    if os.path.lexists(stage) and not is_folder(stage):
        raise OutputError(f"{stage}: is no folder of mgehl's: it is left alone")
    if os.path.lexists(directory / FIELDS):
        raise UserError(f"{directory}: is the directory of a run; choose another with --out")
    before = read_record(stage) or read_record(directory)
    if resume and before and before.name != record.name:
        raise UserError(f"--resume: {directory} is of study {before.name}, not of study {record.name}")
    with writing(stage):
        stage.mkdir(exist_ok=True)
        clear_parts(stage)
        remove_plain(_drawn(stage))
    write_record(stage, record)
    return stage


def clear_runs(directory):
    """Remove the runs of a study's cases, and nothing else that lies there. Raises OutputError."""
    directory = Path(directory)
    with writing(directory):
        for folder in filter(is_folder, (directory / RUNS, *directory.glob(f"*/{RUNS}"))):
            for path in filter(is_folder, folder.iterdir()):
                if _RUN.fullmatch(path.name):
                    _clear_run(path)


def _clear_run(path):
    clear_checkpoint(path)
    remove_plain(path / name for name in files_of(path))
    for folder in (path / LAWS, path):
        with suppress(OSError):  # not there, or somebody else's, too
            folder.rmdir()


def _drawn(stage):
    """Tables and pictures of a folder."""
    return [path for path in stage.iterdir() if _is_name(path.name) and is_plain(path)]


def _is_name(name):
    """True of a table or picture in the directory itself."""
    return Path(name).suffix in ENDINGS and not {"/", "\0"} & {*name}


def finish_study(directory, stage, resume):
    """Put the tables and pictures of `stage` in the directory, in the place of those that were there. With
    `resume`, tables that were not written anew stay. Raises OutputError."""
    directory, record, old = Path(directory), read_record(stage), read_record(directory)
    known, new = {*filter(_is_name, old.files if old else ())}, {path.name for path in _drawn(stage)}
    for there in sorted(directory / name for name in new):
        if os.path.lexists(there) and not (there.name in known and is_plain(there)):
            raise OutputError(f"{there}: is not this study's: it is left alone; move it away")
    stay = new | (known if resume else set())
    # Before any is moved: whatever ends the process, the next study knows them as its own.
    write_record(directory, replace(record, files=tuple(sorted(known | new))))
    with writing(directory):
        remove_plain(directory / name for name in known - stay)
        for name in new:
            (stage / name).replace(directory / name)
    write_record(directory, replace(record, files=tuple(sorted(stay))))
    with suppress(OSError):  # somebody else's, too
        remove_plain([stage / NAME])
        stage.rmdir()
