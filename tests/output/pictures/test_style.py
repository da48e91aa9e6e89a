"""The style file, what is laid over it, and saving."""

import matplotlib
import pytest
from matplotlib.colors import to_hex

from mgehl.errors import UserError
from mgehl.output.pictures import style

OKABE_ITO = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555"}


@pytest.fixture
def figure():
    with style.applied():
        figure, axes = style.subplots(size=(3.0, 2.0))
        axes.plot([0, 1], [0, 1], color=style.PRESSURE)
        axes.set(xlabel="X", ylabel="pressure, GPa")
    return figure


def test_lines_have_the_colours_that_are_told_apart():
    with style.applied():
        assert {to_hex(colour) for colour in style.COLOURS} == OKABE_ITO
        assert len(style.MARKS) == len(style.COLOURS)


def test_nothing_of_it_stays():
    before = dict(matplotlib.rcParams)
    with style.applied():
        assert matplotlib.rcParams["font.size"] == 9
        assert matplotlib.rcParams["figure.dpi"] == 150
    assert dict(matplotlib.rcParams) == before


def test_a_file_is_laid_over_it_and_the_outermost_decides(tmp_path):
    own = tmp_path / "own.mplstyle"
    own.write_text("font.size: 13  # large\n")
    with style.applied(own, dpi=300):
        with style.applied():
            assert matplotlib.rcParams["font.size"] == 13
            assert matplotlib.rcParams["image.cmap"] == "viridis"
            assert matplotlib.rcParams["figure.dpi"] == matplotlib.rcParams["savefig.dpi"] == 300
    with style.applied():
        assert matplotlib.rcParams["font.size"] == 9


@pytest.mark.parametrize("text, named", [("font.sise: 3", "font.sise"), ("font.size: big", "font.size")])
def test_a_line_that_means_nothing_is_an_error_of_one_line(tmp_path, text, named):
    wrong = tmp_path / "wrong.mplstyle"
    wrong.write_text(text + "\n")
    with pytest.raises(UserError, match=f"wrong.mplstyle: no style of matplotlib: .*{named}") as error:
        with style.applied(wrong):
            pass
    assert "\n" not in str(error.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(UserError, match="none.mplstyle: cannot be read: No such file"):
        with style.applied(tmp_path / "none.mplstyle"):
            pass


@pytest.mark.parametrize(
    "ending, begin", [("png", b"\x89PNG\r\n"), ("pdf", b"%PDF-"), ("svg", b"<?xml version=")]
)
def test_every_format_and_the_same_file_each_time(tmp_path, figure, ending, begin):
    path = tmp_path / f"picture.{ending}"
    with style.applied():
        style.save(figure, path)
        assert path.read_bytes() == style.rendered(figure, ending)
    assert path.read_bytes().startswith(begin)
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


def test_dpi_is_that_of_the_bitmap(tmp_path):
    sizes = []
    for dpi in (50, 100):
        with style.applied(dpi=dpi):
            figure, _ = style.subplots(size=(3.0, 2.0))
            style.save(figure, tmp_path / "small.png")
        sizes.append(matplotlib.image.imread(tmp_path / "small.png").shape[0])
    assert sizes[1] == pytest.approx(2 * sizes[0], abs=3)


def test_a_legend_outside_of_the_figure_is_in_the_file(tmp_path):
    """What is saved is cut to what there is."""
    heights = []
    for label in ("one", ""):
        with style.applied():
            figure, axes = style.subplots(size=(3.0, 2.0))
            line = axes.plot([0, 1], [0, 1], label=label)
            if label:
                style.legend_under_all(figure, line * 2)
                assert [text.get_text() for text in figure.legends[0].get_texts()] == ["one"]
            style.save(figure, tmp_path / "small.png")
        heights.append(matplotlib.image.imread(tmp_path / "small.png").shape[0])
    assert heights[0] > heights[1] + 20


def test_a_picture_that_cannot_be_written_leaves_the_old_one(tmp_path, figure, monkeypatch):
    path = tmp_path / "picture.png"
    path.write_bytes(b"old")

    def full(_self, _content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with style.applied(), pytest.raises(OSError, match="No space"):
        style.save(figure, path)
    assert path.read_bytes() == b"old"
    assert [each.name for each in tmp_path.iterdir()] == ["picture.png"]
