"""A run's way on disk, so that it goes on where it was, whatever ended it.

RUN/checkpoint/
    start/                the run that this one was started from, if any
    solve-0000.npz, ...   finished solves, in order: a grid of the nested iteration each, or a step in speed
    under-way.npz         where the next one stands, saved every so many seconds

Every file is whole (`whole_file`) and says by which version it was written. A run that goes on walks
the same way again: what is finished is read instead of solved.
"""

import json
import shutil
import time
import zipfile

import numpy as np

from mgehl.errors import OutputError
from mgehl.output.files import RunFiles, on_first_rank
from mgehl.output.records import Reader, Writer
from mgehl.output.whole_file import whole_file
from mgehl.solver.journal import Journal
from mgehl.version import VERSION

START = "start"
"""Folder in it of the run that was started from: that one may be gone by then."""
UNDER_WAY = "under-way.npz"
FORMAT = 1
"""Of the files; another one is not read."""


class Checkpoint(Journal):
    """Keeps a run's way in DIRECTORY/checkpoint, every `seconds` and after each solve.

    `progress` has the history, which is kept with it. `stop` is asked before every step; it
    returns None or the `Stopped` to raise, once the present position is saved.
    """

    def __init__(self, directory, progress, seconds, stop=lambda: None):
        self._folder, self._progress = RunFiles(directory).checkpoint, progress
        self._seconds, self._stop = seconds, stop
        self._solved = 0
        self._saved = time.monotonic()

    def recall(self, grid):
        """The `Outcome` of the next solve where its file is there, else None (collective)."""
        outcome = self._read(grid, self._finished(self._solved))
        if outcome is not None:
            self._solved += 1
        return outcome

    def standing(self, grid):
        """Where the next solve stood, else None (collective)."""
        return self._read(grid, self._folder / UNDER_WAY)

    def step(self, grid, position):
        """Save the position where it is time, or time to stop (collective)."""
        due = time.monotonic() - self._saved >= self._seconds
        stopped = self._stop()
        # Clocks differ and a signal may reach one rank only: all do what one has to.
        if grid.max([2.0 if stopped else 1.0 if due else 0.0]) == 0.0:
            return
        self._write(grid, self._folder / UNDER_WAY, position)
        stopped = next((each for each in grid.comm.allgather(stopped) if each), None)
        if stopped:
            raise stopped

    def finish(self, grid, outcome):
        """Save the end of a solve; what was under way is behind (collective)."""
        self._write(grid, self._finished(self._solved), outcome)
        self._solved += 1

    def _finished(self, number):
        return self._folder / f"solve-{number:04d}.npz"

    def _write(self, grid, path, thing):
        writer = Writer(grid)
        record = {
            "format": FORMAT,
            "mgehl": VERSION,
            "solve": self._solved,
            "progress": self._progress.record(),
            "thing": writer.plain(thing),
        }
        on_first_rank(grid.comm, save, path, record, writer.arrays)
        self._saved = time.monotonic()

    def _read(self, grid, path):
        """What a file holds, if it is there and about the next solve; the history goes on from it."""
        found = on_first_rank(grid.comm, load, path)
        record, arrays = found or (None, None)
        record = grid.comm.bcast(record)
        if record is None or record["solve"] != self._solved:
            return None
        self._progress.go_on(record["progress"])
        return Reader(grid, arrays).alive(record["thing"])


def clear(directory):
    """Forget a run's way: it has arrived."""
    shutil.rmtree(RunFiles(directory).checkpoint, ignore_errors=True)


def keep_start(directory, start):
    """Copy the files of the run that is started from beside the checkpoint. Raises OutputError."""
    source = RunFiles(start)
    target = start_of(directory)
    try:
        target.mkdir(parents=True)
        for path in (source.configuration, source.fields, source.history, source.result):
            shutil.copy(path, target / path.name)
    except OSError as error:
        raise OutputError(f"{target}: cannot be written: {error.strerror or error}") from None


def start_of(directory):
    """Where `keep_start` put the run that was started from."""
    return RunFiles(directory).checkpoint / START


def save(path, record, arrays):
    """Write a record and its arrays as one whole file. Raises OutputError."""
    text = np.frombuffer(json.dumps(record).encode(), dtype=np.uint8)
    try:
        path.parent.mkdir(exist_ok=True)
        with whole_file(path) as part:
            np.savez(part, record=text, **arrays)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None


def load(path):
    """(record, arrays) of a file, None where there is none. Raises OutputError where it is damaged."""
    try:
        with np.load(path, allow_pickle=False) as file:
            record = json.loads(file["record"].tobytes())
            arrays = {name: file[name] for name in file.files if name != "record"}
    except FileNotFoundError:
        return None
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise OutputError(f"{path}: is damaged, or no checkpoint: {error}; without it, the run "
                          "begins earlier") from None  # fmt: skip
    by = record.get("mgehl")
    if record.get("format") != FORMAT or by != VERSION:
        raise OutputError(f"{path}: was written by mgehl {by}, and {VERSION} cannot go on with it")
    return record, arrays
