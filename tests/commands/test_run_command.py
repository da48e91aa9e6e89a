import json
import tomllib

import pytest

from mgehl.cli import main
from mgehl.config import load_config
from mgehl.config_file import chosen_config, default_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.forecast import effort_of
from mgehl.output.stored import read_run

FILM = ["run", "--set", "grid.nodes=65", "--set", "motion.speed=3", "--set", "solver.start=film"]


@pytest.fixture
def run(tmp_path, capsys):
    """Function: result.json, configuration.toml and the words of a run with some more options."""

    def make(*options):
        here = tmp_path / "run"
        assert main([*FILM, "--out", str(here), "--force", *options]) == 0
        result = json.loads((here / "result.json").read_text())
        config = tomllib.loads((here / "configuration.toml").read_text())
        return result, config, capsys.readouterr().out

    return make


def test_a_film_is_said_with_its_band(run):
    result, config, words = run()
    assert config["solver"]["error"] is True
    assert result["error"]["central_nm"] > 0.0 and len(str(result["central_film_nm"])) > 8
    (line,) = [line for line in words.splitlines() if line.startswith("  central film")]
    assert line.count(" ± ") == 2
    assert "  bands: from the differences to 33 nodes" in words


def test_no_error_saves_it(run):
    result, config, words = run("--no-error")
    assert config["solver"]["error"] is False
    assert result["error"]["central_nm"] is None and result["error"]["convolutions"] == 0.0
    assert "±" not in words and "no band: not asked for" in words


class TestWithoutAConfiguration:
    @pytest.fixture(autouse=True)
    def unbroken(self, empty_directory, monkeypatch):
        monkeypatch.delenv("COLUMNS", raising=False)

    def test_the_rough_ball_converges_with_contact_in_its_film(self, tmp_path, capsys):
        """What `make run` shows: README has its picture."""
        assert main(["run"]) == 0
        words = capsys.readouterr().out
        assert f"no configuration named: solving {chosen_config()}\n" in words
        assert "contact carries" in words
        result = json.loads((tmp_path / "runs" / "rough" / "result.json").read_text())
        mixed = result["mixed"]
        assert 0.304 < result["contact"]["load_fraction"] < 0.309
        assert mixed["patches"] in (12, 13) and 0.032 < mixed["lambda_ratio"] < 0.034
        taken = result["work"]["convolutions"] + result["error"]["convolutions"]
        config = load_config(chosen_config())
        contact = contact_from(config)
        foretold = effort_of(config, contact, mesh_from(config, contact)).convolutions
        assert 0.5 < taken / foretold < 2.0

    def test_settings_alone_change_the_papers_ball_and_that_is_said(self, tmp_path, capsys):
        assert main(FILM) == 0
        words = capsys.readouterr().out
        assert f"no configuration named: solving {default_config()}, changed by --set\n" in words
        config = tomllib.loads((tmp_path / "runs" / "point_contact" / "configuration.toml").read_text())
        assert config["contact"]["load"] == 800.0


def test_the_numbers_that_follow_are_stored_and_read_again(run, tmp_path, capsys):
    steel = [f"--set=body_{body}.material=steel" for body in (1, 2)]
    rough = "--set", "body_1.Ra=40 nm", "--no-error"
    result, config, words = run(*steel, *rough, "--set", "lubricant.pressure_viscosity=0.2 1/GPa")
    assert "reduced_modulus" not in config["contact"] and config["body_1"]["material"] == "steel"
    assert result["inputs"]["contact.reduced_modulus"] == pytest.approx(206e9 / 0.91)
    assert "mgehl: unusual: lubricant.pressure_viscosity = 2e-10 1/Pa: machines have" in words
    assert "  lambda: " in words and "over 50.13 nm rms" in words
    path = tmp_path / "run" / "fields.h5"
    assert read_run(path.parent).contact.reduced_modulus == result["inputs"]["contact.reduced_modulus"]
    assert main(["cite", str(path.parent)]) == 0
    entries = capsys.readouterr().out
    assert entries.count("@") == entries.count("\n}") and "@misc{iso6336," in entries
    assert "@article{hamrock1977," not in entries  # nor does its oil stiffen
