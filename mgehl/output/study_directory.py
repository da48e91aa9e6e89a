"""A study's directory: new tables are put together in a folder, and replace the old ones at the end.

Its cases are run directories, in runs/ or in runs/ of folders in it.
"""

import os
import re
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from mgehl.errors import OutputError, UserError
from mgehl.output.directory import clear_checkpoint
from mgehl.output.files import FIELDS
from mgehl.output.laws import FOLDER as LAWS
from mgehl.output.report.study_record import NAME, read_record, write_record
from mgehl.output.stored import files_of
from mgehl.output.whole_file import clear_parts, is_folder, is_plain, writing

UNFINISHED = "unfinished"
"""Folder of tables and pictures until all are there."""

RUNS = "runs"
"""Folder of run directories."""

POINT = "point.json"
"""In a run directory what a study knows of it besides."""

_RUN = re.compile(r"\d{3,}|.*-[0-9a-f]{16}")
"""Names of run directories that sweeps and studies make."""

ENDINGS = {".csv", ".md", ".nc", ".png"}


def begin_study(directory, record, resume):
    """Make a locked directory ready for a study; return the folder to write to.

    Raises UserError where the directory is that of something else.
    """
    directory = Path(directory)
    stage = directory / UNFINISHED
    if os.path.lexists(stage) and not is_folder(stage):
        raise OutputError(f"{stage}: is no folder of mgehl's: it is left alone")
    if _is_whole(stage):  # a kill at the very end
        _publish(directory, stage)
    _check_kind(directory, record, resume)
    with writing(stage):
        stage.mkdir(exist_ok=True)
        clear_parts(stage)
        for path in _drawn(stage):
            path.unlink()
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
    for name in (*files_of(path), POINT):
        if is_plain(path / name):
            (path / name).unlink()
    for folder in (path / LAWS, path):
        with suppress(OSError):  # not there, or somebody else's, too
            folder.rmdir()


def _is_whole(stage):
    record = read_record(stage)
    return bool(record and record.files)


def _drawn(stage):
    """Tables and pictures of a folder."""
    return [path for path in stage.iterdir() if _is_name(path.name) and is_plain(path)]


def _is_name(name):
    """True of a table or picture in the directory itself."""
    return Path(name).suffix in ENDINGS and not {"/", "\0"} & {*name}


def _check_kind(directory, record, resume):
    if os.path.lexists(directory / FIELDS):
        raise UserError(f"{directory}: is the directory of a run; choose another with --out")
    before = read_record(directory / UNFINISHED) or read_record(directory)
    if resume and before and before.name != record.name:
        raise UserError(f"--resume: {directory} is of study {before.name}, not of study {record.name}")


def finish_study(directory, stage, resume):
    """Put the tables and pictures of `stage` in the directory, in the place of those that were there.

    With `resume`, tables that were not written anew stay. Raises OutputError.
    """
    old = read_record(directory)
    kept = old.files if old and resume else ()
    with writing(stage):
        files = {*kept, *(path.name for path in _drawn(stage))}
        write_record(stage, replace(read_record(stage), files=tuple(sorted(files))))
    _publish(Path(directory), stage)


def _publish(directory, stage):
    """Move the new files, remove the old ones that have no successor; a second call finishes the work."""
    new, old = read_record(stage), read_record(directory)
    known = {NAME, *filter(_is_name, old.files if old else ())}
    moved = [name for name in (*filter(_is_name, new.files), NAME) if is_plain(stage / name)]
    for name in moved:
        there = directory / name
        if os.path.lexists(there) and not (name in known and is_plain(there)):
            raise OutputError(f"{there}: is not this study's: it is left alone; move it away")
    with writing(directory):
        for name in known - {*new.files, NAME}:
            if is_plain(directory / name):
                (directory / name).unlink()
        for name in moved:
            (stage / name).replace(directory / name)
    with suppress(OSError):  # somebody else's, too
        stage.rmdir()


def check_study(directory):
    """Raise OutputError where the files of a study are not all there, or only some are replaced yet."""
    directory = Path(directory)
    record = read_record(directory)
    for name in record.files if record else ():
        if not (directory / name).exists():
            raise OutputError(f"{directory / name}: is missing: the study must be made again")
    if _is_whole(directory / UNFINISHED):
        raise OutputError(f"{directory}: has not finished: go on with --resume")
