import pytest

from mgehl.studies import case_names
from mgehl.studies.case_names import directory_of, key_of

DESCRIPTION = [{"grid": {"nodes": 65, "x": [-1.9, 1.3]}, "mean": "arithmetic"}, "down", [1.0, 0.7], True]

COMPUTES = ("model/a.py", "kinds/b.py", "solver/deep/c.py", "output/d.py", "run.py", "studies/branch.py")


class TestCode:
    """What other code found is no answer of this one."""

    @pytest.fixture
    def key(self, tmp_path, monkeypatch):
        """A function: the key by a package of such modules, of which one is another if it is named."""
        root = tmp_path / "mgehl"

        def key(changed=""):
            for name in (*COMPUTES, "studies/figures.py"):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(f"x = {int(name == changed)}\n")
            case_names.code.cache_clear()
            return key_of(DESCRIPTION)

        monkeypatch.setattr(case_names, "__file__", str(root / "studies" / "case_names.py"))
        yield key
        case_names.code.cache_clear()

    def test_a_change_of_any_module_that_computes_is_another_key(self, key):
        assert len({key(), *map(key, COMPUTES)}) == 1 + len(COMPUTES)
        assert key("studies/figures.py") == key()


def test_a_case_has_one_directory_whatever_it_is_called(tmp_path):
    first = directory_of(tmp_path, "1B, 65 nodes: R_y/R_x 2 /../", DESCRIPTION)
    assert first.parent == tmp_path and first.name.startswith("1B-65-nodes-R_y-R_x-2-")
    first.mkdir()
    assert directory_of(tmp_path, "another title", DESCRIPTION) == first
    assert directory_of(tmp_path, "another title", [2]).name.startswith("another-title-")
