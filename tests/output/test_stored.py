import json
import shutil
from dataclasses import fields, is_dataclass
from math import nan

import h5py
import numpy as np
import pytest
from mpi4py import MPI
from told import refusal

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, UserError
from mgehl.output.checkpoint import begin_run
from mgehl.output.export.export import export
from mgehl.output.files import WHOLE
from mgehl.output.finish import finish_run
from mgehl.output.report.run_report import report
from mgehl.output.stored import read_run
from mgehl.run import run, save, solve
from mgehl.studies.study import PAPER, PAPERS_DOMAIN, papers_grid

KINDS = {
    "point": {"motion": {"speed": 0.5}, "grid": papers_grid(65), "solver": {"start": "film"}},
    "contact": PAPER | {"motion": {"speed": 5e-6}, "grid": papers_grid(65), "solver": {"start": "contact"}},
    "line": {"contact": {"kind": "line"}, "motion": {"speed": 0.3},
             "grid": {"nodes": 129, "x": PAPERS_DOMAIN["x"]}},
    "wedge": {"contact": {"kind": "wedge"}, "grid": {"nodes": 65}},
}  # fmt: skip


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Function: a solution of a kind and the directory it was written to, once for all tests."""
    made = {}

    def make(kind):
        if kind not in made:
            directory = tmp_path_factory.mktemp(kind)
            config = config_from_tables(KINDS[kind])
            made[kind] = solve(config, MPI.COMM_SELF), directory
            begin_run(directory, config)
            finish_run(MPI.COMM_SELF, directory, made[kind][0])
        return made[kind]

    return make


@pytest.fixture
def copy(written, tmp_path):
    return shutil.copytree(written("line")[1], tmp_path / "copy")


def edited(directory, texts=lambda texts: texts, **arrays):
    """The directory with other texts or arrays in its fields.h5: what a forger would do."""
    with h5py.File(directory / "fields.h5", "r+") as file:
        content = texts(json.loads(file[WHOLE][()].tobytes()))
        del file[WHOLE]
        file[WHOLE] = np.frombuffer(json.dumps(content).encode(), np.uint8)
        for name, array in arrays.items():
            del file[name]
            if array is not None:
                file[name] = array
    return directory


def refused(directory):
    text = refusal(read_run, directory, error=OutputError)
    assert str(directory) in text and len(text) < 400
    return text.removeprefix(f"{directory}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_run_is_what_was_written(written, kind):
    solution, directory = written(kind)
    read = read_run(directory)
    assert read.config == solution.config
    for name in ("P", "H", "status"):
        ours, theirs = getattr(read.fields, name), getattr(solution.fields, name)
        assert ours.dtype == theirs.dtype
        np.testing.assert_array_equal(ours, theirs)
    assert read.H0 == solution.H0
    assert read.rows == solution.rows
    assert plain(read.result) == plain(solution.result)
    assert str(read) == str(solution)
    for name in ("x", "y", "film", "pressure", "status"):
        np.testing.assert_array_equal(getattr(read, name), getattr(solution, name))


def plain(value):
    """Lists for tuples: JSON has one kind of sequence."""
    if is_dataclass(value):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    return [plain(each) for each in value] if isinstance(value, list | tuple) else value


@pytest.mark.parametrize("what", [b"", b"\x00\x01\xff\n\xfe", b"[1, 2]", None])
def test_a_file_of_something_else(copy, what):
    (copy / "fields.h5").unlink()
    if what is not None:
        (copy / "fields.h5").write_bytes(what)
    assert "fields.h5" in refused(copy)


def test_a_file_cut_off(copy):
    path = copy / "fields.h5"
    whole = path.read_bytes()
    for share in (0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
        path.write_bytes(whole[: int(share * len(whole))])
        assert path.name in refused(copy)


def test_a_bit_that_changed_is_found_or_does_no_harm(copy, written):
    """Times, units and what lies unused between HDF5's parts are of no matter; all else has a checksum."""
    path, random, found = copy / "fields.h5", np.random.default_rng(4), 0
    whole, known = bytearray(path.read_bytes()), written("line")[0]
    for position in random.integers(0, len(whole), 200):
        whole[position] ^= (bit := 1 << int(random.integers(8)))
        path.write_bytes(whole)
        whole[position] ^= bit
        try:
            read = read_run(copy)
        except OutputError:
            found += 1
            continue
        assert plain(read.result) == plain(known.result) and read.rows == known.rows
        for ours, theirs in zip(read.fields.named.values(), known.fields.named.values(), strict=True):
            np.testing.assert_array_equal(ours, theirs)
    assert found > 60


