import re
from dataclasses import replace

import pytest
from made_solution import in_time, make_result
from mpi4py import MPI
from places import ROOT

import mgehl
from mgehl.output.gap_error import no_band
from mgehl.output.mixed_result import MixedResult
from mgehl.output.resolution import Resolution
from mgehl.output.result import Mean, TimeError
from mgehl.output.time_words import mean_gap_words
from mgehl.output.words import FAILED, UNRESOLVED
from mgehl.solver.inequality import Inequality


def test_a_run_shorter_than_a_passage_says_that_it_has_no_means():
    said = str(make_result(time=in_time(passages=0.5)))
    assert "\n  no means: the run ends before its first passage\n" in said


@pytest.mark.parametrize("shear, is_odd", [(None, False), (299.0, False), (301.0, True)])
def test_a_shear_in_time_that_no_oil_bears_is_named(shear, is_odd):
    found = str(make_result(time=in_time(largest_shear_MPa=shear)))
    assert ("no oil bears more than some 300 MPa" in found) == is_odd


def test_a_mean_is_rounded_as_its_band_is():
    """A report had 150 ± 30 on top and 148.9 ± 21 below."""
    means = Mean(148.9, 20.0), Mean(148.93, None), Mean(148.93, 1.0)
    bands = {"mean_gap_nm": 1.0}, {"mean_gap_nm": 1e-3}, {}
    times = [
        in_time(means={"mean_gap_nm": mean}, error=TimeError("", means=band))
        for mean, band in zip(means, bands, strict=True)
    ]
    assert [mean_gap_words(time) for time in times] == ["150 ± 30", "148.9", "148.9"]


@pytest.mark.parametrize("crest, is_named", [(None, False), (0.002, False), (0.15, True)])
def test_a_pressure_spike_that_the_grid_does_not_hold_is_named(crest, is_named):
    assert ("three nodes do not hold" in str(make_result(pressure_crest=crest))) == is_named


@pytest.mark.parametrize("spikes", [0, 3])
def test_steps_whose_largest_pressure_is_a_spike_are_told(spikes):
    """A lump of oil that left a contact had 2.4 GPa at one node for three steps, without a word."""
    found = str(make_result(time=in_time(spikes=spikes)))
    assert ("in 3 of 9 steps the largest pressure is the grid's" in found) == bool(spikes)


class TestWhereToReadOn:
    """Pages and headings that words name are there; what is fine needs none."""

    @pytest.mark.parametrize("pointer", [FAILED, UNRESOLVED])
    def test_the_heading_is_on_the_page(self, pointer):
        page, heading = re.search(r'(\S+README\.md), "(.*)"', pointer).groups()
        assert f"\n## {heading}\n" in (ROOT / page).read_text()

    @pytest.mark.parametrize(
        "settled, head", [(False, "NOT CONVERGED: "), (True, "SETTLED, BUT EQ. 2 IS BROKEN: ")]
    )
    def test_after_a_failure(self, settled, head):
        lines = str(make_result(converged=False, reason="residual 1e-3", settled=settled)).splitlines()
        assert lines[0] == f"{head}residual 1e-3" and lines[-1] == f"  {FAILED}"

    @pytest.mark.parametrize("verdict", ["coarse", "grid-determined", "starved"])
    def test_of_a_film_that_is_not_resolved(self, verdict):
        assert str(make_result(resolution=Resolution(0.5, verdict))).splitlines()[-1] == f"  {UNRESOLVED}"

    @pytest.mark.parametrize(
        "patches, share, is_said", [(7, None, True), (7, 0.02, False), (0, None, False)]
    )
    def test_where_rough_bodies_touch_as_the_grid_has_it(self, patches, share, is_said):
        """The inlet may be resolved all the same."""
        error = replace(no_band("on 257 nodes no state settled"), contact_load_share=share)
        touching = 0.25, 80.0, 0.125, 0.875, 3e-9, 0.0625, patches, 1e-9, 40.0, None, 90.0, 0.015
        result = make_result(
            resolution=Resolution(5.0, "resolved"), mixed=MixedResult(*touching, error=error)
        )
        assert (str(result).splitlines()[-1] == f"  {UNRESOLVED}") == is_said


class TestOfALoadedContact:
    def test_what_most_want_to_know_is_shorter_but_keeps_the_warnings(self):
        few, whole = (make_result().words(verbose) for verbose in (False, True))
        assert set(few.splitlines()) < {line.split("; nodes")[0] for line in whole.splitlines()}
        parts = "CONVERGED", "12.0000 nm", "contact: 3 nodes", "inequality broken at 1 of 8", "5.00 cells"
        assert all(part in few for part in parts)
        for part in ("complementarity", "largest gap", "violated at node"):
            assert part in whole and part not in few
        none = Inequality(8, 0, 0.0, 1.5, [])
        assert "inequality" not in make_result(pressure_inequality=none).words(verbose=False)

    def test_a_node_that_can_be_neither_is_named_with_both_reasons(self):
        node = {
            "i": 7, "j": 9, "film_gap_nm": -0.6, "contact_pressure": -0.014,
            "neighbours": ["lubricated", "cavitated", "lubricated", "contact"],
        }  # fmt: skip
        text = str(make_result(converged=False, settled=False, contradictions=[node]))
        assert "node (7, 9): as film its gap is -6.00e-01 nm, as contact its pressure -1.40e-02 p_h" in text


@pytest.mark.parametrize("cavitation", [False, True])
def test_a_bearing_that_sucks_names_what_would_let_its_film_tear(cavitation):
    opens = {"wedge.length": 0.05, "wedge.inlet_film": 6e-5, "wedge.exit_film": 9e-5, "grid.nodes": 65}
    kind = {"contact.kind": "wedge", "discretization.cavitation": cavitation, "motion.speed": 2.0}
    found = str(mgehl.solve(mgehl.load(None, kind | opens), MPI.COMM_SELF).result)
    assert ("the film pulls where P is below 0; discretization.cavitation" in found) == (not cavitation)


@pytest.mark.parametrize(
    "more, words",
    [({}, "5.00 cells, resolved"),
     ({"inlet_speed": 0.3}, "5.00 cells at the slowest, 300 mm/s, resolved"),
     ({"inlet_speed": 8.0, "rests": True}, "5.00 cells at 8 m/s, resolved; near rest no grid resolves it"),
     ({"inlet_speed": 8.0, "rests": True, "nodes_at_rest": 0.5}, "5.00 cells at 8 m/s, resolved; near rest "
      "no grid resolves it, and the contact has 0.5 cells across there, too few for a verdict")],
)  # fmt: skip
def test_the_inlet_of_a_run_in_time_is_that_of_a_speed(more, words):
    assert f"  inlet: {words}" in str(make_result(resolution=Resolution(5.0, "resolved", **more)))
