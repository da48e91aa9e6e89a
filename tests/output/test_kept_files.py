import shutil
from pathlib import Path

import numpy as np
import pytest
from places import content_of

from mgehl.cli import main
from mgehl.output.stored import read_run

DRY = ["--set", "discretization.contact_model=dry", "--set", "grid.nodes=65", "--quiet"]
PLACES = ["--set", "surface.spacing=10 um", "--set", "surface.height_unit=nm"]


def heights(seed):
    """A matrix of heights in nm, rough and 1.3 mm wide."""
    return 50.0 * np.random.default_rng(seed).standard_normal((131, 131))


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The working directory, with a file of heights in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    Path("measured").mkdir()
    np.save("measured/heights.npy", heights(1))
    return tmp_path


def run(*words):
    return main(["run", *words, *DRY])


ROUGH = ["--set", "surface.file=measured/heights.npy", *PLACES]


@pytest.fixture
def finished(here):
    assert run(*ROUGH, "--out", "run") == 0
    return here / "run"


def test_it_runs_again_where_the_original_is_not(here, finished, tmp_path_factory):
    """The directory is what another machine gets."""
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    first = read_run(finished)
    assert np.ptp(first.film) > 0.0 and first.result.Sq_nm > 10.0
    shutil.move(finished, elsewhere / "moved")
    shutil.rmtree(here / "measured")
    assert main(["run", str(elsewhere / "moved" / "configuration.toml"), "--out", "again", "--quiet"]) == 0
    again = read_run("again")
    np.testing.assert_array_equal(again.film, first.film)
    np.testing.assert_array_equal(again.pressure, first.pressure)
    copies = [each / "laws" / "heights.npy" for each in (elsewhere / "moved", Path("again"))]
    assert copies[0].read_bytes() == copies[1].read_bytes()


def test_a_report_needs_no_file_of_heights(finished):
    """The run has them: on another machine the library that reads such files may not be there."""
    shutil.rmtree(finished / "laws")
    assert main(["report", str(finished)]) == 0
    assert "heights.npy: cannot be read" in (finished / "report.html").read_text()


def test_a_run_goes_on_with_its_copy_and_says_that_the_file_changed(here, capsys):
    assert run(*ROUGH, "--out", "whole") == 0
    assert run(*ROUGH, "--out", "stopped", "--time-limit", "1e-9") == 143
    np.save("measured/heights.npy", heights(2))
    capsys.readouterr()
    assert main(["run", "--resume", "stopped"]) == 0
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "mgehl: measured/heights.npy has changed since the run began, which goes on with its copy" in err
    np.testing.assert_array_equal(read_run("stopped").film, read_run("whole").film)


def test_files_of_one_name_are_kept_apart(here):
    Path("other").mkdir()
    np.save("other/heights.npy", heights(2))
    second = ["--set", "second_surface.file=other/heights.npy"]
    second += [word.replace("surface.", "second_surface.") for word in PLACES]
    assert run(*ROUGH, *second, "--out", "run") == 0
    assert content_of("run/laws") == {
        "heights.npy": Path("measured/heights.npy").read_bytes(),
        "_heights.npy": Path("other/heights.npy").read_bytes(),
    }
    first = read_run("run").film
    shutil.rmtree("other")
    assert main(["run", "run/configuration.toml", "--out", "again", "--quiet"]) == 0
    np.testing.assert_array_equal(read_run("again").film, first)
