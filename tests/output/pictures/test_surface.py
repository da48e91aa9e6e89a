from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.cli import main
from mgehl.errors import UserError
from mgehl.output.pictures.figures import figures, left_out
from mgehl.output.pictures.surface import heights_of

KINDS = ["lines", "film", "pressure", "status", "history"]
RIDGE = ["surface.kind=ridge", "surface.amplitude=1e-6", "surface.width=2e-4", "surface.x=1e-4"]


def shown(solution):
    """With a verdict on its surface."""
    resolution = SimpleNamespace(surface="coarse", surface_nodes=6.3)
    return replace(solution, result=replace(solution.result, resolution=resolution, Sq_nm=56.78))


def test_heights_are_the_surface_s_at_the_nodes(make_solution):
    solution = make_solution(settings=RIDGE)
    heights = heights_of(solution)
    assert heights.shape == (33, 33) and np.ptp(heights, axis=0).max() == 0.0
    assert solution.x[heights[0].argmax()] == pytest.approx(1e-4, abs=3e-5)


@pytest.mark.parametrize("contact", [0.0, 0.5])
def test_a_rough_contact_has_one_picture_more(make_solution, check_texts, contact):
    solution = shown(make_solution(settings=RIDGE, contact=contact))
    pictures = figures(solution)
    assert [picture.name for picture in pictures] == [*KINDS, "surface"]
    heights, film, distribution = pictures[-1].figure.axes
    assert [axes.get_title() for axes in (heights, film)] == ["heights", "film"]
    assert distribution.get_title().startswith("Sq 56.78 nm, Ssk ")
    areas = [patch.get_height() * patch.get_width() for patch in distribution.patches]
    assert sum(areas) == pytest.approx(1.0)
    for axes in (heights, film):
        said = [text.get_text() for text in axes.get_legend().get_texts()]
        assert ("contact" in said) == (contact > 0.0) and any(text.startswith("Hertz: ") for text in said)
    check_texts(pictures[-1].figure, "film thickness, nm", "height, nm (a peak is positive)")
    assert "6.3 nodes in its shortest wave: coarse" in pictures[-1].figure._suptitle.get_text()


@pytest.fixture
def without_file(make_solution, tmp_path):
    """A solution whose surface's file is gone."""
    keys = [f"surface.file={tmp_path}/gone.npy", "surface.height_unit=nm", "surface.spacing=1e-6"]
    return shown(make_solution(settings=keys))


def test_an_older_result_whose_file_is_gone_has_no_picture_of_it(without_file):
    assert [picture.name for picture in figures(without_file)] == KINDS
    assert left_out(without_file)["surface"].endswith("gone.npy: cannot be read: No such file or directory")
    with pytest.raises(UserError, match="gone.npy: cannot be read"):
        figures(without_file, ["surface"])


def test_plot_says_what_it_leaves_out(without_file, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("mgehl.output.stored.read_run", lambda run: without_file)
    monkeypatch.chdir(tmp_path)
    assert main(["plot", "run", "--kind", "surface,history", "--format", "svg"]) == 0
    said = capsys.readouterr()
    assert said.out == "run/plots/history.svg\n"
    assert said.err.startswith("mgehl: run: no picture of the surface: ") and "gone.npy" in said.err
    assert main(["plot", "run", "--kind", "surface"]) == 2
