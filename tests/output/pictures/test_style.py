import matplotlib
import pytest

from mgehl.errors import UserError
from mgehl.output.pictures import style


@pytest.fixture
def figure():
    with style.applied():
        figure, axes = style.subplots(size=(3.0, 2.0))
        axes.plot([0, 1], [0, 1], color=style.PRESSURE)
        axes.set(xlabel="X", ylabel="pressure, GPa")
    return figure


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
