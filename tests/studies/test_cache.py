"""Finished points on disk: whole, or not at all."""

import hashlib
import pickle
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.errors import OutputError
from mgehl.studies import cache as cache_module
from mgehl.studies.cache import FOLDER, PointCache, key_of


@dataclass
class Point:
    speed: float
    P: np.ndarray | None

    def shared(self):
        return replace(self, P=None)

    def record(self):
        return {"speed": self.speed}, {"P": self.P}


def made(plain, arrays):
    return Point(plain["speed"], arrays["P"])


POINT = Point(0.7, np.arange(12.0).reshape(3, 4) / 7.0)


@pytest.fixture
def cache(tmp_path):
    return PointCache(tmp_path, MPI.COMM_SELF)


@pytest.fixture
def folder(tmp_path):
    return tmp_path / FOLDER


def assert_same(point, other):
    assert point.speed == other.speed
    np.testing.assert_array_equal(point.P, other.P)


class TestPoints:
    def test_a_point_comes_back_as_it_was(self, cache):
        cache.store("a", POINT.record)
        assert_same(cache.load("a", made), POINT)

    def test_points_are_told_apart_by_their_keys(self, cache):
        cache.store("a", POINT.record)
        cache.store("b", replace(POINT, speed=1.0).record)
        assert (cache.load("a", made).speed, cache.load("b", made).speed) == (0.7, 1.0)
        assert cache.load("c", made) is None

    def test_nothing_is_found_before_anything_is_stored(self, cache, folder):
        assert cache.load("a", made) is None
        assert not folder.exists()

    def test_all_points_may_be_forgotten(self, cache, folder):
        cache.clear()
        cache.store("a", POINT.record)
        key = key_of(DESCRIPTION)
        cache.store(key, POINT.record)
        (folder / "precious.txt").touch()
        (folder / f"{'0' * 24}.npz").symlink_to(folder / "precious.txt")
        cache.clear()
        assert cache.load(key, made) is None
        assert {path.name for path in folder.iterdir()} == {"a.npz", "precious.txt", f"{'0' * 24}.npz"}


class TestKills:
    def test_a_point_cut_off_at_any_byte_is_missing(self, cache, folder):
        cache.store("a", POINT.record)
        whole = (folder / "a.npz").read_bytes()
        for length in range(len(whole)):
            (folder / "a.npz").write_bytes(whole[:length])
            assert cache.load("a", made) is None
        (folder / "a.npz").write_bytes(whole)
        assert_same(cache.load("a", made), POINT)

    def test_a_point_of_another_key_is_missing(self, cache, folder):
        cache.store("a", POINT.record)
        (folder / "a.npz").rename(folder / "b.npz")
        assert cache.load("b", made) is None

    def test_a_pickle_is_not_opened(self, cache, folder):
        folder.mkdir()
        stored = pickle.dumps(Trap(), protocol=pickle.HIGHEST_PROTOCOL)
        for content in (stored, hashlib.sha256(stored).digest() + stored):
            (folder / "a.npz").write_bytes(content)
            (folder / "a").write_bytes(content)
            assert cache.load("a", made) is None
        with ZipFile(folder / "a.npz", "w") as archive:
            archive.writestr("record.json", "{}")
            archive.writestr("P.npy", pickled_array())
        assert cache.load("a", made) is None

    @pytest.mark.parametrize("before", [None, 1.0])
    def test_a_kill_before_the_rename_leaves_what_was_there(self, cache, folder, monkeypatch, before):
        """No point, or the one before; the next write is not in the way of what is left."""
        if before:
            cache.store("a", replace(POINT, speed=before).record)
        with monkeypatch.context() as patch:
            patch.setattr("pathlib.Path.replace", self.kill)
            with pytest.raises(KeyboardInterrupt):
                cache.store("a", POINT.record)
        assert (folder / "a.npz").exists() == bool(before)
        found = cache.load("a", made)
        assert found.speed == before if before else found is None
        cache.store("a", POINT.record)
        assert_same(cache.load("a", made), POINT)
        assert [path.name for path in folder.iterdir()] == ["a.npz"]

    def kill(self, *_):
        raise KeyboardInterrupt


