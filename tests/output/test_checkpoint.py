"""A run's way on disk: what is kept comes back, what is damaged is refused, nothing is lost on the way."""

import json
import os
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from math import inf
from zipfile import ZipFile

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, Stopped
from mgehl.output import checkpoint
from mgehl.output.archive import save
from mgehl.output.checkpoint import UNDER_WAY, Checkpoint, begin_run, load, read_begun
from mgehl.output.directory import clear_checkpoint
from mgehl.output.terminal import Silent
from mgehl.run import Watch, solve
from mgehl.solver.record import Kept
from mgehl.studies.study import papers_grid

STOPPED = Stopped("told to", 143)
CONFIG = config_from_tables({})
TABLES = CONFIG.as_toml_tables()


class History:
    """What a checkpoint needs of a `Progress`."""

    def __init__(self, steps=0):
        self.steps = steps

    def record(self):
        return {"steps": self.steps}

    def go_on(self, record):
        self.steps = record["steps"]


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


def recalled(kept, grid):
    return kept.recall(grid, Left.from_record)


def standing(kept, grid):
    return kept.standing(grid, Left.from_record)


class TestKeeping:
    def make(self, directory, seconds=inf, stop=lambda: None, steps=0, config=CONFIG):
        return Checkpoint(directory, config, History(steps), seconds, stop)

    def names(self, directory):
        return sorted(path.name for path in (directory / "checkpoint").glob("*"))

    def test_nothing_is_known_of_a_new_run(self, tmp_path, grid):
        kept = self.make(tmp_path)
        assert recalled(kept, grid) is None and standing(kept, grid) is None

    def test_a_position_is_saved_when_it_is_time(self, tmp_path, grid, left):
        self.make(tmp_path, seconds=inf).step(grid, left)
        assert self.names(tmp_path) == []
        self.make(tmp_path, seconds=0.0, steps=7).step(grid, left)
        assert self.names(tmp_path) == [UNDER_WAY]
        again = self.make(tmp_path)
        back = standing(again, grid)
        np.testing.assert_array_equal(back.P, left.P)
        assert back.step == 5 and again._progress.steps == 7

    def test_it_stops_when_all_is_saved(self, tmp_path, grid, left):
        with pytest.raises(Stopped) as stopped:
            self.make(tmp_path, stop=lambda: STOPPED).step(grid, left)
        assert (str(stopped.value), stopped.value.status) == ("told to", 143)
        assert standing(self.make(tmp_path), grid).step == 5

    def test_finished_solves_are_recalled_in_order(self, tmp_path, grid, left):
        kept = self.make(tmp_path)
        for reason in ("first", "second"):
            kept.finish(grid, replace(left, reason=reason))
        assert self.names(tmp_path) == ["solve-0000.npz", "solve-0001.npz"]
        again = self.make(tmp_path)
        assert [recalled(again, grid).reason for _ in range(2)] == ["first", "second"]
        assert recalled(again, grid) is None
        again.finish(grid, replace(left, reason="third"))
        assert self.names(tmp_path)[-1] == "solve-0002.npz"

    def test_what_was_under_way_is_behind_once_its_solve_is_finished(self, tmp_path, grid, left):
        """A kill may leave both."""
        kept = self.make(tmp_path, seconds=0.0, steps=3)
        kept.step(grid, left)
        kept.finish(grid, left)
        again = self.make(tmp_path)
        assert standing(again, grid).step == 5
        assert recalled(again, grid) is not None
        assert standing(again, grid) is None

    @pytest.mark.parametrize("dtype", [float, np.int8, bool])
    def test_arrays_are_of_their_type_and_no_views(self, tmp_path, grid, left, dtype):
        array = left.P > 0.5 if dtype is bool else (100.0 * left.P).astype(dtype)
        self.make(tmp_path).finish(grid, Left(array))
        back = recalled(self.make(tmp_path), grid).P
        assert back.dtype == dtype and back.flags.writeable
        np.testing.assert_array_equal(back, array)

    def test_a_file_names_what_it_keeps(self, tmp_path, grid, left):
        """Whoever opens it needs no class of ours."""
        self.make(tmp_path, seconds=0.0).step(grid, left)
        with np.load(tmp_path / "checkpoint" / UNDER_WAY) as file:
            np.testing.assert_array_equal(file["P"], left.P)
            record = json.loads(file["record"].tobytes())
        assert record["values"] == {"step": 5, "reason": ""}
        assert record["configuration"]["motion"]["speed"] == CONFIG.motion.speed

    def test_another_configuration_is_refused(self, tmp_path, grid, left):
        self.make(tmp_path, seconds=0.0).step(grid, left)
        other = self.make(tmp_path, config=config_from_tables({"motion": {"speed": 2.0}}))
        with pytest.raises(OutputError, match="another configuration"):
            standing(other, grid)

    def test_names_of_something_else_are_refused(self, tmp_path, grid, left):
        @dataclass
        class Other(Kept):
            H: np.ndarray

        self.make(tmp_path, seconds=0.0).step(grid, Other(left.P))
        with pytest.raises(OutputError, match="is damaged, or no checkpoint: .*'H'"):
            standing(self.make(tmp_path), grid)

    def test_arrays_of_another_grid_are_refused(self, tmp_path, grid, left, make_hierarchy, paper_contact):
        self.make(tmp_path, seconds=0.0).step(grid, left)
        other = make_hierarchy(paper_contact(), nodes=17, coarsest=9).grids[-1]
        with pytest.raises(OutputError, match="P is not of 17 x 17 nodes"):
            standing(self.make(tmp_path), other)

    def test_it_is_cleared_with_all_that_is_in_it(self, tmp_path, grid, left):
        begin_run(tmp_path, CONFIG)
        self.make(tmp_path, seconds=0.0).step(grid, left)
        clear_checkpoint(tmp_path)
        clear_checkpoint(tmp_path)
        assert not list(tmp_path.iterdir())


