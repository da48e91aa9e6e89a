"""The page of a study, from its files."""

import re
from base64 import b64encode

import pytest

from mgehl.errors import OutputError
from mgehl.output.report.page import render
from mgehl.output.report.study_record import StudyRecord, read_record, write_record
from mgehl.output.report.study_report import is_study, study_report

STUDIES = {"wedge": "what wedge is", "grid": "what grid is"}
RECORD = StudyRecord("wedge", (65, 129), 2, {"mgehl": "0.1.0", "petsc": "3.18.5"})


@pytest.fixture
def directory(tmp_path):
    """What a study leaves."""
    directory = tmp_path / "mine"
    directory.mkdir()
    (directory / "cases.csv").write_text('case,"P(22,0)",order\n<b>,0.5,\nblocked exit,-1e-3,2.01\n')
    for k in (10, 9):
        (directory / f"figure_{k}.png").write_bytes(b"\x89PNG %d" % k)
    (directory / "cases.md").write_text("| not shown |")
    (directory / "points").mkdir()
    return directory


def blocks_of(page, anchor):
    (section,) = [each for each in page.sections if each.anchor == anchor]
    return section.blocks


def test_tables(directory):
    (table,) = blocks_of(study_report(directory, STUDIES), "tables")
    assert [cell.text for cell in table.columns] == ["case", "P(22,0)", "order"]
    assert [cell.kind for cell in table.columns][1:] == ["number", "number"]
    assert [[cell.text for cell in row] for row in table.rows] == [
        ["<b>", "0.5", ""],
        ["blocked exit", "-1e-3", "2.01"],
    ]
    html = render(study_report(directory, STUDIES))
    assert "&lt;b&gt;" in html and '<td class="number">2.01</td>' in html and "not shown" not in html


def test_pictures_in_the_order_of_their_numbers(directory):
    pictures = blocks_of(study_report(directory, STUDIES), "pictures")
    assert [each.caption for each in pictures] == ["figure 9", "figure 10"]
    assert pictures[0].uri == "data:image/png;base64," + b64encode(b"\x89PNG 9").decode()
    assert all("figure" in each.alt for each in pictures)


def test_a_wide_picture_scrolls_on_a_narrow_page(directory):
    """1500 dots of 150 to the inch are ten inches; what is no picture is not wide."""
    header = b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR"
    for k, size in (9, (1500, 600)), (10, (600, 600)):
        (directory / f"figure_{k}.png").write_bytes(header + b"".join(n.to_bytes(4, "big") for n in size))
    (directory / "other.png").write_bytes(b"nothing")
    pictures = blocks_of(study_report(directory, STUDIES), "pictures")
    assert [each.inches for each in pictures] == [10.0, 0.0, 0.0]


def test_it_needs_nothing_from_outside(directory):
    html = re.sub(r'src="data:[^"]*"', "", render(study_report(directory, STUDIES)))
    assert not re.search(r"https?://|src=|url\(", html)


class TestWhatItIs:
    def said(self, directory):
        page = study_report(directory, STUDIES)
        return page.title, [text.text for text in blocks_of(page, "what")]

    def test_by_its_record(self, directory):
        write_record(directory, RECORD)
        assert self.said(directory) == ("Study wedge", ["Study wedge: what wedge is."])
        (table,) = blocks_of(study_report(directory, STUDIES), "origin")
        rows = dict([cell.text for cell in row] for row in table.rows)
        assert rows["grids"] == "65, 129" and rows["petsc"] == "3.18.5" and rows["ranks"] == "2"

    def test_by_the_name_of_its_directory(self, directory):
        named = directory.rename(directory.with_name("study-grid"))
        assert self.said(named) == ("Study grid", ["Study grid: what grid is."])

    def test_by_the_names_of_its_tables(self, directory):
        (directory / "cases.csv").rename(directory / "wedge-cases.csv")
        (directory / "grid-film.csv").write_text("a\n1\n")
        assert self.said(directory) == (
            "Studies in mine",
            ["Study wedge: what wedge is.", "Study grid: what grid is."],
        )

    def test_not_at_all(self, directory):
        title, (text,) = self.said(directory)
        assert title == "Studies in mine" and "do not name" in text


def test_what_is_a_study(directory, tmp_path):
    assert is_study(directory)
    assert not is_study(tmp_path) and not is_study(tmp_path / "none")
    (directory / "history.csv").touch()
    assert not is_study(directory), "a run has tables, too"


@pytest.mark.parametrize(
    "content, said",
    [("", "empty"), ("a,b\n1\n", "cut off"), (b"\xff\xfe\x00", "damaged"), ('a\n"b', "damaged")],
)
def test_a_damaged_table_is_an_error_of_one_line(directory, content, said):
    path = directory / "cases.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(OutputError, match=said) as caught:
        study_report(directory, STUDIES)
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)


class TestRecord:
    def test_it_is_read_as_written(self, tmp_path):
        assert read_record(tmp_path) is None
        write_record(tmp_path, RECORD)
        assert read_record(tmp_path) == RECORD

    @pytest.mark.parametrize("content", ["", "{}", "[1]", '{"name": 3}', "{"])
    def test_a_damaged_one_is_an_error_of_one_line(self, tmp_path, content):
        (tmp_path / "study.json").write_text(content)
        with pytest.raises(OutputError, match="study.json: cannot be read") as caught:
            read_record(tmp_path)
        assert "\n" not in str(caught.value)

    def test_a_directory_that_is_not_there(self, tmp_path):
        with pytest.raises(OutputError, match="study.json: cannot be written: No such file"):
            write_record(tmp_path / "none", RECORD)
