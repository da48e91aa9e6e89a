"""How far a run has come, on disk: whatever ends the run, it can go on from there.

RUN/checkpoint/
    begun.npz             what is solved: configuration, where own laws were
    laws/                 those laws
    start/                fields.h5 and laws/ of the run that this one was started from
    solve-0000.npz, ...   finished solves, in order: a grid of the nested iteration each, or a step in speed
    under-way.npz         where the next one stands, saved every so many seconds
    frame-000000.npz, ... fields of instants that are kept of a run in time
    finished/             the files of the finished run, until they are published

Every file is whole, and knows again each bit of it (`archive`). Its arrays are of the whole grid, (ny, nx),
or several of such; its record has `format`, `mgehl`, `configuration`, `solve`, `progress` and `values`,
what the solver kept beside arrays (`solver.record`). A run that goes on reads its finished solves.
"""

import os
import time
from dataclasses import dataclass
from pathlib import Path

from mgehl.errors import OutputError, one_line
from mgehl.output.archive import save, unpacked
from mgehl.output.files import CHECKPOINT, FIELDS, on_first_rank
from mgehl.output.laws import is_law, law_files, laws_beside, laws_of, portable, put_files
from mgehl.output.whole_file import writing
from mgehl.solver.journal import Journal, told_to_stop
from mgehl.solver.record import Record
from mgehl.version import VERSION

BEGUN, UNDER_WAY = "begun.npz", "under-way.npz"

START = "start"
"""Folder of the run that this one was started from."""

FORMAT = 17
"""Version of the files, up with every change of layout or name; those of another are not read."""


@dataclass(frozen=True)
class Begun:
    """What a run solves, by the first file of its checkpoint."""

    tables: dict
    """Of the configuration, its laws in laws/."""
    origins: dict
    """{laws/NAME: where that file was, counted from the run's directory}, of all laws."""
    has_start: bool
    """Whether it was started from another run."""


def begin_run(directory, config, start=None):
    """Keep what is solved in a directory, where this is not known yet; `start` is the directory of the run
    that it is started from. Raises OutputError.
    """
    if is_begun(directory):
        return
    folder = Path(directory) / CHECKPOINT
    with writing(directory):
        put_files(folder, laws_of(config))
        if start:
            put_files(folder / START, {FIELDS: (Path(start) / FIELDS).read_bytes()} | laws_beside(start))
    origins = {name: os.path.relpath(file, directory) for file, name in law_files(config).items()}
    save(folder / BEGUN, _head(portable(config)) | {"origins": origins, "has_start": bool(start)}, {})


def read_begun(directory):
    """The `Begun` run of a directory, None where there is none. Raises OutputError where it is damaged."""
    path = Path(directory) / CHECKPOINT / BEGUN
    if not (found := load(path)):
        return None
    record, _ = found
    try:
        if not all(map(is_law, record["origins"])):
            raise ValueError("it names files elsewhere")
        return Begun(record["configuration"], record["origins"], record["has_start"])
    except (KeyError, TypeError, ValueError) as error:
        raise OutputError(damaged(path, error)) from None


def is_begun(directory):
    """Whether a directory has the checkpoint of a run that has not finished, or was just about to."""
    return (Path(directory) / CHECKPOINT / BEGUN).exists()


class Checkpoint(Journal):
    """Keeps how far the run of `config` has come in DIRECTORY/checkpoint, with the history of `progress`,
    every `seconds` and after each solve. `stop` is asked before every step; it returns None or the
    `Stopped` to raise, once the present position is saved."""

    def __init__(self, directory, config, progress, seconds, stop=lambda: None):
        self._folder, self._progress = Path(directory) / CHECKPOINT, progress
        self._tables, self._seconds, self._stop = portable(config), seconds, stop
        self._solved = 0
        self._saved = time.monotonic()

    def recall(self, grid, made):
        """The end of the next solve where its file is there, else None (collective)."""
        outcome = self._read(grid, self._finished, made)
        self._solved += outcome is not None
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
        self._write(grid, self._finished, outcome)
        self._solved += 1

    @property
    def _finished(self):
        return self._folder / f"solve-{self._solved:04d}.npz"

    def _write(self, grid, path, kept):
        """Write what `kept.record()` has, the arrays gathered."""
        kept = kept.record()
        of_solve = {"solve": self._solved, "progress": self._progress.record(), "values": kept.values}
        arrays = {name: grid.gather(array) for name, array in kept.arrays.items()}
        on_first_rank(grid.comm, save, path, _head(self._tables) | of_solve, arrays)
        self._saved = time.monotonic()

    def _read(self, grid, path, made):
        """What is `made` of a file, if there is one about the next solve; the history goes on."""
        found = on_first_rank(grid.comm, load, path, self._tables)
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


def _head(tables):
    return {"format": FORMAT, "mgehl": VERSION, "configuration": tables}


def scattered(grid, arrays):
    """Every rank's lines of the whole arrays that rank 0 has (collective). Raises ValueError, on all, where
    one is not of this grid."""
    whole = (grid.mesh.ny, grid.mesh.nx)
    shapes = grid.comm.bcast({name: array.shape for name, array in arrays.items()})
    for name, shape in shapes.items():
        if shape[-2:] != whole:
            raise ValueError(f"{name} is not of {whole[1]} x {whole[0]} nodes")
    return {name: grid.scatter(arrays.get(name)) for name in shapes}


def damaged(path, error):
    """The message about a file that raised an `error`."""
    goes_on = "the run cannot go on" if path.name == BEGUN else "the run begins earlier"
    return f"{path}: is damaged, or no checkpoint: {one_line(error)}; without it, {goes_on}"


def load(path, tables=None):
    """(record, arrays) of a file, None where there is none; `tables` are those of the run's configuration.
    Raises OutputError where it is damaged, or of another version or configuration."""
    try:
        record, arrays = unpacked(path)
        version, by = record["format"], record["mgehl"]
    except FileNotFoundError:
        return None
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise OutputError(damaged(path, error)) from None
    if (version, by) != (FORMAT, VERSION):
        raise OutputError(f"{path}: was written by mgehl {by}, and {VERSION} cannot go on with it")
    if tables not in (None, record.get("configuration")):
        raise OutputError(f"{path}: was written for another configuration than the run has now")
    return record, arrays
