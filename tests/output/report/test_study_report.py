import pytest
from told import refusal

from mgehl.errors import OutputError
from mgehl.output.report.page import render
from mgehl.output.report.study_report import study_report
from mgehl.output.study_directory import StudyRecord, read_record, write_record

STUDIES = {"wedge": "what wedge is", "grid": "what grid is"}
RECORD = StudyRecord("wedge", (65, 129), 2, {"mgehl": "0.1.0", "petsc": "3.18.5"})


@pytest.fixture
def directory(tmp_path):
    directory = tmp_path / "mine"
    directory.mkdir()
    (directory / "cases.csv").write_text('case,"P(22,0)",order\n<b>,0.5,\nblocked exit,-1e-3,2.01\n')
    for k in (10, 9):
        (directory / f"figure_{k}.png").write_bytes(b"\x89PNG %d" % k)
    (directory / "cases.md").write_text("| not shown |")
    (directory / "points").mkdir()
    write_record(directory, RECORD)
    return directory


def test_tables(directory):
    page = study_report(directory, STUDIES)
    (table,) = page["tables"]
    assert [text for text, _ in table["columns"]] == ["case", "P(22,0)", "order"]
    assert [kind for _, kind in table["columns"]][1:] == ["number", "number"]
    texts = [[text for text, _ in row] for row in table["rows"]]
    assert texts == [["<b>", "0.5", ""], ["blocked exit", "-1e-3", "2.01"]]
    html = render(page)
    assert "&lt;b&gt;" in html and '<td class="number">2.01</td>' in html and "not shown" not in html
    assert html.index("figure 9") < html.index("figure 10")


def test_what_it_is_is_told_by_its_record(directory):
    page = study_report(directory, STUDIES)
    assert (page["title"], page["what"]) == ("Study wedge", ["Study wedge: what wedge is."])
    rows = dict(page["origin"])
    assert rows["grids"] == "65, 129" and rows["petsc"] == ("3.18.5", "code") and rows["ranks"] == "2"


@pytest.mark.parametrize(
    "content, said",
    [("", "empty"), ("a,b\n1\n", "cut off"), (b"\xff\xfe\x00", "damaged"), ('a\n"b', "damaged")],
)
def test_a_damaged_table_is_an_error_of_one_line(directory, content, said):
    path = directory / "cases.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    message = refusal(study_report, directory, STUDIES, error=OutputError)
    assert said in message and str(path) in message


@pytest.mark.parametrize("content", ["", "{}", "[1]", '{"name": 3}', "{"])
def test_a_damaged_record_is_an_error_of_one_line(tmp_path, content):
    (tmp_path / "study.json").write_text(content)
    assert "study.json: cannot be read" in refusal(read_record, tmp_path, error=OutputError)
