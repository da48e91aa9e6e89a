"""The directory of a run: what is in it, how a run is published there, and what is never touched.

    fields.h5        the whole run: fields, result, history, configuration, with HDF5's checksums
    result.json, history.csv, configuration.toml, laws/, ...   the same for people and other programs
    checkpoint/      what a run that has not finished has reached (`checkpoint`)

A run is put together in the checkpoint. Once it is on the disk one rename replaces fields.h5: readers have
the old run or the new one. Only plain files of a run's names are ever removed or replaced.
"""

import os
import re
from contextlib import suppress
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.checkpoint import BEGUN, START, read_begun
from mgehl.output.files import CHECKPOINT, FIELDS, NAMES, PLOTS, REPORT, SERIES, STUDY
from mgehl.output.laws import FOLDER as LAWS
from mgehl.output.stored import files_of
from mgehl.output.whole_file import clear_parts, is_folder, is_plain, remove_plain, writing

FINISHED = "finished"
"""Folder of the checkpoint in which a run is put together."""

_OWN = re.compile(r"solve-\d{4}\.npz|under-way\.npz|frame-\d{6}\.npz")
_SIGN = b'<meta name="generator" content="mgehl'


def make_directory(path, force=False):
    """Create a directory; with `force` one that exists will do. Raises OutputError."""
    path = Path(path)
    if path.is_dir() and not force:
        resume = f"go on with --resume {path}, " if (path / CHECKPOINT).is_dir() else ""
        raise OutputError(f"{path} exists: {resume}add --force to replace it, or choose another with --out")
    if os.path.lexists(path) and not path.is_dir():
        raise OutputError(f"{path}: is no directory: choose another with --out")
    with writing(path):
        path.mkdir(parents=True, exist_ok=force)


def prepare_directory(directory, laws=()):
    """Make a locked directory ready for a new run: its result stays, the checkpoint of an earlier run goes.
    Raises OutputError where the new run, with the names of its `laws`, would replace what is no run's."""
    check_replaceable(directory, laws)
    clear_checkpoint(directory)


def check_replaceable(directory, laws=()):
    """Raise OutputError where a run in this directory would replace what is no run's."""
    directory = Path(directory)
    folder = directory / CHECKPOINT
    if (directory / STUDY).exists():
        raise OutputError(f"{directory}: is the directory of a study; choose another with --out")
    known = files_of(directory) | ({SERIES} if is_plain(folder / BEGUN) else set())
    names = [name for name in (*NAMES, *laws) if not (name in known and is_plain(directory / name))]
    foreign = [directory / name for name in names]
    foreign += [path for path in (directory / LAWS, folder) if not is_folder(path)]
    foreign = [path for path in foreign if os.path.lexists(path)]
    if _own_files(folder) and not is_plain(folder / BEGUN):
        foreign.append(folder)
    if foreign:
        raise OutputError(
            f"{foreign[0]}: is not mgehl's, or damaged: it is left alone; "
            "move it away, or choose another directory with --out"
        )


def _own_files(folder):
    """Plain files in the folder of a checkpoint that have names of mgehl's."""
    names = os.listdir(folder) if is_folder(folder) else []
    return [path for path in map(folder.joinpath, filter(_OWN.fullmatch, names)) if is_plain(path)]


def clear_checkpoint(directory):
    """Remove a checkpoint: mgehl's own files only, whatever else lies in that folder."""
    folder = Path(directory) / CHECKPOINT
    if not is_folder(folder):
        return
    stage, start, laws = folder / FINISHED, folder / START, ()
    with suppress(OutputError, AttributeError):  # damaged, or not there
        laws = read_begun(directory).origins
    own = [stage / name for name in (*NAMES, *laws)] + [start / name for name in files_of(start)]
    own += [folder / name for name in laws] + _own_files(folder)
    with suppress(OSError):  # what stays is not read
        for each in (folder, stage, start):
            clear_parts(each)
        remove_plain((*own, folder / BEGUN))  # last the one that says that they are mgehl's
    for each in (stage / LAWS, stage, start / LAWS, start, folder / LAWS, folder):
        with suppress(OSError):  # not there, or somebody else's, too
            each.rmdir()


def made_before(directory):
    """Names of files that may have been made of the run in a directory, by export and plot."""
    directory = Path(directory)
    if not (directory / FIELDS).exists():
        return []
    exported = (path.name for path in directory.glob(f"{Path(FIELDS).stem}*") if path.name != FIELDS)
    return sorted(exported) + [PLOTS] * (directory / PLOTS).exists()


def publish(directory, stage, names):
    """Put the run whose files are in the folder `stage` in the place of the one before. Raises OSError, and
    OutputError where something else is in the way; what is there then stays as it is.
    """
    laws = [name for name in names if name.startswith(f"{LAWS}/")]
    check_replaceable(directory, laws)
    old = files_of(directory)
    if laws:
        (directory / LAWS).mkdir(exist_ok=True)
    (stage / FIELDS).replace(directory / FIELDS)
    for name in sorted({*names} - {FIELDS}):
        (stage / name).replace(directory / name)
    remove_plain(directory / name for name in old - {*names})
    with suppress(OSError):  # in use, or not there
        (directory / LAWS).rmdir()
    page = directory / REPORT
    with suppress(OSError):  # of the run before, if mgehl made it
        if is_plain(page) and _SIGN in page.read_bytes()[:4096]:
            page.unlink()
