"""The page of a run: everything that the run says is on it, whatever its kind."""

import re
from dataclasses import fields, replace
from html.parser import HTMLParser
from math import nan

import pytest
from mpi4py import MPI

import mgehl
from mgehl.output.film_error import no_band
from mgehl.output.gap_error import GapError, GridGap
from mgehl.output.mixed_result import MixedResult
from mgehl.output.report.loaded import film
from mgehl.output.report.page import BAD, DOUBTFUL, GOOD, NO_NUMBER, render
from mgehl.output.report.parts import LONG_HISTORY, history_section, setting
from mgehl.output.report.run_report import report, verdict
from mgehl.solver.inequality import Power

VOID = {"meta", "img", "br", "hr", "link", "input"}
SMALL = {"grid.nodes": 65}
CHECKS = "What was checked on the final state"
CONTACT_TABLE = "Solid contact, and fluid against contact pressure across its edge"
FILMS = "Computed films beside those of formulas for a full film"


class Reader(HTMLParser):
    """Checks that elements are closed in order; collects tags, attributes and text."""

    def __init__(self, html):
        super().__init__()
        self.open, self.tags, self.attributes, self.words = [], [], [], []
        self.feed(html)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += [(tag, *each) for each in attributes]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.words.append(data.replace("\xa0", " ").strip())

    @property
    def text(self):
        return "\n".join(filter(None, self.words))


@pytest.fixture(scope="module")
def film_run():
    settings = SMALL | {"motion.speed": "1 m/s", "solver.start": "film"}
    return mgehl.solve(mgehl.load(settings=settings), MPI.COMM_SELF)


@pytest.fixture(scope="module")
def line_run():
    settings = SMALL | {"contact.kind": "line", "motion.speed": "1 m/s"}
    return mgehl.solve(mgehl.load(settings=settings), MPI.COMM_SELF)


@pytest.fixture(scope="module")
def wedge_run():
    settings = SMALL | {"contact.kind": "wedge", "wedge.pillar": "square", "motion.speed": "1 m/s"}
    return mgehl.solve(mgehl.load(settings=settings), MPI.COMM_SELF)


@pytest.fixture(scope="module", params=["film_run", "line_run", "wedge_run"])
def run(request):
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def html(run):
    """The run's whole page, pictures and all."""
    return render(report(run, "my-run"))


@pytest.fixture
def quick(monkeypatch):
    """Function that makes a page without pictures, which take the time."""
    monkeypatch.setattr("mgehl.output.report.run_report.pictures", lambda solution: {})
    return lambda solution: report(solution, "my-run")


def changed(solution, **result):
    return replace(solution, result=replace(solution.result, **result))


def table_of(page, caption):
    """Rows of text of the table with a caption."""
    tables = [block for section in page.sections for block in section.blocks if block.block == "table"]
    (found,) = [each for each in tables if each.caption == caption]
    return [[cell.text for cell in row] for row in found.rows]


