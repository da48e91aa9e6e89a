"""A study's directory: new tables are put together in a folder, and replace the old ones at the end."""

from pathlib import Path

from mgehl.errors import OutputError, UserError
from mgehl.output.directory import install
from mgehl.output.manifest import Manifest, checksums, new_identity, read_manifest
from mgehl.output.report.study_record import read_record, write_record
from mgehl.output.whole_file import clear_parts, is_folder, is_plain

UNFINISHED = "unfinished"
"""Folder of tables and pictures until all are there."""

ENDINGS = {".csv", ".md", ".png", ".json"}


def begin_study(directory, record, resume):
    """Make a locked directory ready for a study; return the folder to write to.

    Raises UserError where the directory is that of something else.
    """
    stage = Path(directory) / UNFINISHED
    if stage.is_symlink() or (stage.exists() and not is_folder(stage)):
        raise OutputError(f"{stage}: is no folder of mgehl's: it is left alone")
    if is_folder(stage) and read_manifest(stage):  # a kill at the very end
        install(directory, stage)
    _check_kind(directory, record, resume)
    try:
        stage.mkdir(exist_ok=True)
        clear_parts(stage)
        for path in stage.iterdir():
            if path.suffix in ENDINGS and is_plain(path):
                path.unlink()
    except OSError as error:
        raise OutputError(f"{stage}: cannot be written: {error.strerror or error}") from None
    write_record(stage, record)
    return stage


def _check_kind(directory, record, resume):
    found = read_manifest(directory)
    if found and found.kind != "study":
        raise UserError(f"{directory}: is the directory of a run; choose another with --out")
    before = read_record(Path(directory) / UNFINISHED) or read_record(directory)
    if resume and before and before.name != record.name:
        raise UserError(f"--resume: {directory} is of study {before.name}, not of study {record.name}")


def finish_study(directory, stage, resume):
    """Put the tables and pictures of `stage` in the directory, in the place of those that were there.

    With `resume`, tables that were not written anew stay. Raises OutputError.
    """
    old = read_manifest(directory)
    kept = old.files if old and resume else {}
    try:
        names = [path.name for path in stage.iterdir() if path.suffix in ENDINGS and is_plain(path)]
        new = Manifest("study", new_identity(), kept | checksums(stage, names))
    except OSError as error:
        raise OutputError(f"{stage}: cannot be read: {error.strerror or error}") from None
    new.write(stage)
    install(directory, stage)
