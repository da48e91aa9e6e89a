import os
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from math import inf
from zipfile import ZipFile

import numpy as np
import pytest
from mpi4py import MPI
from told import refusal

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, Stopped
from mgehl.output import checkpoint
from mgehl.output.archive import save
from mgehl.output.checkpoint import load
from mgehl.output.terminal import Silent
from mgehl.run import Watch, solve
from mgehl.solver.record import Kept
from mgehl.studies.study import PAPER

STOPPED = Stopped("told to", 143)
CONFIG = config_from_tables({})
TABLES = CONFIG.as_toml_tables()


@pytest.fixture
def grid(tiny_problem):
    return tiny_problem.grid


@dataclass
class Left(Kept):
    """What a solve leaves; a checkpoint knows nothing of it but its record."""

    P: np.ndarray
    step: int = 5
    reason: str = ""


@pytest.fixture
def left(grid):
    return Left(np.random.default_rng(1).random(grid.shape))


def standing(kept, grid):
    return kept.standing(grid, Left.from_record)


class TestFile:
    RECORD = {"format": checkpoint.FORMAT, "mgehl": checkpoint.VERSION, "configuration": TABLES}
    ARRAYS = {"array0": np.linspace(0.0, 1.0, 12).reshape(3, 4), "array1": np.eye(3, dtype=np.int8)}

    @pytest.fixture
    def path(self, tmp_path):
        path = tmp_path / "folder" / "solve-0000.npz"
        save(path, self.RECORD | {"values": [None, 0.1]}, self.ARRAYS)
        return path

    def refused(self, path):
        text = refusal(load, path, TABLES, error=OutputError)
        assert text.startswith(f"{path}: ")
        return text

    def test_cut_off_anywhere(self, path):
        whole = path.read_bytes()
        for length in range(len(whole)):
            path.write_bytes(whole[:length])
            assert "damaged" in self.refused(path)

    def test_a_byte_changed_anywhere_is_refused_or_does_no_harm(self, path):
        """Dates and the like of the zip format are of no matter, all else has a checksum."""
        whole = bytearray(path.read_bytes())
        refused = 0
        for position in range(len(whole)):
            for flipped in (0xFF, 0x01):
                whole[position] ^= flipped
                path.write_bytes(whole)
                whole[position] ^= flipped
                try:
                    record, arrays = load(path, TABLES)
                except OutputError as error:
                    refused += 1
                    assert "\n" not in str(error)
                else:
                    assert record["values"] == [None, 0.1]
                    for name, array in arrays.items():
                        np.testing.assert_array_equal(array, self.ARRAYS[name])
        assert refused > len(whole)

    @pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, partial(os.symlink, "/dev/zero")])
    def test_what_is_no_plain_file(self, path, make):
        """It may have no end."""
        path.unlink()
        make(path)
        assert "it is no plain file" in self.refused(path)

    def test_nothing_is_unpickled(self, path):
        with ZipFile(path, "a") as archive, archive.open("array2.npy", "w") as member:
            np.lib.format.write_array(member, np.array([print], dtype=object))
        assert "allow_pickle=False" in self.refused(path)


FILM = {"motion": {"speed": 0.5}, "solver": {"start": "film"}}
CASES = {
    "film": FILM,
    "film on two grids": FILM | {"grid": {"nodes": 129}},
    "film that Eq. 2 is tried on": PAPER | {"motion": {"speed": 0.12}, "solver": {"start": "film"}},
    "contact": PAPER | {"motion": {"speed": 5e-6}, "solver": {"start": "contact"}},
    "contact and film": PAPER | {"motion": {"speed": 5e-4}, "solver": {"start": "contact"}},
    # Five solves: a film by the logarithmic mean, the turn to the geometric one, a step in speed that fails
    # within twelve Newton steps, and twice a half of it.
    "geometric mean": {
        "motion": {"speed": 1.6},
        "discretization": {"face_mobility": "geometric"},
        "solver": {"start": "film", "max_steps": 12},
    },
    "relaxation": FILM
    | {"solver": {"start": "film", "method": "relaxation"}, "relaxation": {"max_sweeps": 12}},
    "line": FILM | {"contact": {"kind": "line"}, "motion": {"speed": 0.3}, "grid": {"nodes": 257}},
}


class Counting(Silent):
    told = 0

    def row(self, row, left=None):
        self.told += 1


class TestStoppedAtEveryStep:
    """Each part of the run makes one step, is stopped before the next and taken up from disk."""

    @pytest.mark.parametrize("name", CASES)
    def test_it_ends_as_one_that_was_never_stopped(self, name, tmp_path):
        config = config_from_tables({"grid": {"nodes": 65}} | CASES[name])
        counting = Counting()
        plain = solve(config, MPI.COMM_SELF, Watch(counting))
        parted, stops = self.in_parts(config, tmp_path)
        # A stop before each step but the first of all, those for the bands too; the last row of a sweep's
        # history is no step.
        steps = plain.result.work.steps if name == "relaxation" else counting.told - 1
        assert stops in (steps, steps - 1)
        for field in ("P", "H", "status"):
            np.testing.assert_array_equal(getattr(parted.fields, field), getattr(plain.fields, field))
        assert parted.H0 == plain.H0
        assert self.timeless(parted.rows) == self.timeless(plain.rows)
        assert parted.result.work.convolutions == pytest.approx(plain.result.work.convolutions, rel=1e-12)
        error, other = parted.result.error, plain.result.error
        assert error.convolutions == pytest.approx(other.convolutions, abs=1e-9)
        assert replace(error, convolutions=0.0) == replace(other, convolutions=0.0)
        untimed = {"wall_s": 0.0, "work": None, "error": None}
        assert replace(parted.result, **untimed) == replace(plain.result, **untimed)

    def in_parts(self, config, directory):
        """The `Solution`, and how often the run was stopped."""
        stops = 0
        while True:
            asked = count()
            how = {"directory": directory, "save_every": inf}
            how["stop"] = lambda asked=asked: STOPPED if next(asked) == 1 else None
            try:
                return solve(config, MPI.COMM_SELF, Watch(**how)), stops
            except Stopped:
                stops += 1

    def timeless(self, rows):
        return [
            {key: value for key, value in row.items() if key != "seconds"}
            | {"convolutions": round(row["convolutions"], 9)}
            for row in rows
        ]
