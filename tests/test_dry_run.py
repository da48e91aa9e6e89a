import numpy as np
import pytest

from mgehl.cli import main
from mgehl.output.stored import read_run
from mgehl.studies import dry_surfaces
from mgehl.studies.dry import REFERENCE

SURFACE = f"{dry_surfaces.__file__}:rough_500"
PAPER = {"grid.nodes": "65", "grid.x": "[-1.9, 1.3]", "grid.y": "[-1.5, 1.5]"}


def run(directory, *more, **settings):
    keys = {"discretization.contact_model": "dry"} | PAPER | settings
    words = [f"--set={key}={value}" for key, value in keys.items()]
    return main(["run", *words, "--out", str(directory), "--quiet", *more])


@pytest.fixture(scope="module")
def rough(tmp_path_factory):
    directory = tmp_path_factory.mktemp("dry") / "rough"
    assert run(directory, **{"contact.surface": SURFACE}) == 0
    assert main(["plot", str(directory), "--format", "png"]) == 0
    assert main(["report", str(directory)]) == 0
    return directory


def test_its_files_read_back(rough):
    solution = read_run(rough)
    assert solution.is_dry and solution.result.converged
    assert np.count_nonzero(solution.fields.P) == solution.result.contact.nodes
    heights = dry_surfaces.rough_500(solution.x[None], solution.y[:, None])
    np.testing.assert_allclose(solution.heights, heights)
    assert solution.film.min() > -1e-14 and [row["changed_nodes"] for row in solution.rows][-1] == 0


def test_pictures_and_page_of_a_surface_by_a_formula(tmp_path):
    waves = {"kind": "waviness", "amplitude": "100 nm", "wavelength_x": "100 um", "wavelength_y": "100 um"}
    directory = tmp_path / "wavy"
    assert run(directory, **{f"surface.{key}": value for key, value in waves.items()}) == 0
    assert main(["plot", str(directory), "--format", "png"]) == 0
    assert (directory / "plots" / "surface.png").exists()
    assert main(["report", str(directory)]) == 0
    assert 'alt="Heights of the surface with contact' in (directory / "report.html").read_text()


def test_it_stops_and_goes_on(tmp_path, rough):
    """With the same result, to the last bit."""
    stopped = tmp_path / "stopped"
    assert run(stopped, "--time-limit", "1e-6", **{"contact.surface": SURFACE}) == 143
    assert not (stopped / "result.json").exists()
    assert main(["run", "--resume", str(stopped), "--quiet"]) == 0
    one, other = read_run(rough), read_run(stopped)
    np.testing.assert_array_equal(one.fields.P, other.fields.P)
    assert one.result.work == other.result.work


def test_it_starts_from_another_run(tmp_path, rough):
    """From a coarser grid's in fewer convolutions."""
    keys = {"contact.surface": SURFACE, "grid.nodes": "129"}
    assert run(tmp_path / "fine", "--start-from", str(rough), **keys) == 0
    result = read_run(tmp_path / "fine").result
    assert result.contact.nodes == REFERENCE["rough 500 nm", 129].contact_nodes
    assert result.work.convolutions < 42


def test_one_that_did_not_converge_says_so(tmp_path, capsys):
    assert run(tmp_path / "few", **{"contact.surface": SURFACE, "solver.max_steps": "2"}) == 1
    assert "nodes still change between contact and gap" in capsys.readouterr().err
