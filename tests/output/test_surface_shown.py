"""How well a grid shows a surface: the verdict, its words, and what `mgehl check` prints."""

import numpy as np
import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.resolution import resolution
from mgehl.output.surface import surface_doubts, surface_lines, surface_words

CELL = 3.2 / 64 * 0.4108333e-3
"""Of 65 nodes on the paper's domain, in m."""
WAVES = {"grid.nodes": 65, "surface.kind": "waviness", "surface.amplitude": "20 nm"}


def case(settings):
    config = load_config(settings=settings)
    contact = contact_from(config)
    return config, contact, mesh_from(config, contact)


@pytest.mark.parametrize(
    "nodes, verdict, words",
    [
        (8.01, "resolved", "8.0 nodes in its shortest wave: resolved"),
        (7.9, "coarse", "7.9 nodes in its shortest wave: coarse (below 8)"),
        (3.9, "grid-determined", "3.9 nodes in its shortest wave: THE SURFACE IS THE GRID'S (below 4)"),
    ],
)
def test_the_verdict_follows_from_the_nodes_in_the_shortest_wave(nodes, verdict, words):
    _, contact, mesh = case(WAVES | {"surface.wavelength_x": nodes * CELL})
    found = resolution(contact, mesh)
    assert found.surface == verdict and found.surface_nodes == pytest.approx(nodes, rel=1e-4)
    assert surface_words(found.surface, found.surface_nodes).startswith(words)


def test_smooth_bodies_have_nothing_to_show():
    config, contact, mesh = case({"grid.nodes": 65})
    found = resolution(contact, mesh)
    assert found.surface == "smooth" and surface_words("smooth", found.surface_nodes) == ""
    assert list(surface_lines(config, contact, mesh)) == []


def test_what_check_prints():
    """Sq and Ssk of samples within the Hertz contact, lambda by the formula's film."""
    config, contact, mesh = case(WAVES | {"surface.wavelength_x": 6 * CELL, "motion.speed": 0.5})
    first, second, third = surface_lines(config, contact, mesh)
    assert f"Sq {1e9 * contact.roughness:.4g} nm" in first and f"Ssk {contact.skewness:.3g}" in first
    assert contact.roughness == pytest.approx(20e-9 / 2**0.5, rel=0.03)
    assert f"lambda {contact.expected_film / contact.roughness:.3g} (the formula's film over Sq)" in first
    assert f"shortest wavelength {6e6 * CELL:.4g} um, 6.0 nodes" in second
    assert second.endswith("resolved from 129 nodes on, or leave its short waves out")
    assert "a peak is positive and lowers the gap" in third


def doubts(tmp_path, heights, **keys):
    np.save(tmp_path / "z.npy", heights)
    told = {"file": f"{tmp_path}/z.npy", "height_unit": "nm", "spacing": "14 um"} | keys
    config, contact, _ = case({"grid.nodes": 65} | {f"surface.{key}": value for key, value in told.items()})
    return [
        words.removeprefix(f"surface.file = '{tmp_path}/z.npy': ")
        for words in surface_doubts(config, contact)
    ]


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
    holed = good.copy()
    holed[3:6, 7:9] = np.nan
    said = doubts(tmp_path, holed, holes="interpolate")
    assert said == ["6 of 4225 points were holes and are filled smoothly"]
    (said,) = doubts(tmp_path, good, height_unit="pm")
    assert said.startswith("Sq is 0.026 nm within the Hertz contact, less than any surface has")
    (said,) = doubts(tmp_path, good, height_unit="um")
    assert said.startswith(
        "Sq is 26.1 um within the Hertz contact, more than a surface that rolls or slides has"
    )


def test_a_first_row_that_may_be_positions_is_named(tmp_path):
    ramp = np.add.outer(np.arange(65), np.arange(65))
    np.savetxt(tmp_path / "z.txt", ramp)
    assert doubts(tmp_path, ramp, file=f"{tmp_path}/z.txt")[0].split(": ", 1)[1].startswith("the first row")


def test_where_a_file_ends_is_said(tmp_path):
    lines = "\n".join(" ".join(str((i * j) % 7 + i) for i in range(65)) for j in range(65))
    (tmp_path / "z.txt").write_text(lines)
    settings = {
        "grid.nodes": 65, "surface.file": f"{tmp_path}/z.txt", "surface.height_unit": "nm",
        "surface.spacing": "14 um",
    }  # fmt: skip
    *_, told, ends = surface_lines(*case(settings | {"surface.remove": "tilt"}))
    assert told.endswith("z.txt': 65 x 65 points, 896 um by 896 um")
    *_, tilted, _ = surface_lines(*case(settings))
    assert tilted.endswith(' nm from edge to edge: remove = "tilt" levels it')
    assert ends.endswith("it ends within the domain: beyond its edge the edge's heights go on")