class TestEveryKind:
    def test_it_is_whole_and_needs_nothing_from_outside(self, html):
        reader = Reader(html)
        assert not re.search(r"https?://|//[a-z]|@import|url\(", re.sub(r'src="data:[^"]*"', "", html))
        targets = [value for _, name, value in reader.attributes if name in ("src", "href", "srcset")]
        assert targets and all(value.startswith(("data:image/", "#")) for value in targets)
        assert not {"script", "link", "iframe", "object"} & set(reader.tags)

    def test_what_readers_and_their_tools_rely_on(self, html):
        reader = Reader(html)
        assert ("html", "lang", "en") in reader.attributes
        assert [reader.tags.count(tag) for tag in ("title", "h1", "nav", "main")] == [1, 1, 1, 1]
        assert reader.tags.count("caption") == reader.tags.count("table") > 5
        alternatives = [value for tag, name, value in reader.attributes if (tag, name) == ("img", "alt")]
        assert len(alternatives) == reader.tags.count("img") and all(map(len, alternatives))
        ids = [value for _, name, value in reader.attributes if name == "id"]
        assert len(ids) == len(set(ids))
        links = [value[1:] for tag, name, value in reader.attributes if (tag, name) == ("a", "href")]
        assert links and set(links) <= set(ids)

    def test_name_verdict_and_versions_can_be_read(self, run, html):
        text = Reader(html).text
        assert "my-run" in text and verdict(run.result).words in text and run.result.reason in text
        assert all(name in text and version in text for name, version in run.result.versions.items())

    def test_every_key_of_the_configuration_with_its_value(self, run, quick):
        rows = configuration_of(quick(run))
        expected = {
            f"{section}.{key}": value
            for section, table in run.config.as_toml_tables().items()
            for key, value in table.items()
        }
        assert rows.keys() >= expected.keys()
        for name, value in expected.items():
            value = tuple(value) if isinstance(value, list) else value
            assert rows[name][0].startswith(setting(value))
        assert {rows[name][0] for name in rows.keys() - expected.keys()} <= {"unset"}

    def test_what_differs_from_the_default_says_so(self, run, quick):
        rows = configuration_of(quick(run))
        assert rows["grid.nodes"][:2] == ["65", "257"]
        assert rows["motion.speed"][1] == "5e-06 m/s"
        assert rows["solver.max_steps"][:2] == ["200", ""]

    def test_every_field_of_the_result(self, run, quick):
        record = dict(table_of(quick(run), "All fields of result.json"))
        names = {name.split(".")[0] for name in record}
        assert names == {field.name for field in fields(run.result)}
        assert record["reason"] == run.result.reason
        assert float(record["residual"]) == pytest.approx(run.result.residual, rel=1e-9)

    def test_a_hostile_reason_is_only_words(self, run, quick):
        reader = Reader(render(quick(changed(run, reason="<script>alert(1)</script><img src=x>"))))
        assert not {"script", "img"} & set(reader.tags)
        assert "<script>alert(1)</script><img src=x>" in reader.text

    @pytest.mark.parametrize("lost", [nan, None])
    def test_numbers_that_are_none_are_called_so(self, run, quick, lost):
        page = quick(changed(run, residual=lost, flux_imbalance=lost, converged=False))
        checks = {row[0]: row[1:] for row in table_of(page, CHECKS)}
        (residual,) = [row for name, row in checks.items() if name.startswith("residual")]
        assert residual[0] == NO_NUMBER and residual[2] == "broken"
        assert checks["imbalance of the flux"][0] == NO_NUMBER
        assert not re.search(r"\b(nan|NaN|None|null)\b", Reader(render(page)).text)

    def test_every_cycle_is_there(self, run, quick):
        rows = table_of(quick(run), "Every cycle")
        assert [float(row[0]) for row in rows] == [row["grid"] for row in run.rows]

    def test_a_run_without_history(self, run):
        page = report(replace(run, rows=[]), "my-run")
        assert "No cycle was recorded." in Reader(render(page)).text


def configuration_of(page):
    """Key: value, default where it differs, meaning."""
    (section,) = [each for each in page.sections if each.anchor == "configuration"]
    rows = table_of(page, section.blocks[0].caption)
    return {row[0]: row[1:] for row in rows if len(row) > 1}


def pictures_of(html):
    return re.findall(r"<figcaption>(.*?)</figcaption>", html)


def test_pictures_of_each_kind(run, html):
    captions = pictures_of(html)
    if run.config.contact.kind == "line":
        assert len(captions) == 2, "a line contact has no maps"
    elif run.config.contact.kind == "wedge":
        assert len(captions) == 4 and captions[0] == "Pressure on the centre line."
    else:
        assert len(captions) == 5 and any("Film thickness" in caption for caption in captions)


def test_the_same_run_makes_the_same_page(line_run):
    assert render(report(line_run, "")) == render(report(line_run, ""))


