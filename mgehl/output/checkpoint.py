"""How far a run has come, on disk: whatever ends the run, it can go on from there.

RUN/checkpoint/
    configuration.toml    what is solved, and laws/ with the functions of the user's own
    manifest.json         the run's identity, by which its other files are known
    start/                the run that this one was started from, if any
    solve-0000.npz, ...   finished solves, in order: a grid of the nested iteration each, or a step in speed
    under-way.npz         where the next one stands, saved every so many seconds
    finished/             the result, until it is installed in the place of the one before

Every file is whole and has a checksum (`archive`). Its record has

    format, mgehl       the version of this layout, and of the program
    run                 the identity of the run that wrote it
    configuration       for which it was written
    solve               the number of the solve
    progress            the history of the run until then, its convolutions and seconds
    values              what the solver kept beside its arrays, by name

The names of values and arrays are described in `solver.record`; here nothing is known of them. An array in
a file is of the whole grid, (ny, nx), or of several such. A run that goes on repeats its solves in order;
those that are finished are read instead of solved.

On a rough surface nearly all of under-way.npz is what the linear solver remembers: 75 to 150 MB on 257
nodes, saved in half a second, 450 MB on 513 in two seconds. A solve of ten seconds on 257 nodes ends before
it is saved once.
"""

import json
import shutil
import time
from contextlib import suppress

from mgehl.errors import OutputError, one_line
from mgehl.output.archive import save, unpacked
from mgehl.output.directory import check_result, clear_checkpoint
from mgehl.output.files import START, RunFiles, on_first_rank
from mgehl.output.laws import portable
from mgehl.output.manifest import NAME as MANIFEST
from mgehl.solver.journal import Journal, told_to_stop
from mgehl.solver.record import Record
from mgehl.version import VERSION

UNDER_WAY = "under-way.npz"
FORMAT = 8
"""Version of the files. It goes up with every change of the layout or of a name; files of another version
are not read."""


class Checkpoint(Journal):
    """Keeps how far the run of `config` has come in DIRECTORY/checkpoint, every `seconds` and after each
    solve.

    `progress` has the history, which is kept with it. `stop` is asked before every step; it
    returns None or the `Stopped` to raise, once the present position is saved.
    """

    def __init__(self, directory, config, progress, seconds, stop=lambda: None, identity=""):
        self._folder, self._progress = RunFiles(directory).checkpoint, progress
        self._configuration, self._identity = json.dumps(portable(config)), identity
        self._seconds, self._stop = seconds, stop
        self._solved = 0
        self._saved = time.monotonic()

    def recall(self, grid, made):
        """The end of the next solve where its file is there, else None (collective)."""
        outcome = self._read(grid, self._finished(self._solved), made)
        if outcome is not None:
            self._solved += 1
        return outcome

    def standing(self, grid, made):
        """Where the next solve stood, else None (collective)."""
        return self._read(grid, self._folder / UNDER_WAY, made)

    def step(self, grid, position):
        """Save the position where it is time, or time to stop (collective)."""
        stopped = told_to_stop(grid.comm, self._stop)
        # Clocks differ: all save when it is time for one.
        due = grid.max([time.monotonic() - self._saved]) >= self._seconds
        if stopped or due:
            self._write(grid, self._folder / UNDER_WAY, position)
        if stopped:
            raise stopped

    def finish(self, grid, outcome):
        """Save the end of a solve, which is no longer under way (collective)."""
        self._write(grid, self._finished(self._solved), outcome)
        self._solved += 1

    def _finished(self, number):
        return self._folder / f"solve-{number:04d}.npz"

    def _write(self, grid, path, kept):
        """Write what `kept.record()` has, the arrays gathered."""
        kept = kept.record()
        record = {
            "format": FORMAT,
            "mgehl": VERSION,
            "run": self._identity,
            "configuration": json.loads(self._configuration),
            "solve": self._solved,
            "progress": self._progress.record(),
            "values": kept.values,
        }
        arrays = {name: grid.gather(array) for name, array in kept.arrays.items()}
        on_first_rank(grid.comm, save, path, record, arrays)
        self._saved = time.monotonic()

    def _read(self, grid, path, made):
        """What is `made` of a file, where it is there and about the next solve; the history goes on from
        it."""
        found = on_first_rank(grid.comm, load, path, self._configuration, self._identity)
        record, arrays = found or (None, {})
        record = grid.comm.bcast(record)
        if record is None or record["solve"] != self._solved:
            return None
        try:
            kept = made(Record(record["values"], scattered(grid, arrays)))
        except (KeyError, TypeError, ValueError) as error:
            raise OutputError(damaged(path, error)) from None
        self._progress.go_on(record["progress"])
        return kept


def scattered(grid, arrays):
    """Every rank's lines of the whole arrays that rank 0 has (collective).

    Raises ValueError, on all, where one is not of this grid.
    """
    whole = (grid.mesh.ny, grid.mesh.nx)
    shapes = grid.comm.bcast({name: array.shape for name, array in arrays.items()})
    for name, shape in shapes.items():
        if shape[-2:] != whole:
            raise ValueError(f"{name} is not of {whole[1]} x {whole[0]} nodes")
    return {name: grid.scatter(arrays.get(name)) for name in shapes}


def clear(directory):
    """Remove the checkpoint of a run that has finished."""
    with suppress(OSError):  # what stays is not read: the result is there
        clear_checkpoint(directory)


def is_begun(directory):
    """Whether a directory has the checkpoint of a run that has not finished, or was just about to."""
    return (RunFiles(directory).checkpoint / MANIFEST).exists()


def keep_start(directory, start):
    """Copy the files of the run that this one starts from into the checkpoint. Raises OutputError."""
    source, target = RunFiles(start).directory, start_of(directory)
    names = [*check_result(start).files, MANIFEST]
    try:
        for name in names:
            if (source / name).exists():  # a picture may be missing
                (target / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source / name, target / name)
    except OSError as error:
        raise OutputError(f"{target}: cannot be written: {error.strerror or error}") from None


def start_of(directory):
    """Where `keep_start` put the run that was started from."""
    return RunFiles(directory).checkpoint / START


def damaged(path, error):
    """The message about a file that raised an `error`."""
    return f"{path}: is damaged, or no checkpoint: {one_line(error)}; without it, the run begins earlier"


def load(path, configuration, identity=None):
    """(record, arrays) of a file, None where there is none; `configuration` is the run's as JSON.

    Raises OutputError where it is damaged, of another version, configuration, or run than `identity`.
    """
    try:
        record, arrays, is_whole = unpacked(path)
    except FileNotFoundError:
        return None
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise OutputError(damaged(path, error)) from None
    by = record.get("mgehl")
    if record.get("format") != FORMAT or by != VERSION:
        raise OutputError(f"{path}: was written by mgehl {by}, and {VERSION} cannot go on with it")
    if not is_whole:
        raise OutputError(damaged(path, ValueError("it was edited")))
    if json.dumps(record.get("configuration")) != configuration:
        raise OutputError(f"{path}: was written for another configuration than the run has now")
    if identity is not None and record.get("run") != identity:
        raise OutputError(f"{path}: is of another run than this directory's")
    return record, arrays
