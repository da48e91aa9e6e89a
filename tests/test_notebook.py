import json
import re
import shutil

import matplotlib.pyplot as plt
import pytest
from places import CONFIGS

CELLS = json.loads((CONFIGS / "first_steps.ipynb").read_text())["cells"]
CODE = ["".join(cell["source"]) for cell in CELLS if cell["cell_type"] == "code"]


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A directory with the case alone. What the notebook keeps goes to a directory beside it."""
    here, kept = tmp_path / "configs", tmp_path / "kept"
    here.mkdir(), kept.mkdir()
    shutil.copy(CONFIGS / "rough.toml", here)
    monkeypatch.chdir(here)
    monkeypatch.setattr("tempfile.tempdir", str(kept))
    return here


def test_its_cells_run_in_their_order_and_leave_nothing_beside_it(place, capsys):
    plt.switch_backend("Agg")
    names = {}
    for number, cell in enumerate(CODE, 1):
        exec(compile(cell, f"code cell {number}", "exec"), names)
    plt.close("all")
    assert [path.name for path in place.iterdir()] == ["rough.toml"]
    said = capsys.readouterr().out
    assert "CONVERGED: " in said and "the same film: True" in said
    slow, fast = sorted(names["gaps"])
    assert names["summary"].mixed.mean_gap_nm < names["gaps"][slow] < names["gaps"][fast]
    assert names["summary"].mixed.contact_load_share > names["loads"][slow] > names["loads"][fast]


def test_it_is_short_and_keeps_no_outputs():
    assert len(CELLS) <= 12
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in CELLS)


def test_its_links_lead_somewhere():
    text = "".join("".join(cell["source"]) for cell in CELLS if cell["cell_type"] == "markdown")
    links = re.findall(r"\]\(([^)#]+)", text)
    assert links and all((CONFIGS / link).exists() for link in links)