class TestLoaded:
    def test_films_stand_beside_formulas(self, film_run, quick):
        result = film_run.result
        rows = {row[0]: row[1:] for row in table_of(quick(film_run), FILMS)}
        bands = result.error.central_nm, result.error.minimum_nm
        assert None not in bands
        central, minimum = map(film, (result.central_film_nm, result.minimum_film_nm), bands)
        assert rows["computed"] == [central, "", minimum, ""] and "±" in central
        formulas = result.formulas
        central, ratio, minimum, other = rows["Hamrock and Dowson"]
        assert central == film(formulas["hamrock_dowson_central_nm"])
        assert minimum == film(formulas["hamrock_dowson_minimum_nm"])
        assert float(ratio) == pytest.approx(result.central_film_nm / float(central), abs=1e-3)
        assert float(other) == pytest.approx(result.minimum_film_nm / float(minimum), abs=1e-3)
        assert rows["Ertel and Grubin"][2:] == ["", ""]

    def test_the_grids_that_bands_come_from_are_listed(self, film_run, quick):
        what = "Films of the grids that the bands come from, each compared at the same places"
        rows = table_of(quick(film_run), what)
        assert [row[0] for row in rows] == [str(each.nodes) for each in film_run.result.error.grids]

    def test_films_without_bands_say_why(self, film_run, quick):
        page = quick(changed(film_run, error=no_band("there is solid contact")))
        (films,) = [section for section in page.sections if section.anchor == "films"]
        assert [block.text for block in films.blocks if block.block == "text"] == [
            "No band: there is solid contact."
        ]
        assert not [block for block in films.blocks[1:] if block.block == "table"]

    def test_a_line_contact_has_its_own_formula(self, line_run, quick):
        rows = [row[0] for row in table_of(quick(changed(line_run, converged=True)), FILMS)]
        assert rows == ["computed", "of the Dowson-Higginson type", "Ertel and Grubin"]

    def test_dimensionless_groups(self, film_run, quick):
        rows = {row[0]: row[1] for row in table_of(quick(film_run), "Dimensionless groups")}
        groups = film_run.result.groups
        for name in "UWGML":
            assert float(rows[name]) == pytest.approx(getattr(groups, name), rel=1e-5)
        assert float(rows["H central"]) == pytest.approx(film_run.result.moes_film.central, rel=1e-5)

    @pytest.mark.parametrize(
        "nm, text",
        [(12.34567, "12.3457"), (-1e-9, "0.0000"), (3e8, "3e+08"), (nan, NO_NUMBER), (None, NO_NUMBER)],
    )
    def test_a_film_is_written_as_on_the_terminal(self, nm, text):
        assert film(nm) == text

    def test_violations_and_contradictions_are_folded_lists(self, film_run, quick):
        nodes = [{"i": 7, "j": k, "size": 0.25} for k in range(40)]
        inequality = replace(film_run.result.pressure_inequality, checked=50, violations=40, nodes=nodes)
        neither = {
            "i": 3, "j": 4, "film_gap_nm": -1.5, "contact_pressure": -0.125,
            "neighbours": ["lubricated", "contact", "lubricated", "cavitated"],
        }  # fmt: skip
        page = quick(changed(film_run, pressure_inequality=inequality, contradictions=[neither]))
        rows = table_of(page, "Nodes that break Eq. 2, counted from 1")
        assert rows[12] == ["7", "12", "0.25"] and len(rows) == 40
        assert table_of(page, "Nodes that can be neither film nor contact, counted from 1") == [
            ["3", "4", "-1.5", "-0.125", "lubricated, contact, lubricated, cavitated"]
        ]
        checks = {row[0]: row[1:] for row in table_of(page, CHECKS)}
        assert checks["interface nodes that break Eq. 2"] == ["40 of 50", "0", "broken"]
        assert checks["nodes that can be neither film nor contact"] == ["1", "0", "broken"]
        html = render(page)
        assert html.count("<details>") == 4
        assert "<summary>Nodes that break Eq. 2, counted from 1 (40 rows)</summary>" in html

    @pytest.mark.parametrize("undecided, verdict", [(5, "holds"), (6, "not decided on this grid")])
    def test_eq_2_may_not_be_decided(self, film_run, quick, undecided, verdict):
        inequality = replace(
            film_run.result.pressure_inequality, checked=40, power=Power(50, undecided, 0.1)
        )
        page = quick(changed(film_run, pressure_inequality=inequality))
        checks = {row[0]: row[1:] for row in table_of(page, CHECKS)}
        assert checks["interface nodes that break Eq. 2"] == ["0 of 40", "0", verdict]
        what = "faces where the tolerance is larger than contact's own pressure"
        assert [what, f"{undecided} of 50"] in table_of(page, CONTACT_TABLE)

    def test_the_load_and_speed_of_moes_numbers_are_no_keys(self, film_run, quick):
        config = mgehl.load(settings=SMALL | {"moes.M": 20.0, "moes.L": 10.0})
        names = configuration_of(quick(replace(film_run, config=config)))
        assert "moes.M" in names and "motion.speed" not in names and "contact.load" not in names