def test_what_is_solved_reads_back(tmp_path):
    """Laws and the run that was started from, byte by byte; the first that begins is kept."""
    (tmp_path / "a.py").write_bytes(b"law")
    (tmp_path / "fields.h5").write_bytes(b"\x00fields")
    config = config_from_tables({"lubricant": {"density_law": f"{tmp_path / 'a.py'}:law"}})
    assert read_begun(tmp_path / "run") is None
    (tmp_path / "run").mkdir()
    begin_run(tmp_path / "run", config, tmp_path)
    begin_run(tmp_path / "run", CONFIG)
    begun = read_begun(tmp_path / "run")
    assert begun.tables["lubricant"]["density_law"] == "laws/a.py:law"
    assert (begun.laws, begun.origins) == ({"laws/a.py": b"law"}, {"laws/a.py": "../a.py"})
    assert begun.start == b"\x00fields"


class TestFile:
    """`save` and `load`."""

    RECORD = {
        "format": checkpoint.FORMAT,
        "mgehl": checkpoint.VERSION,
        "configuration": TABLES,
    }
    ARRAYS = {"array0": np.linspace(0.0, 1.0, 12).reshape(3, 4), "array1": np.eye(3, dtype=np.int8)}

    @pytest.fixture
    def path(self, tmp_path):
        path = tmp_path / "folder" / "solve-0000.npz"
        save(path, self.RECORD | {"values": [None, 0.1]}, self.ARRAYS)
        return path

    def refused(self, path):
        with pytest.raises(OutputError) as error:
            load(path, TABLES)
        text = str(error.value)
        assert text.startswith(f"{path}: ") and "\n" not in text
        return text

    def test_it_reads_back(self, path):
        record, arrays = load(path, TABLES)
        assert record["values"] == [None, 0.1]
        assert arrays.keys() == self.ARRAYS.keys()
        for name, array in arrays.items():
            assert array.dtype == self.ARRAYS[name].dtype
            np.testing.assert_array_equal(array, self.ARRAYS[name])

    def test_one_that_is_not_there_is_none(self, tmp_path):
        assert load(tmp_path / "solve-0000.npz", TABLES) is None

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

    @pytest.mark.parametrize("name, value", [("VERSION", "99.0"), ("FORMAT", checkpoint.FORMAT + 1)])
    def test_another_version(self, path, monkeypatch, name, value):
        monkeypatch.setattr(checkpoint, name, value)
        assert f"written by mgehl {self.RECORD['mgehl']}, and " in self.refused(path)

    def test_foreign_files(self, path):
        for write in (
            lambda: np.savez(path, a=np.eye(3)),
            lambda: np.savez(path, record=np.array([{"a": 1}], dtype=object)),
            lambda: np.save(path.open("wb"), np.eye(3)),
            lambda: path.write_text("no archive\nat all"),
            lambda: path.write_bytes(b""),
            *(partial(self.put, path, text) for text in ("[]", "3", "null", '"text"', "{", "{}")),
        ):
            write()
            assert "no checkpoint" in self.refused(path)

    def put(self, path, record):
        np.savez(path, record=np.frombuffer(record.encode(), np.uint8))

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

    def test_a_file_in_place_of_the_folder(self, tmp_path):
        (tmp_path / "checkpoint").write_text("mine")
        with pytest.raises(OutputError, match="cannot be written"):
            save(tmp_path / "checkpoint" / UNDER_WAY, self.RECORD, self.ARRAYS)
        assert (tmp_path / "checkpoint").read_text() == "mine"

    def test_a_failure_leaves_the_one_before(self, path):
        before = path.read_bytes()
        with pytest.raises(ValueError):
            save(path, self.RECORD, {"array0": np.array([print], dtype=object)})
        assert path.read_bytes() == before
        assert [each.name for each in path.parent.iterdir()] == [path.name]


