"""The unified equations: no contact, overlap instead."""

from functools import cache

import numpy as np
import pytest
from contacts import solved

from mgehl.discretization.status import CONTACT
from mgehl.studies.study import PAPER, papers_grid


@cache
def solution(speed, nodes, model="unified", start="film", gap="0 m", tolerance=1e-8):
    section = {"contact_model": model} | ({"unified_gap": gap} if model == "unified" else {})
    tables = {"motion": {"speed": speed}, "grid": papers_grid(nodes)}
    tables |= {"discretization": section, "solver": {"start": start, "tolerance": tolerance}}
    return solved(PAPER, tables)


@pytest.mark.parametrize("nodes", [65, 129])
def test_full_film_is_that_of_the_interface_conditions(nodes):
    unified, lcic = (solution(1.0, nodes, model, tolerance=1e-10) for model in ("unified", "lcic"))
    assert unified.result.converged and lcic.result.converged
    assert unified.result.central_film_nm == pytest.approx(lcic.result.central_film_nm, rel=1e-9)
    assert unified.result.minimum_film_nm == pytest.approx(lcic.result.minimum_film_nm, rel=1e-9)
    np.testing.assert_allclose(unified.fields.P, lcic.fields.P, rtol=0.0, atol=1e-9)
    assert unified.result.overlap.nodes == 0 and unified.result.reason == lcic.result.reason


def test_where_the_film_is_too_thin_for_the_grid_the_bodies_overlap():
    """20 mm/s: the equations hold, and the reason says at what price."""
    found = solution(0.02, 129)
    result, H = found.result, found.fields.H
    assert result.converged and result.residual <= 1e-8
    nm = 1e9 * found.contact.film_scale
    assert result.overlap.nodes == np.count_nonzero(H < 0.0) > 10
    assert result.overlap.largest_nm == pytest.approx(-H.min() * nm, rel=1e-12)
    assert result.overlap.largest_nm > 1.0
    assert f"overlap at {result.overlap.nodes} nodes" in result.reason
    assert result.minimum_film_nm == pytest.approx(-result.overlap.largest_nm, rel=1e-12)


def test_no_node_is_ever_in_contact():
    """In no cycle on any grid; not even at 0.005 mm/s, where there is no film to be found either.

    (Whether that chaotic iteration ends with overlapping bodies or does not end, rounding decides.)
    """
    for found in (solution(0.02, 129), solution(5e-6, 65, start="contact")):
        assert all(row["contact_nodes"] == 0 for row in found.rows)
        assert not np.any(found.fields.status == CONTACT)
        assert found.result.pressure_inequality.checked == 0
    crept = solution(5e-6, 65, start="contact").result
    assert not crept.converged or (crept.overlap.nodes > 1000 and "overlap" in crept.reason)


def test_smallest_gap_counts_where_the_bodies_overlap_only():
    """None does to a film: not a digit; 20 nm, the scale of the overlap, let more fluid pass there."""
    thick = [solution(1.0, 65, gap=gap).result.minimum_film_nm for gap in ("0 m", "20 nm")]
    assert thick[0] == thick[1]
    none, some = (solution(0.02, 129, gap=gap).result for gap in ("0 m", "20 nm"))
    assert some.converged and some.residual <= 1e-8
    assert some.overlap.nodes > 1.2 * none.overlap.nodes
