"""What is said of a result."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from made_solution import make_solution
from test_files import make_result

from mgehl.output.mixed_result import MixedResult
from mgehl.output.resolution import Resolution
from mgehl.output.result import InequalityResult
from mgehl.output.words import FAILED, UNRESOLVED
from mgehl.solver.inequality import Power

MIXED = MixedResult(0.25, 80.0, 0.125, 0.875, 3e-9, 0.0625, 7, 1e-9, 40.0, None, 90.0, 0.015)

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    "kind, words", [("line", "central film 12.0000 nm"), ("wedge", "load 0.500000 mm")]
)
def test_a_solution_prints_the_words_of_its_result(kind, words):
    solution = make_solution(kind)
    assert str(solution) == str(solution.result)
    assert str(solution).startswith("CONVERGED: ") and words in str(solution)


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

    def test_nothing_of_a_film_that_is(self):
        assert "README" not in str(make_result(resolution=Resolution(5.0, "resolved")))


class TestOfALoadedContact:
    def test_the_answer_and_what_it_rests_on(self):
        lines = str(make_result()).splitlines()
        assert lines[0] == "CONVERGED: all holds"
        text = "\n".join(lines)
        for part in ("12.0000 nm", "1.0000 nm", "2.3000 GPa", "1.0e-09", "-1.0e-10", "3 nodes", "1.00 %",
                     "4..6", "none", "5.00 cells", "80.5", "14 steps", "s on 1 rank"):  # fmt: skip
            assert part in text

    def test_what_most_want_to_know_is_shorter_but_keeps_the_warnings(self):
        few, whole = (make_result().words(verbose) for verbose in (False, True))
        assert set(few.splitlines()) < {line.split("; nodes")[0] for line in whole.splitlines()}
        for part in (
            "CONVERGED",
            "12.0000 nm",
            "contact: 3 nodes",
            "inequality broken at 1 of 8",
            "5.00 cells",
        ):
            assert part in few
        for part in ("complementarity", "largest gap", "violated at node"):
            assert part in whole and part not in few
        none = InequalityResult(8, 0, 0.0, 1.5, [])
        assert "inequality" not in make_result(pressure_inequality=none).words(verbose=False)

    def test_where_eq_2_is_compared_between_nodes_is_said_at_length(self):
        result = make_result(other_inequality=InequalityResult(8, 3, 0.16, 1.5, []))
        line = "compared between nodes, a cell apart: broken at 3 of 8, by up to 1.6e-01 p_h"
        assert line in result.words() and line not in result.words(verbose=False)

    def test_faces_at_which_eq_2_is_not_decided_are_counted(self):
        blind = InequalityResult(8, 0, 0.0, 0.0, [], "at the interface", Power(20, 1, 0.02))
        line = "broken at 0 of 8 interface nodes, undecided at 1 of 20 faces"
        assert line in make_result(pressure_inequality=blind).words()
        assert "undecided" not in make_result().words()

    def test_a_node_that_can_be_neither_is_named_with_both_reasons(self):
        node = {
            "i": 7, "j": 9, "film_gap_nm": -0.6, "contact_pressure": -0.014,
            "neighbours": ["lubricated", "cavitated", "lubricated", "contact"],
        }  # fmt: skip
        text = str(make_result(converged=False, settled=False, contradictions=[node]))
        assert "node (7, 9): as film its gap is -6.00e-01 nm, as contact its pressure -1.40e-02 p_h" in text
        assert "lubricated, cavitated, lubricated, contact" in text

    def test_a_long_list_is_cut_and_says_so(self):
        nodes = [{"i": k, "j": 1, "size": 0.1} for k in range(1, 51)]
        result = make_result(pressure_inequality=InequalityResult(60, 50, 0.1, 1.2, nodes))
        text = str(result)
        assert text.count("Eq. 2 violated at node") == 20
        assert "30 more" in text

    @pytest.mark.parametrize(
        "verdict, advice", [("coarse", "expect the film to change"), ("grid-determined", "the grid's")]
    )
    def test_a_coarse_inlet_is_a_warning(self, verdict, advice):
        assert advice in str(make_result(resolution=Resolution(0.5, verdict)))

    def test_of_rough_bodies_it_does_not_decide_on_the_contact(self):
        smooth = make_result(resolution=Resolution(0.5, "grid-determined"))
        rough = replace(smooth, mixed=MIXED)
        assert "contact set is the grid's" in str(smooth) and "contact set" not in str(rough)
        assert "another film between the peaks" in str(rough)

    def test_the_gap_in_contact_is_compared_with_the_layers_that_keep_it(self):
        contact = make_result().contact
        layers = replace(contact, largest_gap_nm=2.0, kept_gap_nm=2.0)
        assert "largest gap 0.0e+00 nm" in str(make_result())
        assert "; largest gap 2 nm, the boundary film is 2 nm" in str(make_result(contact=layers))
        none = replace(layers, nodes=0, largest_gap_nm=0.0)
        assert "largest gap 0.0e+00 nm" in str(make_result(contact=none))

    def test_a_surface_that_the_grid_does_not_show_is_a_warning(self):
        assert "surface" not in str(make_result())
        unseen = Resolution(5.0, "resolved", "sufficient", 0.1, "grid-determined", 2.5)
        text = str(make_result(resolution=unseen))
        assert "  surface: 2.5 nodes in its shortest wave: THE SURFACE IS THE GRID'S" in text
