import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from made_solution import in_time, make_mixed
from mpi4py import MPI

import mgehl
from mgehl.output.files import plain_result
from mgehl.output.friction_result import FrictionResult, Temperatures
from mgehl.output.gap_error import GapError, GridGap
from mgehl.output.report.run_report import report, setting, verdict
from mgehl.output.result import Mean, TimeError

VOID = {"meta", "img", "br", "hr", "link", "input"}

CONTACT_TABLE = "Solid contact, and fluid against contact pressure across its edge"
CHECKS = "What was checked on the final state"
FILMS = "Computed films beside those of formulas for a full film"
MIXED_TABLE = "Film and contact of the rough bodies; films within the Hertz "
CONFIGURATION = (
    "Values that were used; in bold those that differ from the default, with the default beside them"
)


class Reader(HTMLParser):
    """Checks that elements are closed in order; collects tags, attributes, words, and tables by caption."""

    def __init__(self, html):
        super().__init__()
        self.open, self.tags, self.attributes, self.words, self.tables = [], [], [], [], {}
        self.feed(html)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += [(tag, *each) for each in attributes]
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.row = []
        if tag in ("td", "th"):
            self.row.append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag
        if tag == "tr" and "tbody" in self.open:
            self.tables[self.caption].append(self.row)

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.words.append(data.strip())
        if "caption" in self.open:
            self.caption = data
            self.tables[data] = []
        if self.open and self.open[-1] in ("td", "th"):
            self.row[-1] = data

    @property
    def text(self):
        return "\n".join(filter(None, self.words))

    @property
    def highlights(self):
        found = self.text.split("\nWhat was solved\n")[0].splitlines()[5:]
        return dict(zip(found[::2], found[1::2], strict=True))

    def rows(self, caption):
        return {row[0]: row[1:] for row in self.tables[caption]}


def solved(**settings):
    usual = {"grid.nodes": 65, "motion.speed": "1 m/s"}
    return mgehl.solve(mgehl.load(settings=usual | settings), MPI.COMM_SELF)


@pytest.fixture(scope="module")
def film_run():
    return solved(**{"solver.start": "film"})


@pytest.fixture(scope="module")
def line_run():
    return solved(**{"contact.kind": "line"})


@pytest.fixture(scope="module")
def wedge_run():
    return solved(**{"contact.kind": "wedge", "wedge.pillar": "square"})


@pytest.fixture(scope="module", params=["film_run", "line_run", "wedge_run"])
def run(request):
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def html(run):
    return report(run, "my-run")


@pytest.fixture
def quick(monkeypatch):
    """Function: the page, without pictures, which take the time, of a solution with another result."""
    monkeypatch.setattr("mgehl.output.report.run_report.pictures", lambda solution: [])
    return lambda solution, **result: Reader(report(changed(solution, **result), "my-run"))


def changed(solution, **result):
    return replace(solution, result=replace(solution.result, **result))


class TestEveryKind:
    def test_it_is_whole_and_needs_nothing_from_outside(self, html):
        reader = Reader(html)
        assert not re.search(r"https?://|//[a-z]|@import|url\(", re.sub(r'src="data:[^"]*"', "", html))
        targets = [value for _, name, value in reader.attributes if name in ("src", "href", "srcset")]
        assert targets and all(value.startswith(("data:image/", "#")) for value in targets)
        assert not {"script", "link", "iframe", "object"} & set(reader.tags)

    def test_name_verdict_and_versions_can_be_read(self, run, html):
        text = Reader(html).text
        assert "my-run" in text and verdict(run.result)[1] in text and run.result.reason in text
        assert all(name in text and version in text for name, version in run.result.versions.items())

    def test_every_key_of_the_configuration_with_its_value(self, run, quick):
        rows = quick(run).rows(CONFIGURATION)
        for section, table in run.config.as_toml_tables().items():
            for key, value in table.items():
                value = tuple(value) if isinstance(value, list) else value
                assert rows[f"{section}.{key}"][0].startswith(setting(value))
        assert rows["grid.nodes"][:2] == ["65", "257"] and rows["solver.max_steps"][:2] == ["400", ""]

    def test_every_field_of_the_result_and_every_cycle(self, run, quick):
        page = quick(run)
        record = page.rows("All fields of result.json")
        assert {name.split(".")[0] for name in record} == plain_result(run.result).keys()
        assert float(record["residual"][0]) == pytest.approx(run.result.residual, rel=1e-9)
        assert [float(row[0]) for row in page.tables["Every cycle"]] == [row["grid"] for row in run.rows]


