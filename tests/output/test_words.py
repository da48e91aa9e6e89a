import re
from dataclasses import replace

import pytest
from made_solution import in_time, make_mixed, make_result
from mpi4py import MPI
from places import ROOT

import mgehl
from mgehl.output.gap_error import no_band
from mgehl.output.resolution import Resolution
from mgehl.output.result import Mean, TimeError
from mgehl.output.time_words import means_in_short
from mgehl.output.words import FAILED, UNRESOLVED


@pytest.mark.parametrize("shear, is_odd", [(None, False), (299.0, False), (301.0, True)])
def test_a_shear_in_time_that_no_oil_bears_is_named(shear, is_odd):
    found = str(make_result(time=in_time(largest_shear_MPa=shear)))
    assert ("no oil bears more than some 300 MPa" in found) == is_odd


def test_a_mean_is_rounded_as_its_band_is():
    means = Mean(148.9, 20.0), Mean(148.93, None), Mean(148.93, 1.0)
    bands = {"mean_gap_nm": 1.0}, {"mean_gap_nm": 1e-3}, {}
    times = [
        in_time(means={"mean_gap_nm": mean}, error=TimeError("", means=band))
        for mean, band in zip(means, bands, strict=True)
    ]
    told = [("mean gap over the last passage", f"{gap} nm") for gap in ("150 ± 30", "148.9", "148.9")]
    assert [found for time in times for found in means_in_short(time)] == told


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

    @pytest.mark.parametrize("patches, share, said", [(7, None, True), (7, 0.02, False), (0, None, False)])
    def test_where_rough_bodies_touch_as_the_grid_has_it(self, patches, share, said):
        """The inlet may be resolved all the same."""
        error = replace(no_band("on 257 nodes no state settled"), contact_load_share=share)
        mixed = make_mixed(patches=patches, error=error)
        result = make_result(resolution=Resolution(5.0, "resolved"), mixed=mixed)
        assert (str(result).splitlines()[-1] == f"  {UNRESOLVED}") == said


class TestOfALoadedContact:
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
