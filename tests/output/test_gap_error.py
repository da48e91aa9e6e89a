from dataclasses import replace
from types import SimpleNamespace

import pytest
from contacts import solved

from mgehl.output.gap_error import (
    SMALLEST,
    SPREAD,
    by_ridges,
    by_unseen_inlet,
    from_grids,
    share_half_width,
    why_no_band,
)
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


def test_alike_grids_show_the_second_order_and_contact_whose_edge_is_known_to_a_cell_the_first():
    """A third of the difference, as Richardson has it, or all; and a part of what differs node by node."""
    alike = [replace(grid(n), contact_load_share=0.0, mean_nm=nm) for n, nm in ((257, 10.0), (129, 10.3))]
    touching = [alike[0], replace(alike[1], contact_load_share=0.01)]
    for grids, part in ((alike, 0.1), (touching, 0.3)):
        assert from_grids(grids).mean_nm == pytest.approx(part + SPREAD * 0.5)


def test_loads_and_the_largest_pressure_have_bands_of_their_own():
    coarser = replace(grid(129), max_pressure_GPa=1.97, contact_load_share=0.26, solid_load_apart=0.1)
    error = from_grids((grid(257), coarser))
    assert error.max_pressure_GPa == pytest.approx(0.01 + SPREAD * 0.05 + 0.03)
    assert error.contact_load_share == pytest.approx(0.01)
    assert error.solid_load_fraction == pytest.approx(SPREAD * 0.1)
    assert replace(error, grids=(grid(257), coarser)).the_grids == []


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


def test_where_no_grid_sees_the_inlet_all_that_hangs_on_the_film_has_a_wider_band():
    coarser = replace(grid(129), solid_load_apart=0.01)
    seen = replace(from_grids((grid(257), coarser)), mean_nm=1.0)
    unseen = by_unseen_inlet(seen, grid(257))
    for name in ("mean_nm", "loaded_nm", "solid_load_fraction"):
        assert getattr(unseen, name) == pytest.approx(3.0 * getattr(seen, name))
    assert unseen.max_pressure_GPa == seen.max_pressure_GPa and "3 times as wide" in unseen.how
    none = by_unseen_inlet(replace(seen, mean_nm=2.0), grid(257))
    assert none.mean_nm is none.max_pressure_GPa is None and "less than half a cell" in none.how


def test_loads_of_lines_that_touch_have_a_wider_band():
    """Of a rough line on 513 nodes the load on contact was called 37 +- 11 %, friction .0633 +- .0073: on
    2049 nodes they are 4.8 % and .0509."""
    coarser = replace(grid(129), solid_load_apart=0.01, friction=0.052)
    plain = from_grids((replace(grid(257), friction=0.05), coarser))
    wide = by_ridges(plain, replace(grid(257), friction=0.05))
    for name in ("friction", "solid_load_fraction", "loaded_nm"):
        assert (
            getattr(wide, name) == pytest.approx(3.0 * getattr(plain, name)) or getattr(wide, name) is None
        )
    assert wide.mean_nm == plain.mean_nm and "no oil flows around a ridge" in wide.how


def test_where_the_load_on_contact_is_the_grids_that_on_solids_is_too():
    coarser = replace(grid(129), contact_load_share=0.6)
    error = from_grids((grid(257), coarser))
    assert error.contact_load_share is error.solid_load_fraction is None and error.mean_nm is not None


def test_where_the_coarser_grid_did_not_settle_there_is_none():
    error = from_grids((grid(257), grid(129, settled=False)))
    assert error.mean_nm is error.loaded_nm is None and "on 129 nodes" in error.how


def test_where_the_coarser_grid_has_another_gap_there_is_none():
    error = from_grids((grid(257), replace(grid(129), mean_nm=30.0)))
    assert error.mean_nm is error.loaded_nm is error.max_pressure_GPa is None
    assert error.how == "on 129 nodes the mean gap is 30 nm, too far from this"


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


def test_friction_has_the_band_of_its_difference_to_the_coarser_grid():
    """Of first order, with a part of what shear differs by from node to node; none without sliding."""
    fine = replace(grid(257), friction=0.05)
    coarse = replace(grid(129), friction=0.052, friction_apart=0.01)
    assert from_grids((fine, coarse)).friction == pytest.approx(0.002 + SPREAD * 0.01)
    assert from_grids((grid(257), grid(129))).friction is None
    assert from_grids((fine, replace(coarse, friction=0.08))).friction is None


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


def test_what_few_nodes_carry_may_be_none_on_another_grid():
    """Two grids agreed on 1.3 % of the load by .36, and a finer one had .2 %."""
    assert share_half_width(0.013, 0.0125, 0.002) == 0.013
    assert share_half_width(0.13, 0.125, 0.002) == pytest.approx(0.006)
    assert share_half_width(0.0, 0.0, 0.0) == SMALLEST
