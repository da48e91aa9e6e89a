import pytest

from mgehl.cli import main

KINDS = ("lines", "film", "pressure", "status", "history")
RUN = ["run", "--quiet", "--set", "grid.nodes=65", "--out"]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    directory = tmp_path_factory.mktemp("runs")
    assert main([*RUN, str(directory / "dry")]) == 0
    assert main([*RUN, str(directory / "light"), "--set", "contact.load=400 N"]) == 0
    wedge = ["--set", "contact.kind=wedge", "--set", "wedge.pillar=square"]
    assert main([*RUN, str(directory / "wedge"), *wedge]) == 0
    return directory


@pytest.fixture
def words(runs, empty_directory):
    return lambda names, *options: ["plot", *(str(runs / name) for name in names.split()), *options]


def files(directory):
    return {str(path.relative_to(directory)) for path in directory.rglob("*") if path.is_file()}


def test_a_run_has_its_pictures_beside_it_as_bitmaps_and_vectors(words, runs, capsys):
    assert main(words("dry")) == 0
    plots = runs / "dry" / "plots"
    assert files(plots) == {f"{kind}.{form}" for kind in KINDS for form in ("png", "pdf")}
    assert set(capsys.readouterr().out.split()) == {str(plots / name) for name in files(plots)}


def test_several_runs_are_compared(words, tmp_path):
    assert main(words("dry light", "--format", "svg", "--dpi", "80")) == 0
    assert files(tmp_path) == {"plots/compare-lines.svg", "plots/compare-history.svg"}


@pytest.mark.parametrize(
    "names, options, said",
    [("dry", ["--kind", "films"], "--kind films: known are all, time, lines, film, pressure, status"),
     ("dry", ["--format", "png,gif"], "--format gif: known are png, svg, pdf"),
     ("dry", ["--kind", "compare"], "--kind compare: needs more than one run"),
     ("dry", ["--dpi", "9"], "--dpi 9: must be a whole number from 30 to 1200"),
     ("dry", ["--style", "none.mplstyle"], "none.mplstyle: cannot be read: No such file or directory"),
     ("wedge", ["--kind", "film"], "no picture 'film' of this contact: it has lines, pressure"),
     ("dry wedge", [], "runs of different kinds of contact have no common picture"),
     ("dry dry", [], "is given twice"), ("none", [], "none: is no run directory")],
)  # fmt: skip
def test_mistakes_end_in_one_line_and_nothing_is_written(words, tmp_path, refused, names, options, said):
    assert said in refused(*words(names, *options, "--out", "o"))
    assert files(tmp_path) == set()
