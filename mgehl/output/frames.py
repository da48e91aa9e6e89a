"""Pressure, film and status of some instants of a run in time: frames.nc, CF."""

from dataclasses import dataclass

import h5netcdf
import numpy as np

from mgehl.output.archive import save, unpacked
from mgehl.output.files import FURTHER
from mgehl.output.netcdf import PLANES, flags, netcdf_file, put
from mgehl.output.whole_file import whole_file

MEANINGS = PLANES | FURTHER
"""Unit and meaning of what a frame may have; what older runs and smooth bodies do not have is left out."""


@dataclass
class Frames:
    """Fields of some instants, on rank 0: kept in a folder until the end, or in memory without one."""

    every: float
    """Seconds from one to the next."""
    folder: object = None

    def __post_init__(self):
        self._kept = {}

    def is_due(self, t, step):
        """Whether the fields of this instant are to be kept: the first ones, and from time to time."""
        number = self._number(t)
        return t <= step or number != self._number(max(t - step, 0.0))

    def _number(self, t):
        return int(t / self.every * (1.0 + 1e-9))

    def take(self, t, fields):
        """Keep {name: (ny, nx)}. Raises OutputError."""
        if self.folder is None:
            self._kept[self._number(t)] = (t, fields)
            return
        save(self.folder / f"frame-{self._number(t):06d}.npz", {"t": float(t)}, fields)

    def all(self):
        """(Time, {name: array}) of the instants, in order."""
        if self.folder is None:
            yield from (self._kept[number] for number in sorted(self._kept))
            return
        for path in sorted(self.folder.glob("frame-*.npz")):
            record, fields = unpacked(path)
            yield record["t"], fields


@dataclass
class StoredFrames:
    """The frames of a finished run, in its frames.nc."""

    path: object

    def all(self):
        """(Time, {name: array}) of the instants, in order."""
        with h5netcdf.File(self.path, "r") as file:
            for number, t in enumerate(file["time"][:]):
                yield float(t), {name: file[name][number] for name in MEANINGS if name in file}


def write_frames(path, frames, x, y, title):
    """frames.nc of (time, {name: (ny, nx)}) in order, with x and y in m. Raises OSError."""
    frames = list(frames)
    with whole_file(path) as part, netcdf_file(part, title) as file:
        file.dimensions = {"time": len(frames), "y": len(y), "x": len(x)}
        put(
            file, "time", ("time",), np.array([t for t, _ in frames]), units="s", long_name="time", axis="T"
        )
        put(file, "x", ("x",), x, units="m", long_name="distance along x", axis="X")
        put(file, "y", ("y",), y, units="m", long_name="distance along y", axis="Y")
        packed = {"chunks": (1, len(y), len(x)), "compression": "gzip", "compression_opts": 1}
        for name in frames[0][1] if frames else ():
            values, (unit, meaning) = np.stack([fields[name] for _, fields in frames]), MEANINGS[name]
            told = flags(is_dry=False) if name == "status" else {}
            put(file, name, ("time", "y", "x"), values, packed, units=unit, long_name=meaning, **told)
