import pytest
from contacts import solved
from made_solution import make_result

from mgehl.output.wedge_summary import BY_CELLS, load_band

PILLAR = {"contact": {"kind": "wedge"}, "wedge": {"pillar": "square"}, "motion": {"speed": 1.0}}


def of(nodes):
    return solved(PILLAR, {"grid": {"nodes": nodes}}).result


def test_a_bearing_s_load_has_a_band_by_coarser_grids():
    """The next finer grid's lies within: a square pillar's edges jump by cells."""
    coarsest, coarse, fine = (of(nodes) for nodes in (65, 129, 257))
    differences = abs(coarse.load_N - coarsest.load_N), abs(fine.load_N - coarse.load_N)
    assert coarse.load_band_N == pytest.approx(BY_CELLS * differences[0])
    assert fine.load_band_N == pytest.approx(BY_CELLS * max(differences[1], 0.5 * differences[0]))
    assert abs(fine.load_N - coarse.load_N) < coarse.load_band_N
    assert " ± " in str(fine).splitlines()[1] and fine.load_band_how.endswith("to 129 and 65 nodes")
    assert coarse.load_band_how.endswith("to 65 nodes")
    assert coarsest.load_band_N is None and coarsest.load_band_how == "there is no coarser grid"


@pytest.mark.parametrize(
    "converged, coarser, why",
    [(False, [(65, 1.0)], "has not converged"), (True, [], "two cells"),
     (True, [(65, None)], "there is no answer")],
)  # fmt: skip
def test_where_it_has_none_it_says_why(converged, coarser, why):
    refused = "wedge.pillar_size = 1: has less than two cells"
    found = load_band(make_result(converged=converged, load_N=1.0), coarser, refused)
    assert why in found["load_band_how"] and "load_band_N" not in found