class TestWithoutSuccess:
    """After a failure every number says so, and nothing is compared with a formula."""

    MARKS = {"not converged": {"settled": False}, "in doubt": {"settled": True}}

    @pytest.mark.parametrize("mark", MARKS)
    def test_of_a_loaded_contact(self, film_run, quick, mark):
        page = quick(changed(film_run, converged=False, **self.MARKS[mark]))
        names = [name for name, _ in page.highlights]
        assert names[-1] == "cells in the inlet" and all(name.endswith(f" ({mark})") for name in names[:-1])
        rows = {row[0]: row[1:] for row in table_of(page, f"{FILMS} ({mark})")}
        assert f"computed ({mark})" in rows
        assert [rows["Hamrock and Dowson"][k] for k in (1, 3)] == ["", ""]
        for section in page.sections:
            if section.anchor in ("films", "contact", "mixed"):
                assert all(
                    each.caption.endswith(f"({mark})") for each in section.blocks if each.block == "table"
                )
        (groups,) = [section for section in page.sections if section.anchor == "groups"]
        own = [row for row in groups.blocks[1].rows if row[0].text.startswith("H ")]
        assert len(own) == 2 and all(row[2].text.endswith(f"({mark})") for row in own)

    def test_of_a_wedge(self, wedge_run, quick):
        page = quick(changed(wedge_run, converged=False))
        assert all(name.endswith(" (not converged)") for name, _ in page.highlights)

    def test_who_does_not_see_a_picture_is_told_too(self, line_run):
        html = render(report(changed(line_run, converged=False, settled=False), "my-run"))
        alternatives = [
            value for tag, name, value in Reader(html).attributes if (tag, name) == ("img", "alt")
        ]
        assert alternatives and all(" Not converged: " in text for text in alternatives)

    def test_a_success_has_no_mark(self, film_run, quick):
        page = quick(film_run)
        assert not any("(" in name for name, _ in page.highlights)


def test_a_film_without_a_band_says_so_on_top(film_run, quick):
    def central(solution):
        return dict(quick(solution).highlights)["central film"]

    assert "±" in central(film_run)
    assert central(changed(film_run, error=no_band("not asked for"))).endswith(" nm, no band")


class TestRoughBodies:
    """How film and contact share has a section; of smooth bodies there is none."""

    MIXED = MixedResult(0.25, 80.0, 0.125, 0.875, 3e-9, 0.0625, 7, 1e-9, 40.0, None, 90.0, 0.015)

    def test_every_number_with_its_unit(self, film_run, quick):
        page = quick(changed(film_run, mixed=self.MIXED))
        rows = table_of(page, "Film and contact of the rough bodies; films within the Hertz ellipse")
        values = {(value, unit) for _, value, unit in rows}
        assert values == {
            ("0.25", ""), ("80", "nm"), ("12.5", "%"), ("87.5", "%"), ("3000", "µm²"), ("6.25", "%"),
            ("7", ""), ("1000", "µm²"), ("40", "nm"), (NO_NUMBER, "nm"), ("90", "nm"), ("1.5", "%"),
        }  # fmt: skip
        assert all(row[0] != "boundary film that keeps it, nm" for row in table_of(page, CONTACT_TABLE))
        assert ("lambda", "0.25") in page.highlights and ("load on contact", "12.5 %") in page.highlights

    def test_mean_gaps_have_their_bands_and_the_grids_these_come_from(self, film_run, quick):
        grids = (
            GridGap(257, 13.74, 2.911, 0.1319, True, max_pressure_GPa=1.5, solid_load_fraction=0.125),
            GridGap(129, 13.84, 2.976, 0.1219, True),  # as in older results
        )
        error = GapError(0.06, 0.05, "from the differences to 129 nodes", grids, 1.0, 0.125, 0.01)
        gaps = {"mean_gap_nm": 13.74, "loaded_gap_nm": 2.911, "near_contact_load_share": 0.25}
        page = quick(changed(film_run, mixed=replace(self.MIXED, **gaps, error=error)))
        rows = table_of(page, "Film and contact of the rough bodies; films within the Hertz ellipse")
        values = [value for _, value, _ in rows[-3:]]
        assert values == ["13.74 ± 0.06", "2.91 ± 0.05", "25"]
        assert table_of(page, "The grids that the bands come from") == [
            ["257", "13.74", "2.911", "1.5", "13.19", "12.5"],
            ["129", "13.84", "2.976", NO_NUMBER, "12.19", NO_NUMBER],
        ]
        assert ("mean gap", "13.74 ± 0.06 nm") in page.highlights
        assert ("load on contact", "12.5 ± 1.0 %") in page.highlights
        assert any(name == "largest pressure" and "± 0.13 GPa" in text for name, text in page.highlights)
        (section,) = [each for each in page.sections if each.anchor == "mixed"]
        (words,) = [each.text for each in section.blocks if each.block == "text"]
        assert words.endswith("from the differences to 129 nodes; the grid's: the load on solids.")

    def test_a_load_that_the_grid_does_not_hold_is_the_grid_s(self, film_run, quick):
        error = GapError(0.1, 0.1, "from them", (GridGap(65, 9.0, 3.0, 0.1, True, max_pressure_GPa=1.0),))
        page = quick(changed(film_run, mixed=replace(self.MIXED, error=error)))
        assert ("load on contact", "12.5 %, the grid's") in page.highlights

    def test_what_solids_and_pockets_carry(self, film_run, quick):
        mixed = replace(self.MIXED, solid_load_fraction=0.0625, sealed_load_fraction=0.03125)
        rows = table_of(
            quick(changed(film_run, mixed=mixed)),
            "Film and contact of the rough bodies; films within the Hertz ellipse",
        )
        assert ["part of the load that solids carry", "6.25", "%"] in rows
        assert ["part of the load on pockets that contact shuts in", "3.125", "%"] in rows

    def test_the_boundary_film_stands_beside_the_gap_it_keeps(self, film_run, quick):
        contact = replace(film_run.result.contact, largest_gap_nm=2.0, kept_gap_nm=2.0)
        rows = table_of(quick(changed(film_run, contact=contact, mixed=self.MIXED)), CONTACT_TABLE)
        assert rows[5:7] == [
            ["largest |gap| in contact, nm", "2"],
            ["boundary film that keeps it, nm", "2"],
        ]

    def test_a_coarse_inlet_does_not_decide_on_their_contact(self, film_run, quick):
        resolution = replace(film_run.result.resolution, inlet_cells=0.5, verdict="grid-determined")
        said = [
            table_of(quick(changed(film_run, resolution=resolution, mixed=mixed)), CHECKS)
            for mixed in (None, self.MIXED)
        ]
        words = [dict((row[0], row[-1]) for row in rows)["cells in the inlet"] for rows in said]
        assert "contact set is the grid's" in words[0] and "film between the peaks" in words[1]

    def test_a_line_contact_s_areas_are_of_a_metre(self, line_run, quick):
        page = quick(changed(line_run, converged=True, mixed=replace(self.MIXED, per_metre=True)))
        rows = table_of(page, "Film and contact of the rough bodies; films within the Hertz width")
        assert ["largest patch", "1000", "µm² in each metre"] in rows

    def test_smooth_bodies_have_none(self, film_run, quick):
        assert film_run.result.mixed is None
        page = quick(film_run)
        assert "mixed" not in [section.anchor for section in page.sections]
        assert "lambda" not in dict(page.highlights)


