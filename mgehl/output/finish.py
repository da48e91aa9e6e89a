"""How a run's directory begins, with what is solved, and how it is finished, with result and picture.

Files are the first rank's. Of several ranks the last one draws the picture while the first one writes the
rest: each takes half a second on 1025 nodes.
"""

import hashlib
import shutil
from dataclasses import replace

import tomli_w

from mgehl.config import load_config
from mgehl.errors import OutputError, one_line
from mgehl.grid.events import FILES, event
from mgehl.output import files
from mgehl.output.checkpoint import clear, start_of
from mgehl.output.directory import FINISHED, check_result, clear_stage, install, seal
from mgehl.output.laws import as_they_were, law_files, laws, origins, portable
from mgehl.output.manifest import Manifest, checksum, new_identity, read_manifest
from mgehl.output.stored import read_run
from mgehl.output.whole_file import whole_file
from mgehl.saying import complain

BEGUN = "begun run"
"""Kind of the manifest in a checkpoint, which is of what is solved and not of a result."""


def begin_run(directory, config):
    """Write what is solved into a directory; return the run's identity. A run that goes on keeps its own.

    Raises OutputError.
    """
    folder = files.RunFiles(directory).checkpoint
    begun = read_manifest(folder)
    if begun:
        return begun.identity
    identity = new_identity()
    try:
        folder.mkdir(exist_ok=True)
        content = {files.CONFIGURATION: tomli_w.dumps(portable(config)).encode(), **laws(config)}
        # First, so that whatever a kill leaves is known to be mgehl's.
        known = {name: hashlib.sha256(each).hexdigest() for name, each in content.items()}
        Manifest(BEGUN, identity, known, origins(config, directory)).write(folder)
        for name, each in content.items():
            (folder / name).parent.mkdir(exist_ok=True)
            with whole_file(folder / name) as part:
                part.write_bytes(each)
    except OSError as error:
        raise OutputError(f"{directory}: cannot be written: {error.strerror or error}") from None
    return identity


@event(FILES)
def finish_run(comm, directory, solution):
    """Replace the result in the directory by the files of a `Solution`, add its picture, remove the
    checkpoint (collective).

    Raises OutputError where the disk does not take them; the checkpoint stays then.
    """
    picture = _drawn_by_last(comm, solution)
    files.from_first_rank(comm, _write_result, directory, solution)
    picture = comm.gather(picture)
    files.from_first_rank(comm, _add_picture, directory, solution, picture and picture[-1])


def _drawn_by_last(comm, solution):
    """The picture as the last of several ranks draws it, as of `_drawn`; None on the others."""
    last = comm.size - 1
    if last == 0:  # it has the result to write first
        return None
    fields = solution.fields_on(comm, last)
    return _drawn(replace(solution, fields=fields)) if comm.rank == last else None


def _write_result(directory, solution):
    """Replace the result in the directory."""
    folder = files.RunFiles(directory).checkpoint
    try:
        stage = clear_stage(folder / FINISHED)
        names = _write(files.RunFiles(stage), solution)
        names += _copy_laws(folder, stage, solution.config)
        begun = read_manifest(folder)
        seal(stage, "run", begun.identity, names, begun.origins)
    except OSError as error:
        raise OutputError(f"{directory}: cannot be written: {error.strerror or error}") from None
    install(directory, stage)


def _add_picture(directory, solution, picture=None):
    """Put the `picture`, or the one that is drawn now, beside a result; remove the checkpoint."""
    _keep_picture(directory, picture or _drawn(solution))
    clear(directory)


def _write(paths, solution):
    """Write everything but the picture; return the names."""
    files.write_config(paths.configuration, portable(solution.config))
    files.write_history(paths.history, solution.rows)
    files.write_fields(paths.fields, solution)
    files.write_result(paths.result, solution.result)
    written = [paths.configuration, paths.history, paths.fields, paths.result]
    if not solution.contact.is_loaded:
        files.write_center_line(paths.center_line, solution.mesh, solution.fields)
        written.append(paths.center_line)
    return [path.name for path in written]


def _copy_laws(folder, stage, config):
    """The laws as they were when the run began; return the names."""
    names = list(law_files(config).values())
    for name in names:
        (stage / name).parent.mkdir(exist_ok=True)
        shutil.copyfile(folder / name, stage / name)
    return names


def _drawn(solution):
    """A run's picture, as the bytes of a PNG file; where it cannot be drawn, a line that says why."""
    try:
        from mgehl.output.pictures.picture import drawn  # matplotlib is slow to import

        return drawn(solution)
    except Exception as error:  # what matplotlib raises is anybody's guess
        return one_line(error)


def _keep_picture(directory, picture):
    """Put what `_drawn` returned beside a result. Where that fails, a message says so, and the result stays
    as it is."""
    paths = files.RunFiles(directory)
    part = paths.checkpoint / FINISHED / paths.picture.name
    try:
        if paths.picture.exists() or paths.picture.is_symlink():
            raise OutputError("what is in its place is not mgehl's")
        if isinstance(picture, str):
            raise OutputError(picture)
        part.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(part) as file:
            file.write_bytes(picture)
        manifest = check_result(directory)
        known = manifest.files | {paths.picture.name: checksum(part)}
        replace(manifest, files=known).write(directory)
        part.replace(paths.picture)
    except (OutputError, OSError) as error:
        complain(
            f"{paths.picture}: cannot be drawn: {one_line(error)}; the results are there, and "
            f"mgehl run --resume {directory} draws it again"
        )


def draw_missing(directory):
    """Draw the picture of a finished run if it has none, remove its checkpoint; return the result."""
    solution = read_run(directory)
    if files.RunFiles(directory).picture.exists():
        clear(directory)
    else:
        _add_picture(directory, solution)
    return solution.result


def taken_up(directory):
    """(configuration, directory of the start, messages) of a run to go on with. The configuration is None
    where the run has finished; a result that is not yet in its place is put there. The start is None where
    the run did not start from another one. Raises OutputError.
    """
    paths = files.RunFiles(directory)
    stage = paths.checkpoint / FINISHED
    if read_manifest(stage):
        install(directory, stage)
    begun, finished = read_manifest(paths.checkpoint), read_manifest(directory)
    if begun is None or (finished and finished.identity == begun.identity):
        check_result(directory)
        return None, None, []
    if not (paths.checkpoint / files.CONFIGURATION).exists():
        raise OutputError(f"{directory}: ended before it began: run it again, with --force")
    for name in begun.wrong(paths.checkpoint):
        raise OutputError(f"{paths.checkpoint / name}: was edited or is damaged since the run began")
    config, said = as_they_were(load_config(paths.checkpoint / files.CONFIGURATION), begun, directory)
    start = start_of(directory)
    return config, start if start.is_dir() else None, said
