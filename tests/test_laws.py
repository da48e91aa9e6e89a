import os
from math import pi
from pathlib import Path

import numpy as np
import pytest
from places import CONFIGS, content_of

import mgehl
from mgehl.cli import main
from mgehl.config import load_config
from mgehl.model.hertz import hertz_contact
from mgehl.output.stored import read_run

A = 0.4108e-3
"""Hertz radius of the paper's ball in m."""

LAWS = """
import numpy as np

def barus(at):
    p, viscosity, pressure_viscosity = at.pressure, at.viscosity, at.pressure_viscosity
    eta = viscosity * np.exp(pressure_viscosity * p)
    return eta, pressure_viscosity * eta


def steeper(at):
    eta = at.viscosity * np.exp(1.2 * at.pressure_viscosity * at.pressure)
    return eta, 1.2 * at.pressure_viscosity * eta

def dowson_higginson(at):
    p = at.pressure
    return 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p), 0.6e-9 / (1.0 + 1.7e-9 * p) ** 2

def flat(x, y):
    return 0.0 * x * y

def nowhere(x, y):
    return x * np.nan


"""


@pytest.fixture
def laws(tmp_path):
    path = tmp_path / "laws.py"
    path.write_text(LAWS)
    return path


REFUSED = {
    "lubricant.viscosity_law=laws.py:steeper": "d ln(eta)/dp at p = 0 is 2.184e-08 1/Pa; must be ",
    "lubricant.density_law=laws.py:none": "the file has no function none",
    "contact.surface=laws.py:nowhere": "must be a height in m of at most 0.000411",
    "contact.surface=pipe.py:flat": "cannot be read: is no file",
    "contact.surface=laws.txt:flat": "must be FILE.py:FUNCTION",
    "lubricant.viscosity_law=newton": "must be one of barus, roelands, constant, FILE.py:FUNCTION",
}


@pytest.mark.parametrize("setting, words", REFUSED.items(), ids=REFUSED)
def test_what_cannot_be_used_is_one_line_and_nothing_is_written(laws, setting, words, monkeypatch, capsys):
    monkeypatch.chdir(laws.parent)
    os.mkfifo("pipe.py")
    assert main(["run", "--set", "grid.nodes=65", "--set", setting, "--out", "here"]) == 2
    out, err = capsys.readouterr()
    key, _, value = setting.partition("=")
    assert out == "" and err.count("\n") == 1 and words in err
    assert err.startswith(f"mgehl: {key} = '") and value in err
    assert not Path("here").exists()


TURNS = """
import numpy as np
calls = 0

def law(at):
    global calls
    calls += 1
    p = at.pressure
    value, slope = 1.0 + 1e-10 * p, 1e-10 + 0.0 * p
    return (value, slope) if calls < FIRST else (BAD)
"""
"""A law that is one until it is asked the FIRST time too often."""


class TestALawThatTurnsLate:
    """It is one where it is checked, and none in the middle of a run."""

    WORDS = ["run", "--set", "grid.nodes=65", "--set", "motion.speed=0.5", "--set", "solver.start=film",
             "--set", "lubricant.density_law=late.py:law", "--quiet", "--out", "here"]  # fmt: skip

    @pytest.mark.parametrize("first", [6, 12, 18])
    @pytest.mark.parametrize(
        "bad, words",
        [
            ("value * np.nan, slope", "returns nan at "), ("value / 0.0, slope", "returns inf at "),
            ("-value, slope", "returns -1"), ("value, slope * np.nan", "its derivative is nan at "),
        ],
        ids=["nan", "inf", "negative", "derivative"],
    )  # fmt: skip
    def test_is_one_line_with_its_key(self, tmp_path, monkeypatch, capsys, bad, words, first):
        (tmp_path / "late.py").write_text(TURNS.replace("BAD", bad).replace("FIRST", str(first)))
        monkeypatch.chdir(tmp_path)
        assert main(self.WORDS) == 2
        err = capsys.readouterr().err
        assert err.startswith(f"mgehl: lubricant.density_law = '{tmp_path}/late.py:law': ") and words in err
        assert err.count("\n") == 1 and not Path("here/result.json").exists()

    def test_loses_nothing(self, tmp_path, monkeypatch, capsys):
        """What was there stays; a run that had begun goes on when the law is one again."""
        first = f"18 or not os.path.exists({str(tmp_path / 'broken')!r})"
        text = TURNS.replace("BAD", "value * np.nan, slope").replace("FIRST", first)
        (tmp_path / "late.py").write_text(f"import os\n{text}")
        (tmp_path / "broken").touch()
        monkeypatch.chdir(tmp_path)
        assert main(["run", "--set", "contact.kind=wedge", "--set", "grid.nodes=65", "--out", "here"]) == 0
        before = content_of("here")
        assert main([*self.WORDS, "--force", "--save-every", "1e-9"]) == 2
        assert content_of("here") == before and read_run("here").result.converged
        (tmp_path / "broken").unlink()
        assert main(["run", "--resume", "here", "--quiet"]) == 0
        assert read_run("here").config.motion.speed == 0.5


