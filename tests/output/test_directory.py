import json
import os
from pathlib import Path

import h5py
import numpy as np
import pytest
from made_solution import make_result
from mpi4py import MPI
from places import RUN_FILES
from told import counting

from mgehl.config import config_from_tables
from mgehl.errors import OutputError
from mgehl.kinds import contact_from, mesh_from
from mgehl.model.contact import Groups
from mgehl.output.archive import save
from mgehl.output.checkpoint import FORMAT, begin_run
from mgehl.output.directory import check_replaceable, clear_checkpoint, make_directory, prepare_directory
from mgehl.output.files import NAMES, WHOLE
from mgehl.output.finish import finish_run, taken_up
from mgehl.output.result import MoesFilm
from mgehl.output.solution import Fields, Solution
from mgehl.output.stored import read_run
from mgehl.version import VERSION


def make_solution(H0):
    tables = {"contact": {"kind": "line"}, "grid": {"nodes": 65, "x": [-2.0, 1.5]}}
    config = config_from_tables(tables | {"motion": {"speed": -H0}})
    contact = contact_from(config)
    random = np.random.default_rng(int(-100 * H0))
    fields = Fields(random.random((1, 65)), random.random((1, 65)), random.integers(0, 4, (1, 65), np.int8))
    result = make_result(wall_s=-H0, groups=Groups(1.0, 2.0, 3.0, 4.0, 5.0), moes_film=MoesFilm(1.0, 1.0))
    rows = [{"grid": 65, "step": 0, "residual": -H0}]
    return Solution(config, contact, mesh_from(config, contact), fields, rows, result, H0)


SOLUTIONS = {H0: make_solution(H0) for H0 in (-0.25, -0.5)}


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    def drawn(solution):
        return b"picture of %f" % solution.H0

    monkeypatch.setattr("mgehl.output.pictures.figures.run_picture", drawn)


def put(directory, H0, force=False):
    make_directory(directory, force)
    prepare_directory(directory)
    begin_run(directory, SOLUTIONS[H0].config)
    finish_run(MPI.COMM_SELF, directory, SOLUTIONS[H0])
    return directory


def content(directory):
    found = {}
    for path in Path(directory).rglob("*"):
        if path.is_symlink() or not path.is_dir():
            what = os.readlink(path) if path.is_symlink() else path.is_file() and path.read_bytes()
            found[str(path.relative_to(directory))] = what
    return found


def timeless(directory):
    return {name: each for name, each in content(directory).items() if name != "fields.h5"}


@pytest.mark.parametrize("force", [False, True])
def test_a_file_in_its_place_is_refused(tmp_path, force):
    (tmp_path / "file").write_text("mine")
    for path in (tmp_path / "file", tmp_path / "file" / "deep"):
        with pytest.raises(OutputError):
            make_directory(path, force)
    assert (tmp_path / "file").read_text() == "mine"


