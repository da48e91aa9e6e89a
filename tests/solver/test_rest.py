"""Near rest a rough contact with layers is the dry contact; its oil leaves no trace."""

import tomllib

import numpy as np
import pytest
from contacts import solved
from places import ROUGH

SPEEDS = (2e-4, 1e-5, 1e-7, 1e-9)
"""In m/s: solids carry a part of the load, nearly all of it, all."""


def tables(speed):
    found = tomllib.loads(ROUGH.read_text())
    found["grid"]["nodes"] = 65
    found["motion"]["speed"] = speed
    found["solver"]["error"] = False
    return found


@pytest.fixture(scope="module")
def dry():
    bare = tables(0.0)
    del bare["lubricant"], bare["motion"], bare["solver"], bare["contact"]["boundary_film"]
    bare["discretization"] = {"contact_model": "dry"}
    return solved(bare).fields.P


@pytest.fixture(scope="module")
def slower():
    return [solved(tables(speed)) for speed in SPEEDS]


def test_the_slower_the_nearer_to_the_dry_contact(dry, slower):
    """At last the difference falls in proportion to the speed."""
    assert all(solution.result.converged for solution in slower)
    off = [np.sqrt(np.mean((each.fields.P - dry) ** 2) / np.mean(dry**2)) for each in slower]
    assert off == sorted(off, reverse=True) and off[0] < 1e-2 and off[1] < 1e-3
    assert off[3] == pytest.approx(1e-2 * off[2], rel=1e-2)


def test_solids_take_over_and_the_gap_never_rises(slower):
    mixed = [solution.result.mixed for solution in slower]
    gaps = [each.mean_gap_nm for each in mixed]
    solids = [each.solid_load_fraction for each in mixed]
    assert gaps == sorted(gaps, reverse=True) and solids == sorted(solids)
    assert solids[0] > 0.1 and solids[-1] > 1.0 - 1e-6


def test_sealed_pockets_lose_their_pressure_through_the_layers(slower):
    sealed = [solution.result.mixed.sealed_load_fraction for solution in slower]
    assert 0.0 < sealed[3] == pytest.approx(1e-2 * sealed[2], rel=1e-2)