def test_a_run_with_own_laws_runs_again_from_its_configuration(laws, monkeypatch, tmp_path):
    """Paths of a file are counted from the file, those of --set from here; the run keeps a copy."""
    (tmp_path / "mine.toml").write_text(
        '[lubricant]\nviscosity_law = "laws.py:barus"\n[motion]\nspeed = 1.0\n[grid]\nnodes = 65\n'
    )
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    setting = "lubricant.density_law=../laws.py:dowson_higginson"
    assert main(["run", "../mine.toml", "--set", setting, "--out", "first", "--quiet"]) == 0
    monkeypatch.chdir(tmp_path)
    written = load_config("elsewhere/first/configuration.toml").lubricant
    copy = elsewhere / "first" / "laws" / "laws.py"
    assert copy.read_bytes() == laws.read_bytes()
    assert written.viscosity_law == f"{copy}:barus"
    assert written.density_law == f"{copy}:dowson_higginson"
    assert main(["run", "elsewhere/first/configuration.toml", "--out", "second", "--quiet"]) == 0
    first, second = read_run("elsewhere/first"), read_run("second")
    np.testing.assert_array_equal(first.film, second.film)
    laws.unlink()  # what is done can be looked at without
    assert read_run("second").summary.converged


def test_waves_on_the_surface_show_in_the_film(laws):
    """Nothing solid where the film is thicker than they are high, and their wavelength in the film."""
    flat = {"contact.surface": f"{laws}:flat"}
    configs = (mgehl.load(CONFIGS / "wavy.toml", {"grid.nodes": 129} | more) for more in (flat, {}))
    smooth, wavy = map(mgehl.solve, configs)
    assert smooth.summary.converged and wavy.summary.converged and wavy.summary.contact.nodes == 0
    j = np.abs(wavy.y).argmin()
    inside = np.abs(wavy.x) < 0.8 * wavy.contact.hertz.a
    x = wavy.x[inside]
    wave = np.exp(2j * pi * x / 60e-6)
    ripple = (wavy.film - smooth.film)[j, inside]
    amplitude = 2.0 * np.abs(np.mean((ripple - ripple.mean()) * wave))
    # Elastic flattening leaves part of the 15 nm in the film, the rest goes into the pressure.
    # On 513 nodes it is 0.9845 nm.
    assert amplitude == pytest.approx(0.9845e-9, rel=0.005)
    swing = np.ptp((wavy.pressure - smooth.pressure)[j, inside])
    assert swing > 0.02 * wavy.contact.hertz.p_h


@pytest.mark.parametrize("thickness", [1e-3, 30.0], ids=["thin", "thick"])
@pytest.mark.parametrize("modulus", [50e9, 800e9], ids=["soft", "hard"])
def test_a_dry_coated_contact_tends_to_hertz(modulus, thickness):
    """To that of the bare bodies, or of a body of the coating's material and the other one."""
    bare = 2.0 * 0.91 / 200e9
    layer = bare if thickness < 1.0 else 0.91 / 200e9 + 0.91 / modulus
    hertz = hertz_contact(800.0, 12.7e-3, 12.7e-3, 2.0 / layer)
    settings = {
        "grid.nodes": 129, "grid.x": [-2.8, 1.8], "grid.y": [-2.2, 2.2], "motion.speed": 1e-9,
        "contact.deformation": "coated", "coating.modulus": modulus, "coating.thickness": thickness * A,
        "solver.start": "contact",
    }  # fmt: skip
    solution = mgehl.solve(mgehl.load(os.devnull, settings))
    summary = solution.summary
    assert summary.converged
    assert summary.max_pressure_GPa == pytest.approx(1e-9 * hertz.p_h, rel=0.01)
    radius = np.sqrt(summary.contact.area_fraction) * solution.contact.hertz.a
    assert radius == pytest.approx(hertz.a, rel=0.01)
