from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.output.pictures.figures import figures

KINDS = ["lines", "film", "pressure", "status", "history"]
RIDGE = ["surface.kind=ridge", "surface.amplitude=1e-6", "surface.width=2e-4", "surface.x=1e-4"]


def shown(solution):
    resolution = SimpleNamespace(surface="coarse", surface_nodes=6.3)
    return replace(solution, result=replace(solution.result, resolution=resolution, Sq_nm=56.78))


def test_heights_are_the_surface_s_at_the_nodes(make_solution):
    solution = make_solution(settings=RIDGE)
    heights = solution.heights
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