class TestForeign:
    """What mgehl did not write, --force leaves alone, and says so."""

    def refused(self, directory, laws=()):
        before = content(directory)
        with pytest.raises(OutputError, match="is left alone"):
            prepare_directory(directory, laws)
        assert content(directory) == before

    @pytest.mark.parametrize("name", [*NAMES, "checkpoint/under-way.npz", "checkpoint/solve-0000.npz"])
    def test_a_file_of_a_name_of_ours(self, tmp_path, name):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("mine")
        self.refused(tmp_path)

    def test_what_has_other_names_does_not_matter(self, tmp_path):
        (tmp_path / "checkpoint").mkdir()
        for name in ("notes.txt", "report.html", "checkpoint/epoch-7.pt"):
            (tmp_path / name).write_text("mine")
        before = content(tmp_path)
        put(tmp_path, -0.5, force=True)
        after = content(tmp_path)
        assert after.keys() == before.keys() | RUN_FILES and before.items() <= after.items()

    @pytest.mark.parametrize("name", ["result.json", "fields.h5", "checkpoint", "laws"])
    def test_a_link_is_not_followed(self, tmp_path, name):
        (tmp_path / "there").mkdir()
        (tmp_path / "there" / "under-way.npz").write_text("precious")
        here = put(tmp_path / "here", -0.5)
        (here / name).unlink(missing_ok=True)
        (here / name).symlink_to(tmp_path / "there" / ("under-way.npz" if "." in name else ""))
        self.refused(here)
        assert (tmp_path / "there" / "under-way.npz").read_text() == "precious"

    def test_a_pipe_is_not_replaced(self, tmp_path):
        (put(tmp_path / "run", -0.5) / "picture.png").unlink()
        os.mkfifo(tmp_path / "run" / "picture.png")
        self.refused(tmp_path / "run")

    @pytest.mark.parametrize(
        "name", ["../../precious.txt", "laws/../../precious.txt", "laws/..", "laws/a\0b"]
    )
    def test_a_run_names_nothing_outside(self, tmp_path, name):
        """Whoever made it: neither a configuration nor a checkpoint leads elsewhere."""
        (tmp_path / "precious.txt").write_text("mine")
        here = put(tmp_path / "here", -0.5)
        with h5py.File(here / "fields.h5", "r+") as file:
            texts = json.loads(file[WHOLE][()].tobytes())
            texts |= {name: "", "configuration.toml": f"[surface]\nfile = {json.dumps(name)}\n"}
            del file[WHOLE]
            file[WHOLE] = np.frombuffer(json.dumps(texts).encode(), np.uint8)
        put(here, -0.25, force=True)
        checkpoint = here / "checkpoint"
        record = {"format": FORMAT, "mgehl": VERSION, "configuration": {}}
        save(checkpoint / "begun.npz", record | {"origins": {name: ""}, "has_start": False}, {})
        with pytest.raises(OutputError, match="it names files elsewhere"):
            taken_up(here)
        clear_checkpoint(here)
        assert (tmp_path / "precious.txt").read_text() == "mine" and not checkpoint.exists()

    def test_a_study(self, tmp_path):
        (tmp_path / "study.json").write_text("{}")
        with pytest.raises(OutputError, match="directory of a study"):
            check_replaceable(tmp_path)

    def test_what_came_in_the_way_stays_and_so_does_what_is_finished(self, tmp_path):
        begin_run(tmp_path, SOLUTIONS[-0.5].config)
        (tmp_path / "result.json").write_text("mine")
        with pytest.raises(OutputError, match="is left alone"):
            finish_run(MPI.COMM_SELF, tmp_path, SOLUTIONS[-0.5])
        assert (tmp_path / "result.json").read_text() == "mine" and not (tmp_path / "fields.h5").exists()


class TestPublishing:
    @pytest.mark.parametrize("moved", range(0, 19))
    def test_an_end_in_between_leaves_old_or_new_and_is_made_good(self, tmp_path, monkeypatch, moved):
        """After so many steps."""
        expected = timeless(put(tmp_path / "new", -0.5))
        here = put(tmp_path / "here", -0.25)
        (here / "report.html").write_text('<head><meta name="generator" content="mgehl 0.1.0">')
        steps = iter(range(moved))
        with monkeypatch.context() as change:
            for name in ("replace", "unlink"):
                change.setattr(f"pathlib.Path.{name}", counting(getattr(Path, name), steps))
            with pytest.raises(KeyboardInterrupt):
                put(here, -0.5, force=True)
        assert read_run(here).H0 in (-0.25, -0.5)
        config, _, _ = taken_up(here)
        if config is None:  # the run is over, or has not begun
            clear_checkpoint(here)
        else:
            finish_run(MPI.COMM_SELF, here, SOLUTIONS[-0.5])
        if config is None and read_run(here).H0 == -0.25:
            put(here, -0.5, force=True)
        assert timeless(here) == expected and read_run(here).H0 == -0.5

    def test_a_result_of_the_first_version_is_named(self, tmp_path):
        """Its fields.h5 has no texts."""
        here = put(tmp_path / "here", -0.5)
        with h5py.File(here / "fields.h5", "r+") as file:
            del file["run"]
        with pytest.raises(OutputError, match="it is of mgehl 0.1: solve it anew"):
            read_run(here)


def test_one_that_has_not_finished_says_how_to_go_on(tmp_path):
    begin_run(tmp_path, SOLUTIONS[-0.5].config)
    with pytest.raises(OutputError, match="has not finished: go on with: mgehl run --resume"):
        read_run(tmp_path)
