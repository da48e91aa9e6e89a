"""All pictures of a run, for users of the Python interface."""

import pytest
from matplotlib.figure import Figure

from mgehl.errors import UserError
from mgehl.output.pictures.figures import compared, draw_all, figures


def test_a_point_contact_has_them_all(make_solution):
    pictures = figures(make_solution())
    assert [picture.name for picture in pictures] == ["lines", "film", "pressure", "status", "history"]
    assert all(isinstance(picture.figure, Figure) and picture.title for picture in pictures)


def test_a_line_contact_and_a_wedge_have_what_makes_sense(make_line, make_wedge):
    assert [picture.name for picture in figures(make_line())] == ["lines", "history"]
    assert [picture.name for picture in figures(make_wedge())] == ["lines", "pressure", "status", "history"]


def test_texts_of_a_wedge(make_wedge, check_texts):
    for name, words in {
        "lines": ("X, mm", "pressure, MPa"), "pressure": ("X, mm", "Y, mm"), "status": ("X, mm", "Y, mm"),
    }.items():  # fmt: skip
        (picture,) = figures(make_wedge(), [name])
        check_texts(picture.figure, *words)


def test_a_kind_that_a_contact_does_not_have(make_line):
    with pytest.raises(UserError, match="no picture 'film' of this contact: it has lines, history"):
        figures(make_line(), ["history", "film"])


def test_draw_all_writes_every_format(make_line, tmp_path):
    paths = draw_all(make_line(), tmp_path / "new", ("png", "svg", "pdf"))
    names = [f"{name}.{form}" for name in ("lines", "history") for form in ("png", "svg", "pdf")]
    assert [path.name for path in paths] == names
    assert {path.name for path in (tmp_path / "new").iterdir()} == set(names)
    assert all(path.stat().st_size > 1000 for path in paths)


def test_comparison(make_line):
    names = [picture.name for picture in compared([make_line(65), make_line(129)], ["a", "b"])]
    assert names == ["compare-lines", "compare-history"]
