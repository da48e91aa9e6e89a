"""Finished points of a study on disk: whatever ends a study, they are not computed twice."""

import hashlib
import json
import re
from functools import cache
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.archive import save, unpacked
from mgehl.output.files import on_first_rank
from mgehl.output.whole_file import clear_parts, is_folder, is_plain
from mgehl.version import VERSION

FOLDER = "points"

COMPUTING = (
    *(f"{layer}/**/*.py" for layer in ("model", "discretization", "kinds", "grid", "multigrid", "solver")),
    *("output/*.py", "run.py", "studies/branch.py"),
)
"""Modules that make a point: after a change in one of them points are computed anew."""

_POINT = re.compile(r"[0-9a-f]{24}\.npz")


def key_of(description):
    """Name of a point: a hash of everything its answer depends on, as plain data, and of the code."""
    text = json.dumps([VERSION, code(), description], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


@cache
def code():
    """A hash of what is `COMPUTING`."""
    root, digest = Path(__file__).parents[1], hashlib.sha256()
    for pattern in COMPUTING:
        for module in sorted(root.glob(pattern)):
            digest.update(module.read_bytes())
    return digest.hexdigest()


class PointCache:
    """Points by key in DIRECTORY/points; written and read on rank 0, known to every rank.

    A point is plain data and arrays (`output.archive`): reading one runs nothing.
    """

    def __init__(self, directory, comm):
        self._folder, self._comm = Path(directory) / FOLDER, comm

    def load(self, key, made):
        """What is `made(plain, arrays)` of the point under `key` on rank 0, its `shared()` on the others.

        None where there is none, where it is damaged, or not of this key: it is computed anew.
        """
        point = self._read(key, made) if self._comm.rank == 0 else None
        shared = self._comm.bcast(point.shared() if point else None)
        return point or shared

    def store(self, key, record):
        """Put a point's `record()`, (plain, arrays) on rank 0, on disk; a kill leaves no half of it.

        Collective.
        """
        on_first_rank(self._comm, self._write, key, record)

    def clear(self):
        """Forget all points, and nothing else that lies there (on the rank that writes)."""
        if not is_folder(self._folder):
            return
        clear_parts(self._folder)
        try:
            for path in self._folder.iterdir():
                if _POINT.fullmatch(path.name) and is_plain(path):
                    path.unlink()
        except OSError as error:
            raise OutputError(f"{self._folder}: cannot be cleared: {error}") from None

    def _read(self, key, made):
        try:
            record, arrays = unpacked(self._folder / f"{key}.npz")
            return made(record["point"], arrays) if record["key"] == key else None
        except Exception:  # there is none, or it is damaged: what that raises is anybody's guess
            return None

    def _write(self, key, record):
        plain, arrays = record()
        save(self._folder / f"{key}.npz", {"key": key, "point": plain}, arrays)
