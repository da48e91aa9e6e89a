"""The directory of a run or study: what is in it, how a result gets there, and what is never touched.

A new result is put together in a folder beside the old one, and replaces it when it is whole (`install`). A
process that ends in between leaves the old result, or enough to go on with. Only plain files that a
manifest names are removed or replaced, and only if they are still as it says.
"""

import os
import re
from contextlib import suppress
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output import manifest as manifests
from mgehl.output.files import CHECKPOINT, NAMES, REPORT, START
from mgehl.output.laws import FOLDER as LAWS
from mgehl.output.manifest import Manifest, checksum, checksums, read_manifest
from mgehl.output.whole_file import clear_parts, is_folder, is_plain

FINISHED = "finished"
"""Folder of a result until it is installed."""

DRAWN = ("picture.png",)
"""Files of a run that may be missing: they can be drawn again."""

_OWN_IN_CHECKPOINT = re.compile(r"solve-\d{4}\.npz|under-way\.npz|configuration\.toml|manifest\.json")
_SIGN = b'<meta name="generator" content="mgehl'


def make_directory(path, force=False):
    """Create a directory; with `force` one that exists will do. Raises OutputError."""
    path = Path(path)
    try:
        path.mkdir(parents=True, exist_ok=force)
    except FileExistsError:
        if force:
            raise OutputError(f"{path}: is no directory") from None
        raise OutputError(
            f"{path} exists: add --force to replace it, or choose another with --out"
        ) from None
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror}") from None


def prepare_directory(directory):
    """Make a locked directory ready for a new run: its result stays, the checkpoint of an earlier run goes.

    Raises OutputError where the new result would replace what mgehl did not write.
    """
    stage = Path(directory) / CHECKPOINT / FINISHED
    if read_manifest(stage):  # a kill at the very end
        install(directory, stage)
    check_replaceable(directory)
    clear_checkpoint(directory)


def check_replaceable(directory):
    """Raise OutputError where a run in this directory would replace what mgehl did not write."""
    directory = Path(directory)
    found = read_manifest(directory)
    if found and found.kind != "run":
        raise OutputError(f"{directory}: is the directory of a {found.kind}; choose another with --out")
    known = _known_by(found)
    for name in NAMES:
        _check_own(directory, name, known)
    if os.path.lexists(directory / LAWS) and not is_folder(directory / LAWS):
        raise OutputError(_foreign(directory / LAWS))
    folder = directory / CHECKPOINT
    if os.path.lexists(folder) and not is_folder(folder):
        raise OutputError(_foreign(folder))
    if is_folder(folder) and read_manifest(folder) is None and _own_files(folder):
        raise OutputError(_foreign(folder))


def _check_own(directory, name, known):
    path = directory / name
    if os.path.lexists(path) and checksum(path) not in known.get(name, ()):
        raise OutputError(_foreign(path))


def _foreign(path):
    return (
        f"{path}: is not as mgehl wrote it, or not mgehl's: it is left alone; "
        "move it away, or choose another directory with --out"
    )


def clear_checkpoint(directory):
    """Remove a checkpoint: mgehl's own files only, whatever else lies in that folder."""
    folder = Path(directory) / CHECKPOINT
    if not is_folder(folder):
        return
    clear_parts(folder)
    for inner in (folder / FINISHED, folder / START, folder):
        for path in _own_files(inner):
            path.unlink(missing_ok=True)
        for each in (inner / LAWS, inner):
            if is_folder(each):
                with suppress(OSError):  # somebody else's
                    each.rmdir()


def _own_files(folder):
    """Plain files in the folder of a checkpoint that have names of mgehl's."""
    if not is_folder(folder):
        return []
    names = [each.name for each in folder.iterdir()]
    own = [folder / name for name in names if name in NAMES or _OWN_IN_CHECKPOINT.fullmatch(name)]
    laws = folder / LAWS
    known = read_manifest(folder)
    if known and is_folder(laws):
        own += [folder / name for name in known.files if name.startswith(f"{LAWS}/")]
    # The manifest goes last: without it what is left would be nobody's.
    return sorted(filter(is_plain, own), key=lambda path: path.name == manifests.NAME)


