import numpy as np
import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.resolution import resolution
from mgehl.output.surface import surface_doubts, surface_words

CELL = 3.2 / 64 * 0.4108333e-3
"""Of 65 nodes on the paper's domain, in m."""
WAVES = {"grid.nodes": 65, "surface.kind": "waviness", "surface.amplitude": "20 nm"}


def case(settings):
    config = load_config(settings=settings)
    contact = contact_from(config)
    return config, contact, mesh_from(config, contact)


@pytest.mark.parametrize(
    "nodes, verdict, words",
    [(8.01, "resolved", "8.0 nodes in its shortest wave: resolved"),
     (7.9, "coarse", "7.9 nodes in its shortest wave: coarse (below 8)"),
     (3.9, "grid-determined", "3.9 nodes in its shortest wave: THE SURFACE IS THE GRID'S (below 4)")],
)  # fmt: skip
def test_the_verdict_follows_from_the_nodes_in_the_shortest_wave(nodes, verdict, words):
    _, contact, mesh = case(WAVES | {"surface.wavelength_x": nodes * CELL})
    found = resolution(contact, mesh)
    assert found.surface == verdict and found.surface_nodes == pytest.approx(nodes, rel=1e-4)
    assert surface_words(found.surface, found.surface_nodes).startswith(words)


def doubts(tmp_path, heights, **keys):
    np.save(tmp_path / "z.npy", heights)
    told = {"file": f"{tmp_path}/z.npy", "height_unit": "nm", "spacing": "14 um"} | keys
    config, contact, _ = case({"grid.nodes": 65} | {f"surface.{key}": value for key, value in told.items()})
    key = f"surface.file = '{tmp_path}/z.npy': "
    return [words.removeprefix(key) for words in surface_doubts(config, contact)]


def test_points_that_are_hardly_heights_are_named(tmp_path):
    good = np.random.default_rng(5).normal(0.0, 30.0, (65, 65))
    assert doubts(tmp_path, good) == []
    wrong = good.copy()
    wrong[30, 40] = 2e4
    (said,) = doubts(tmp_path, wrong)
    assert said.startswith("1 point stands out of all neighbours, row 31, column 41 most, by 19.9")
    missing = good.copy()
    missing[3:6, 7:9] = -32768.0
    (said,) = doubts(tmp_path, missing)
    assert said.startswith("6 points, the first in row 4, column 8, have the same height of -32.77 um")
    # Of a form that is taken off equal heights are equal no more.
    (said,) = doubts(tmp_path, np.where(missing < -1e3, 300.0, missing), remove="curvature")
    assert said.startswith("6 points, the first in row 4, column 8, have the same height of 0.3 um")
    holed = good.copy()
    holed[3:6, 7:9] = np.nan
    said = doubts(tmp_path, holed, holes="interpolate")
    assert said == ["6 of 4225 points were holes and are filled smoothly"]
    (said,) = doubts(tmp_path, good, height_unit="pm")
    assert said.startswith("Sq is 0.026 nm within the Hertz contact, less than any but wafers have")
    (said,) = doubts(tmp_path, good, height_unit="um")
    assert said.startswith("Sq is 26.4 um within the Hertz contact, more than a surface that rolls")


def test_the_form_of_a_body_in_its_heights_is_named(tmp_path):
    """The bodies' radii tell it already: it counted twice."""
    noise = np.random.default_rng(5).normal(0.0, 30.0, (65, 65))
    x = 14e-6 * (np.arange(65) - 32)
    ball = noise + 1e9 * (x[None, :] ** 2 + x[:, None] ** 2) / (2.0 * 12.7e-3)
    assert doubts(tmp_path, noise + 1e3) == []
    (said,) = doubts(tmp_path, ball - ball.mean())
    assert said.startswith("it is curved by a radius of 12.7 mm, which the bodies' radii may tell")
    assert doubts(tmp_path, ball, remove="curvature") == []


def test_holes_of_a_profile_are_counted_once(tmp_path):
    profile = np.random.default_rng(5).normal(0.0, 30.0, 65)
    profile[[3, 9]] = np.nan
    said = doubts(tmp_path, profile, holes="interpolate")
    assert said == ["2 of 65 points were holes and are filled smoothly"]
