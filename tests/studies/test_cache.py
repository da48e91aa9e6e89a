"""Finished points on disk: whole, or not at all."""

import hashlib
import pickle
from dataclasses import dataclass, replace
from io import BytesIO
from zipfile import ZipFile

import numpy as np
import pytest
from mpi4py import MPI

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


class TestKills:
    def test_a_point_cut_off_at_any_byte_is_missing(self, cache, folder):
        cache.store("a", POINT.record)
        whole = (folder / "a.npz").read_bytes()
        for length in range(len(whole)):
            (folder / "a.npz").write_bytes(whole[:length])
            assert cache.load("a", made) is None
        (folder / "a.npz").write_bytes(whole)
        assert_same(cache.load("a", made), POINT)

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


class Trap:
    """A pickle of it fails the test that opens it."""

    def __reduce__(self):
        return pytest.fail, ("a pickle was opened",)


def pickled_array():
    file = BytesIO()
    np.save(file, np.array([Trap()], dtype=object), allow_pickle=True)
    return file.getvalue()


DESCRIPTION = [{"grid": {"nodes": 65, "x": [-1.9, 1.3]}, "mean": "arithmetic"}, "down", [1.0, 0.7], True]


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