@pytest.mark.parametrize("name", ["result.json", "history.csv", "configuration.toml"])
def test_the_other_files_are_copies(copy, written, name):
    """Whatever becomes of them, the run is what it was."""
    (copy / name).write_text("{}")
    assert str(read_run(copy)) == str(written("line")[0])
    (copy / name).unlink()
    assert str(read_run(copy)) == str(written("line")[0])


@pytest.mark.parametrize(
    "arrays, part",
    [({"H": None}, "is damaged"),
     ({name: np.ones((3, 129)) for name in ("P", "H", "status")}, "not of 129 x 1 nodes"),
     ({"P": np.full((1, 129), nan)}, "not finite"), ({"H": np.full((1, 129), nan)}, "not finite"),
     ({"status": np.full((1, 129), 9)}, "a status that there is not"),
     ({"status": np.full((1, 129), 0.5)}, "a status that there is not")],
)  # fmt: skip
def test_fields_that_another_program_wrote_are_refused_in_one_line(copy, arrays, part):
    assert part in refused(edited(copy, **arrays))


class TestOwnLaws:
    """Reading a run runs nothing of it."""

    LAW = "def waves(x, y):\n    return 1e-9 + 0.0 * x * y\n\ndef liner(k):\n    return 1.0 + 0.0 * k\n"
    TRAP = "raise SystemExit('the law was run')\n"

    @pytest.fixture
    def laid(self, tmp_path):
        """A run directory with laws that fail where they are run."""
        (tmp_path / "a.py").write_text(self.LAW)
        own = {"surface": f"{tmp_path / 'a.py'}:waves", "deformation": f"{tmp_path / 'a.py'}:liner"}
        tables = {"contact": own, "solver": {"error": False}} | {"grid": papers_grid(65)}
        config = config_from_tables(tables | {"motion": {"speed": 1.0}})
        run(config, self.made(tmp_path), MPI.COMM_SELF)
        return tmp_path / "run"

    def made(self, tmp_path):
        (tmp_path / "run").mkdir()
        return tmp_path / "run"

    def test_nothing_is_run(self, laid):
        (laid / "laws" / "a.py").write_text(self.TRAP)
        edited(laid, lambda texts: texts | {"laws": {}})
        solution = read_run(laid)
        assert solution.film.min() > 0.0 and str(solution) and "a.py:waves" in report(solution, "run")
        export(solution, {each: laid / f"out.{each}" for each in ("nc", "npz", "csv")})
        with pytest.raises(UserError, match="is not run where results are read"):
            _ = solution.contact.roughness

    def test_nor_is_a_course_of_time_which_keeps_its_values(self, tmp_path):
        """A report is made, too, of a run that ends before its first passage."""
        (tmp_path / "a.py").write_text("def load(t):\n    return 50.0 + 5e4 * t\n")
        own = {"contact": {"load": f"{tmp_path / 'a.py'}:load"}, "motion": {"speed": 0.5}}
        time = {"time": {"end": 2e-4, "step": 2e-5}, "grid": {"nodes": 65}}
        run(config_from_tables(own | time), self.made(tmp_path), MPI.COMM_SELF)
        (tmp_path / "run" / "laws" / "a.py").write_text(self.TRAP)
        solution = read_run(tmp_path / "run")
        assert "50 N to 60 N" in report(solution, "run").replace("\u00a0", " ")
        assert solution.config.contact.load.course.value(1e-4) == pytest.approx(55.0)
        save(solution, tmp_path / "again")
        assert read_run(tmp_path / "again").contact.load == pytest.approx(50.0)

    def test_the_directory_knows_no_machine(self, laid, tmp_path):
        for path in laid.rglob("*"):
            if path.is_file():
                assert str(tmp_path).encode() not in path.read_bytes(), path
        assert (laid / "laws" / "a.py").read_text() == self.LAW