class Trap:
    """A pickle of it fails the test that opens it."""

    def __reduce__(self):
        return pytest.fail, ("a pickle was opened",)


def pickled_array():
    file = BytesIO()
    np.save(file, np.array([Trap()], dtype=object), allow_pickle=True)
    return file.getvalue()


DESCRIPTION = [{"grid": {"nodes": 65, "x": [-1.9, 1.3]}, "mean": "arithmetic"}, "down", [1.0, 0.7], True]


class TestKeys:
    def test_equal_descriptions_have_one_key_whatever_the_order_of_their_tables(self):
        again = [{"mean": "arithmetic", "grid": {"x": [-1.9, 1.3], "nodes": 65}}, "down", [1.0, 0.7], True]
        assert key_of(again) == key_of(DESCRIPTION)
        assert key_of(DESCRIPTION).isalnum() and len(key_of(DESCRIPTION)) == 24

    def test_any_value_changes_the_key(self):
        tables, branch, way, jump = DESCRIPTION
        grid = tables["grid"]
        others = [
            [tables | {"grid": grid | {"nodes": 129}}, branch, way, jump],
            [tables | {"grid": grid | {"x": [-1.9, 1.3 + 1e-15]}}, branch, way, jump],
            [tables | {"mean": "harmonic"}, branch, way, jump],
            [tables | {"more": None}, branch, way, jump],
            [{"grid": grid}, branch, way, jump],
            [tables, "up", way, jump],
            [tables, branch, [0.7, 1.0], jump],
            [tables, branch, [1.0], jump],
            [tables, branch, way, False],
        ]
        keys = {key_of(each) for each in (DESCRIPTION, *others)}
        assert len(keys) == 1 + len(others)

    def test_another_version_has_other_keys(self, monkeypatch):
        key = key_of(DESCRIPTION)
        monkeypatch.setattr(cache_module, "VERSION", "0.0.0")
        assert key_of(DESCRIPTION) != key


COMPUTES = ("model/a.py", "kinds/b.py", "solver/deep/c.py", "output/d.py", "run.py", "studies/branch.py")


class TestCode:
    """What other code found is no point of this one."""

    @pytest.fixture
    def key(self, tmp_path, monkeypatch):
        """A function: the key by a package of such modules, of which one is another if it is named."""
        root = tmp_path / "mgehl"

        def key(changed=""):
            for name in (*COMPUTES, "studies/figures.py"):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(f"x = {int(name == changed)}\n")
            cache_module.code.cache_clear()
            return key_of(DESCRIPTION)

        monkeypatch.setattr(cache_module, "__file__", str(root / "studies" / "cache.py"))
        yield key
        cache_module.code.cache_clear()

    def test_a_change_of_any_module_that_computes_is_another_key(self, key):
        assert len({key(), *map(key, COMPUTES)}) == 1 + len(COMPUTES)

    def test_pictures_do_not_count(self, key):
        assert key("studies/figures.py") == key()

    def test_all_of_it_is_there(self):
        root = Path(cache_module.__file__).parents[1]
        assert all(any(root.glob(pattern)) for pattern in cache_module.COMPUTING)


class TestPlacesThatCannotBeWritten:
    """Files in the place of folders, which stop root, too."""

    def one_line(self, cache):
        with pytest.raises(OutputError, match="points.*: cannot be written: ") as caught:
            cache.store("a", POINT.record)
        assert "\n" not in str(caught.value)
        assert cache.load("a", made) is None

    def test_a_directory_that_is_a_file(self, tmp_path):
        (tmp_path / "file").touch()
        self.one_line(PointCache(tmp_path / "file", MPI.COMM_SELF))

    def test_a_folder_of_points_that_is_a_file(self, cache, folder):
        folder.touch()
        self.one_line(cache)

    def test_a_point_that_is_a_folder(self, cache, folder):
        (folder / "a.npz").mkdir(parents=True)
        self.one_line(cache)