def clear_stage(stage):
    """Make an empty folder for a result, removing what an earlier process left there; return it.

    Raises OSError.
    """
    stage.mkdir(parents=True, exist_ok=True)
    clear_parts(stage)
    for path in _own_files(stage):
        path.unlink()
    return stage


def install(directory, stage):
    """Replace the result that is there by the one in the folder `stage`, which has its manifest. Raises
    OutputError where something else is in the way; `stage` then stays as it is. If a process ends in the
    middle, a second call finishes the work.
    """
    directory, stage = Path(directory), Path(stage)
    new, old = read_manifest(stage), read_manifest(directory)
    try:
        if old and old.identity != new.identity:
            new = Manifest(new.kind, new.identity, new.files, new.origins, old.files)
            new.write(stage)
        known = _known_by(new, old)
        for name in new.files:
            if is_plain(stage / name):  # else it is there already
                _check_own(directory, name, known)
        (directory / manifests.NAME).unlink(missing_ok=True)
        _move(new, stage, directory)
        Manifest(new.kind, new.identity, new.files, new.origins).write(directory)
        _forget_stage(stage)
    except OSError as error:
        raise OutputError(f"{directory}: cannot be written: {error.strerror or error}") from None


def _known_by(*found):
    known = {}
    for each in found:
        for name, value in [*each.files.items(), *each.replaces.items()] if each else ():
            known.setdefault(name, set()).add(value)
    return known


def _move(new, stage, directory):
    """Move the new files, and remove the old ones that have no successor."""
    for name in new.files:
        if is_plain(stage / name):
            (directory / name).parent.mkdir(exist_ok=True)
            (stage / name).replace(directory / name)
    for name, value in new.replaces.items():
        if name not in new.files and checksum(directory / name) == value:
            (directory / name).unlink()
    with suppress(OSError):  # in use, or not there
        (directory / LAWS).rmdir()
    _remove_report(directory / REPORT)


def _forget_stage(stage):
    (stage / manifests.NAME).unlink(missing_ok=True)
    for each in (stage / LAWS, stage):
        with suppress(OSError):
            each.rmdir()


def _remove_report(path):
    """A page of the result before, if mgehl made it."""
    with suppress(OSError):
        if is_plain(path) and _SIGN in path.read_bytes()[:4096]:
            path.unlink()


def check_result(directory, kind="run"):
    """The `Manifest` of a finished run or study, whose files are all as it wrote them.

    Raises OutputError where they are not.
    """
    directory = Path(directory)
    if not directory.is_dir():
        raise OutputError(f"{directory}: is no {kind} directory")
    found = read_manifest(directory)
    if found is None:
        raise OutputError(_unfinished(directory, kind))
    if found.kind != kind:
        raise OutputError(f"{directory}: is no {kind} directory, but that of a {found.kind}")
    for name in found.wrong(directory, DRAWN):
        raise OutputError(_changed(directory / name))
    return found


def _unfinished(directory, kind):
    if read_manifest(directory / CHECKPOINT):
        return f"{directory}: has not finished: go on with: mgehl run --resume {directory}"
    if not any(os.path.lexists(directory / name) for name in (*NAMES, "study.json")):
        return f"{directory}: is no {kind} directory"
    return (
        f"{directory}: has no {manifests.NAME}, which a finished {kind} has: it has not finished, or an "
        "older mgehl wrote it; make it again"
    )


def _changed(path):
    if not os.path.lexists(path):
        return f"{path}: is missing, and its run wrote it: the run must be made again"
    return f"{path}: is damaged, was edited, or is of another run: the run must be made again"


def seal(stage, kind, identity, names, origins=None):
    """Write the manifest of the files in a folder. Raises OSError, OutputError."""
    Manifest(kind, identity, checksums(stage, names), origins or {}).write(stage)
