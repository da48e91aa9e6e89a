"""How well a grid shows a surface: the verdict, its words, and what `mgehl check` prints."""

import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.resolution import resolution
from mgehl.output.surface import surface_lines, surface_words

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
