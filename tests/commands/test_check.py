"""mgehl check: valid configurations are described, the rest is one line; nothing is solved."""

import re
from pathlib import Path

import pytest

from mgehl.cli import main

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def told(capsys, tmp_path, monkeypatch):
    """Function that checks a shipped configuration and returns what was printed."""
    monkeypatch.chdir(tmp_path)

    def run(name, *words):
        assert main(["check", str(ROOT / "configs" / name), *words]) == 0
        assert not list(tmp_path.iterdir())
        return capsys.readouterr().out

    return run


def number(text, pattern):
    return float(re.search(pattern, text)[1])


def test_a_point_contact_is_described(told):
    text = told("full_film.toml", "--ranks", "2")
    assert "valid, a point contact" in text
    assert number(text, r"Hertz +a ([\d.]+) mm") == pytest.approx(0.4108, rel=1e-3)
    assert number(text, r"p_h ([\d.]+) GPa") == pytest.approx(2.263, rel=1e-3)
    assert number(text, r"hamrock dowson central ([\d.]+)") == pytest.approx(14.74, rel=1e-3)
    assert "elastic piezoviscous" in text
    assert "on 2 ranks" in text and "timed just now" in text


def test_all_physical_input_is_told_and_what_nobody_gave(told, tmp_path, capsys):
    text = told("full_film.toml")
    assert "viscosity 0.096 Pa*s" in text and "reduced_modulus 2.1978e+11 Pa" in text
    assert "not given" not in text
    (tmp_path / "forgot.toml").write_text('[contact]\nload = "30 N"\n[lubricant]\nviscosity = 0.01\n')
    assert main(["check", str(tmp_path / "forgot.toml")]) == 0
    (line,) = (line for line in capsys.readouterr().out.splitlines() if line.startswith("not given"))
    assert "motion.speed" in line and "contact.radius_x" in line and "load" not in line.split()


def test_each_grid_has_its_cells_and_the_grid_that_resolves_is_recommended(told):
    text = told("full_film.toml")
    cells = [float(each) for each in re.findall(r"grid +\d+ +([\d.]+) cells", text)]
    assert len(cells) == 6 and cells[-1] == pytest.approx(2.64, abs=0.01)
    assert "recommended: grid.nodes=2049" in text
    assert "this grid does" in told("full_film.toml", "--set", "grid.nodes=2049")
    assert "no grid up to 16385 does" in told("full_film.toml", "--set", "motion.speed=1e-9")


def test_other_kinds_are_described(told):
    line, wedge = told("line_contact.toml"), told("wedge_square_pillar.toml")
    assert "valid, a line contact" in line and number(line, r"dowson higginson central ([\d.]+)") > 100.0
    assert "20 um at the exit, 50 um at the inlet" in wedge and "no convolutions" in wedge


@pytest.mark.parametrize(
    "words, parts",
    [
        (["missing.toml"], ["missing.toml", "cannot be read"]),
        (["--set", "grid.nodes=66"], ["grid.nodes = 66"]),
        (["--set", "contact.load=1e9"], ["contact.load"]),
        (["--ranks", "0"], ["--ranks 0"]),
    ],
)
def test_what_would_not_run_is_one_line_and_status_2(words, parts, capsys):
    assert main(["check", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and len(err.splitlines()) == 1
    assert all(part in err for part in parts)