@pytest.mark.parametrize("mark, settled", [("not converged", False), ("in doubt", True)])
def test_after_a_failure_every_number_says_so(film_run, quick, mark, settled):
    page = quick(film_run, converged=False, settled=settled)
    assert [name for name in page.highlights if not name.endswith(f" ({mark})")] == ["cells in the inlet"]
    assert {f"{FILMS} ({mark})", f"{CONTACT_TABLE} ({mark})"} <= page.tables.keys()
    assert page.rows(f"{FILMS} ({mark})")["Hamrock and Dowson"][1::2] == ["", ""], "nothing to compare"
    assert "(" not in "".join(quick(film_run).highlights)


def test_a_run_in_time_tells_its_means_and_that_other_numbers_are_those_at_its_end(film_run, quick):
    """Only the record had the means, and an instant stood on top as if it were all."""
    told = "mean_gap_nm", "max_pressure_GPa", "load_on_solids", "friction"
    error = TimeError("from there", means={"mean_gap_nm": 0.3})
    time = in_time(means=dict.fromkeys(told, Mean(200.25, 0.2)), error=error)
    page = quick(film_run, time=time, flux_imbalance=None)
    assert page.highlights["mean gap over the last passage"] == "200.2 ± 0.5 nm"
    assert "central film at the end" in page.highlights and "central film" not in page.highlights
    assert "Means over the last passage: mean gap 200.2 ± 0.5 nm" in page.text
    assert "imbalance of the flux" not in page.rows(CHECKS)


def sheared(temperatures):
    return FrictionResult(
        "eyring", 0.5, 0.25, 0.125, 0.125, 0.0, 0.03125, 0.0, -12.5, 7.5, -2.5, 4.0, 40.0, temperatures
    )


def test_what_resists_and_what_heat_takes_are_in_the_words_of_the_terminal(film_run, quick):
    friction = sheared(Temperatures(50.0, 60.0, 20.0, 90.0))
    result = changed(film_run, friction=friction, thermal_reduction=0.75, flux_imbalance=0.0)
    page = quick(result)
    words = str(result.result).splitlines()
    for each in ("friction 0.1", "flash temp", "this is the isothermal film; shear"):
        (line,) = [line.strip() for line in words if each in line]
        assert f"{line[0].upper()}{line[1:]}." in page.text
    assert page.highlights["friction coefficient"] == "0.12500"
    forces = page.tables["Forces on the bodies, positive along the motion"]
    told = {"on body 1": "-12.5", "on body 2": "7.5", "by rolling, mean of both": "-2.5"}
    assert forces == [[name, value, "N"] for name, value in told.items()]


class TestRoughBodies:
    """How film and contact share has a section; of smooth bodies there is none."""

    def test_mean_gaps_have_their_bands_and_the_grids_these_come_from(self, film_run, quick):
        grids = (
            GridGap(257, 13.74, 2.911, 0.1319, True, max_pressure_GPa=1.5, solid_load_fraction=0.125),
            GridGap(129, 13.84, 2.976, 0.1219, True, max_pressure_GPa=1.25, solid_load_fraction=0.125),
        )
        error = GapError(0.06, 0.05, "from the differences to 129 nodes", grids, 1.0, 0.125, 0.01)
        page = quick(film_run, mixed=make_mixed(error=error), max_pressure_band_GPa=0.125)
        values = [value for _, value, _ in page.tables[MIXED_TABLE + "ellipse"]]
        assert {"13.74 ± 0.06", "2.91 ± 0.05", "25"} <= set(values)
        assert page.tables["The grids that the bands come from"] == [
            ["257", "13.74", "2.911", "1.5", "0.1319", "0.125"],
            ["129", "13.84", "2.976", "1.25", "0.1219", "0.125"],
        ]
        assert page.highlights["mean gap"] == "13.74 ± 0.06 nm"
        assert page.highlights["load on contact"] == "12.5 ± 1.0 %"
        assert "± 0.13 GPa" in page.highlights["largest pressure"]
        assert "from the differences to 129 nodes; the grid's: the load on solids." in page.text


def test_a_residual_that_rounding_leaves_holds_on_the_page_too():
    """A light roller on many nodes: above the tolerance, and as small as pressures have digits."""
    light = {"contact.kind": "line", "contact.load_per_length": "1 N/mm", "contact.radius_x": "10 mm",
             "motion.speed": "5 m/s", "grid.nodes": 4097, "solver.error": False}  # fmt: skip
    solution = mgehl.solve(mgehl.Config().with_(light))
    result = solution.result
    assert result.converged and solution.config.solver.tolerance < result.residual <= result.residual_limit
    for limit, is_broken in ((result.residual_limit, False), (None, True)):
        solution.result = replace(result, residual_limit=limit)
        words = Reader(report(solution, "light")).words
        assert any("broken" in word for word in words) is is_broken
