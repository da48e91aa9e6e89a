from dataclasses import replace
from types import SimpleNamespace

import pytest
from contacts import solved

from mgehl.output.gap_error import from_grids, why_no_band
from mgehl.solver.gaps import GridGap

WAVY = {
    "contact": {"load": 20.0, "boundary_film": 2e-9},
    "surface": {"kind": "waviness", "amplitude": 5e-8, "wavelength_x": 8e-5},
    "grid": {"x": [-2.0, 1.5], "y": [-1.75, 1.75]},
    "motion": {"speed": 1e-3},
    "solver": {"error": True},
}
"""A ball with ridges across the motion, in mixed lubrication."""


def grid(nodes, settled=True):
    loads = {
        "max_pressure_GPa": 2.0, "solid_load_fraction": 0.2, "pressure_apart_GPa": 0.05,
        "pressure_crest_GPa": 0.03,
    }  # fmt: skip
    return GridGap(nodes, 10.0, 2.0, 0.25, settled, 0.5, 0.1, **loads)


def test_what_the_two_grids_do_not_share_is_the_grid_s():
    loads = {"contact_load_share": 0.6, "solid_load_fraction": 0.5}
    coarser = replace(grid(129), loaded_nm=3.1, max_pressure_GPa=0.9, **loads)
    error = replace(from_grids((grid(257), coarser)), grids=(grid(257), coarser))
    assert error.mean_nm is not None
    assert error.the_grids == [
        "the gap by pressure", "the largest pressure", "the load on contact", "the load on solids"
    ]  # fmt: skip
    none = from_grids((grid(257), grid(129, settled=False)))
    assert none.the_grids == [] and none.max_pressure_GPa is None


@pytest.mark.parametrize(
    "coarser, none, why",
    [({"settled": False}, ("mean_nm", "loaded_nm"), "on 129 nodes"),
     ({"mean_nm": 30.0}, ("mean_nm", "loaded_nm", "max_pressure_GPa"), "on 129 nodes the mean gap is 30"),
     ({"contact_load_share": 0.6}, ("contact_load_share", "solid_load_fraction"), "")],
)  # fmt: skip
def test_where_the_coarser_grid_tells_nothing_there_is_no_band(coarser, none, why):
    error = from_grids((grid(257), replace(grid(129), **coarser)))
    assert all(getattr(error, name) is None for name in none) and why in error.how


@pytest.mark.parametrize(
    "settled, closes, edge, surface, words",
    [(False, False, "", "resolved", "not settled"), (True, True, "", "resolved", "closes its faces"),
     (True, False, "the domain cuts it", "resolved", "cuts"),
     (True, False, "", "grid-determined", "fewer than four nodes"), (True, False, "", "coarse", "")],
)  # fmt: skip
def test_why_there_may_be_none(settled, closes, edge, surface, words):
    shown = SimpleNamespace(surface=surface)
    result = SimpleNamespace(settled=settled, edge=SimpleNamespace(wrong=(edge, "")), resolution=shown)
    law = SimpleNamespace(closes_faces=closes)
    problem = SimpleNamespace(scheme=SimpleNamespace(contact_law=law))
    why = why_no_band(result, problem)
    assert words in why and bool(why) == bool(words)


THICK = {"motion": {"speed": 0.1}, "surface": {"amplitude": 3e-8}}
"""Ridges of 30 nm under a film of 60."""


@pytest.mark.parametrize(
    "more, nodes, part", [({}, 129, 0.2), (THICK, 65, 0.1)], ids=["in contact", "thick film"]
)
def test_the_bands_hold_what_finer_grids_have(more, nodes, part):
    coarse, fine = (solved(WAVY, more, {"grid": {"nodes": each}}).result for each in (nodes, 257))
    assert coarse.converged and fine.converged
    for gap in ("mean", "loaded"):
        values = [getattr(each.mixed, f"{gap}_gap_nm") for each in (coarse, fine)]
        band = getattr(coarse.mixed.error, f"{gap}_nm")
        assert 0.0 < abs(values[1] - values[0]) < band < part * values[0]
    if more:
        assert coarse.mixed.lambda_ratio > 2.0
        return
    assert fine.mixed.contact_load_share > 0.0
    off = abs(fine.max_pressure_GPa - coarse.max_pressure_GPa)
    assert 0.0 < off < coarse.mixed.error.max_pressure_GPa < 0.2 * fine.max_pressure_GPa
    for name in ("contact_load_share", "solid_load_fraction"):
        off = abs(getattr(fine.mixed, name) - getattr(coarse.mixed, name))
        assert 0.0 < off < getattr(coarse.mixed.error, name) < 0.25


def test_the_band_of_a_films_friction_holds_the_next_finer_grids():
    """Solids carry nothing here: the band was that of their load alone, a ten thousandth."""
    sliding = {"motion": {"speed": 0.02, "slide_to_roll": 0.2}}
    sliding |= {"friction": {"model": "eyring", "eyring_stress": 5e6}}
    coarse, fine = (solved(WAVY, sliding, {"grid": {"nodes": nodes}}).result for nodes in (65, 129))
    assert coarse.mixed.solid_load_fraction == 0.0
    off = abs(coarse.friction.coefficient - fine.friction.coefficient)
    assert 1e-6 < off < coarse.friction.coefficient_band < 0.1 * coarse.friction.coefficient


@pytest.mark.parametrize("couette, has_bands", [("3B", True), ("1B", False)])
def test_a_smooth_contact_s_largest_pressure_and_friction_have_bands(couette, has_bands):
    """By the films' coarser grid, if it was solved by the same scheme; they hold the next finer grid's."""
    ball = {"motion": {"speed": 0.2, "slide_to_roll": 0.1}, "contact": {"load": 200.0}}
    ball |= {"discretization": {"couette": couette}, "solver": {"error": True}}
    grids = ({"grid": {"nodes": nodes, "x": [-3.0, 2.0], "y": [-2.5, 2.5]}} for nodes in (65, 129))
    coarse, fine = (solved(ball, each).result for each in grids)
    assert (coarse.max_pressure_band_GPa is not None) == has_bands
    assert (coarse.friction.coefficient_band is not None) == has_bands
    if has_bands:
        assert 0.0 < abs(fine.max_pressure_GPa - coarse.max_pressure_GPa) < coarse.max_pressure_band_GPa
        off = abs(fine.friction.coefficient - coarse.friction.coefficient)
        assert 0.0 < off < coarse.friction.coefficient_band < 0.5 * coarse.friction.coefficient


def test_a_spike_that_three_nodes_do_not_hold_leaves_a_smooth_contact_without_them():
    spiky = {"motion": {"speed": 1.0, "slide_to_roll": 0.1}, "contact": {"load": 50.0}}
    grid = {"grid": {"nodes": 65, "x": [-3.0, 2.0], "y": [-2.5, 2.5]}, "solver": {"error": True}}
    result = solved(spiky, grid, {"discretization": {"couette": "3B"}}).result
    assert result.max_pressure_band_GPa is result.friction.coefficient_band is None
    assert result.error.central_nm and result.friction.is_the_grids
    assert "a spike that three nodes do not hold" in str(result)