FILM = {"motion": {"speed": 0.5}, "solver": {"start": "film"}}
CASES = {
    "film": FILM,
    "film on two grids": FILM | {"grid": {"nodes": 129}},
    "film that Eq. 2 is tried on": {"motion": {"speed": 0.12}, "solver": {"start": "film"}},
    "contact": {"motion": {"speed": 5e-6}, "solver": {"start": "contact"}},
    "contact and film": {"motion": {"speed": 5e-4}, "solver": {"start": "contact"}},
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
    """Counts the cycles that it is told of."""

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
            watch = Watch(
                directory=directory,
                save_every=inf,
                stop=lambda asked=asked: STOPPED if next(asked) == 1 else None,
            )
            try:
                return solve(config, MPI.COMM_SELF, watch), stops
            except Stopped:
                stops += 1

    def timeless(self, rows):
        """The rows without seconds, sums of convolutions to rounding."""
        return [
            {key: value for key, value in row.items() if key != "seconds"}
            | {"convolutions": round(row["convolutions"], 9)}
            for row in rows
        ]


def test_seconds_go_on_where_they_were(tmp_path):
    """Of all parts, and not of the time between them."""
    config = config_from_tables({"grid": papers_grid(65)} | FILM)
    asked = count()
    with pytest.raises(Stopped):
        solve(
            config,
            MPI.COMM_SELF,
            Watch(directory=tmp_path, stop=lambda: STOPPED if next(asked) == 3 else None),
        )
    path = tmp_path / "checkpoint" / UNDER_WAY
    record, arrays = load(path, config.as_toml_tables())
    record["progress"]["seconds"] += 1000.0
    save(path, record, arrays)
    solution = solve(config, MPI.COMM_SELF, Watch(directory=tmp_path))
    seconds = [row["seconds"] for row in solution.rows]
    assert seconds == sorted(seconds) and seconds[2] < 900.0 < 1000.0 < seconds[3]
    assert 1000.0 < solution.result.wall_s < 1900.0
