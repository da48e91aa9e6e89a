"""Finished points of a study on disk: what took long is not computed twice, whatever ends a study."""

import hashlib
import json
import os
import pickle
from functools import cache
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.files import on_first_rank
from mgehl.version import VERSION

FOLDER = "points"

COMPUTING = ("model", "discretization", "kinds", "grid", "multigrid", "solver", "run.py",
             "output/domain.py", "output/resolution.py", "output/film_error.py", "output/mixed_result.py",
             "output/result.py",
             "output/surface.py", "output/wedge_result.py",
             "output/solution.py", "studies/branch.py")  # fmt: skip
"""Layers and modules that make a point: one that other code made is computed anew."""

CHECKSUM = hashlib.sha256().digest_size
"""Bytes before a point's own, by which a damaged one is known."""


def key_of(description):
    """Name of a point: a hash of everything its answer depends on, as plain data, and of the code."""
    text = json.dumps([VERSION, code(), description], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


@cache
def code():
    """A hash of what is `COMPUTING`."""
    root, digest = Path(__file__).parents[1], hashlib.sha256()
    for name in COMPUTING:
        path = root / name
        for module in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            digest.update(module.read_bytes())
    return digest.hexdigest()


class PointCache:
    """Points by key in DIRECTORY/points; written and read on rank 0, known to every rank."""

    def __init__(self, directory, comm):
        self._folder, self._comm = Path(directory) / FOLDER, comm

    def load(self, key):
        """The point stored under `key` on rank 0, its `shared()` on the others; None without one."""
        point = self._read(key) if self._comm.rank == 0 else None
        shared = self._comm.bcast(point.shared() if point else None)
        return point or shared

    def store(self, key, point):
        """Put `point` on disk; a kill in between leaves no half of it (collective)."""
        on_first_rank(self._comm, self._write, key, point)

    def clear(self):
        """Forget all points (on the rank that writes)."""
        try:
            for point in self._folder.glob("*"):
                point.unlink()
        except OSError as error:
            raise OutputError(f"{self._folder}: cannot be cleared: {error}") from None

    def _read(self, key):
        """None for a point that is not there, damaged, or of other classes: it is computed anew."""
        try:
            stored = (self._folder / key).read_bytes()
            if hashlib.sha256(stored[CHECKSUM:]).digest() != stored[:CHECKSUM]:
                return None
            return pickle.loads(stored[CHECKSUM:])
        except (OSError, AttributeError, ImportError):
            return None

    def _write(self, key, point):
        unfinished = self._folder / f"{key}.unfinished"
        try:
            self._folder.mkdir(exist_ok=True)
            stored = pickle.dumps(point, protocol=pickle.HIGHEST_PROTOCOL)
            with unfinished.open("wb") as file:
                file.write(hashlib.sha256(stored).digest())
                file.write(stored)
                file.flush()
                os.fsync(file.fileno())
            unfinished.replace(self._folder / key)
        except OSError as error:
            raise OutputError(f"{self._folder}: cannot be written: {error}") from None