class TestVerdict:
    def judged(self, solution, **result):
        found = verdict(changed(solution, **result).result)
        return found.kind, found.words

    def test_of_a_loaded_contact(self, film_run):
        assert self.judged(film_run) == (GOOD, "Converged")
        settled = {"converged": False, "settled": True}
        assert self.judged(film_run, **settled) == (DOUBTFUL, "Settled, but Eq. 2 is broken")
        assert self.judged(film_run, converged=False, settled=False) == (BAD, "Not converged")
        overlap = replace(film_run.result.overlap, nodes=3)
        assert self.judged(film_run, overlap=overlap) == (DOUBTFUL, "Converged, but the bodies overlap")

    def test_of_a_wedge(self, wedge_run):
        assert self.judged(wedge_run) == (GOOD, "Converged")
        assert self.judged(wedge_run, converged=False) == (BAD, "Not converged")


def test_a_leak_through_solid_is_said(wedge_run, quick):
    page = quick(changed(wedge_run, closed_face_flow=12.5))
    checks = {row[0]: row[1:] for row in table_of(page, CHECKS)}
    leak = checks["largest flow through a face that contact closes"]
    assert leak == ["12", "0", "to be read with care"]


def test_long_histories_are_thinned_but_keep_the_last_cycle_of_each_grid():
    rows = [{"grid": 65, "step": k} for k in range(2001)] + [{"grid": 129, "step": 0}]
    _, every = history_section(rows).blocks
    steps = [int(row[1].text) for row in every.rows]
    assert len(steps) <= LONG_HISTORY + 1 and steps[-2:] == [2000, 0]
    assert every.caption == f"{len(steps)} of 2002 cycles"


@pytest.mark.parametrize(
    "value, unit, text",
    [
        (0.1 + 0.2, "m", "0.3 m"),
        (257, None, "257"),
        (True, None, "true"),
        (None, "m", "unset"),
        ((-1.9, 1.3), None, "-1.9 to 1.3"),
        ("barus", None, "barus"),
    ],
)
def test_values_of_the_configuration(value, unit, text):
    assert setting(value, unit) == text
