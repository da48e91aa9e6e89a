"""Studies error and gaps: what is drawn, how a band is judged, what is said of all."""

import csv
from math import nan
from types import SimpleNamespace

import pytest
from mpi4py import MPI

from mgehl.cli import main
from mgehl.output.film_error import FilmError, GridFilm, no_band
from mgehl.studies import error, gaps
from mgehl.studies.bands import Band, cells, summary
from mgehl.studies.study import Study


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_films_of_a_random_contact(tmp_path):
    error.run(Study(tmp_path, MPI.COMM_SELF, (65,), speak=False, wanted=2, seed=3))
    rows, bands = read(tmp_path / "cases.csv"), read(tmp_path / "bands.csv")
    assert [row["contact"] for row in rows] == list(error.draw(2, 3))
    assert [row["nodes"] for row in rows] == ["65", "65"]
    for row in rows:
        film, half_width = map(float, row["central nm"].split(" ± "))
        off = abs(float(row["central limit nm"]) - film)
        assert row["central band/error"].endswith("!") == (off > half_width)
    assert [(row["of"], row["bands"]) for row in bands] == [("central", "2"), ("minimum", "2")]


def test_gaps_of_a_ball_on_two_grids(tmp_path):
    """Of a seed whose first surface 65 nodes show."""
    here, grids = tmp_path / "gaps", ["--nodes", "65,129", "--cases", "1", "--seed", "36"]
    assert main(["study", "gaps", *grids, "--quiet", "--out", str(here)]) == 0
    (row,) = read(here / "gaps.csv")
    assert row["converged"] == "yes yes" and 0.0 < float(row["more work %"]) < 100.0
    for gap in ("mean gap", "by pressure"):
        nm, half_width = map(float, row[f"{gap} nm"].split(" ± "))
        off = abs(float(row[f"{gap} limit nm"]) - nm)
        assert row[f"{gap} band/error"].endswith("!") == (off > half_width)
    assert [row["of"] for row in read(here / "gaps-summary.csv")] == ["mean gap", "by pressure"]


@pytest.mark.parametrize("nodes", ["65", "65,129,257", "65,257"])
def test_gaps_take_two_grids_one_twice_as_fine(nodes, tmp_path, capsys):
    assert main(["study", "gaps", "--nodes", nodes, "--out", str(tmp_path / "gaps")]) == 2
    assert nodes.split(",")[0] in capsys.readouterr().err


def test_a_longer_list_of_random_contacts_begins_with_the_same_ones():
    assert gaps.draw(9, 7)[:3] == gaps.draw(3, 7) != gaps.draw(3, 8)
    drawn = error.draw(40, 7)
    assert list(drawn)[:3] == list(error.draw(3, 7)) != list(error.draw(3, 8))
    for contact in drawn.values():
        assert 10.0 <= contact["moes"]["M"] <= 2000.0 and 2.0 <= contact["moes"]["L"] <= 14.0


def test_the_limit_of_films_is_richardsons():
    grids = tuple(GridFilm(n, 4.0 * h, h, 0, True) for n, h in ((129, 10.0), (65, 7.0)))
    assert error.limits_of(FilmError(1.0, 1.0, "", 2, grids=grids)) == {"central": 44.0, "minimum": 11.0}
    assert str(error.limits_of(no_band("contact"))["central"]) == "nan"


def found(gap, band=None, settled=True):
    """As much of a `Result` as a band is judged by."""
    error = SimpleNamespace(mean_nm=band)
    return SimpleNamespace(mixed=SimpleNamespace(mean_gap_nm=gap, error=error), settled=settled)


def test_the_limit_of_gaps_lies_a_third_of_the_difference_beyond_the_finer_grid():
    assert gaps.band_of("mean", found(10.0, 0.5), found(10.3)) == pytest.approx((10.0, 0.5, 10.4))
    assert not gaps.band_of("mean", found(10.0, 0.5), found(10.3, settled=False)).known
    assert not gaps.band_of("mean", found(10.0), found(10.3)).known


@pytest.mark.parametrize(
    "band, text",
    [
        (Band(10.0, 1.0, 10.5), "2.00"), (Band(10.0, 0.5, 11.0), "0.50 !"),
        (Band(10.0, None, 11.0), ""), (Band(10.0, 1.0, nan), ""),
    ],
)  # fmt: skip
def test_a_band_that_does_not_hold_is_marked(band, text):
    assert cells("film", band)["film band/error"] == text


def test_the_summary_counts_what_is_held():
    bands = {"film": [Band(10.0, width, 11.0) for width in (0.5, 2.0, 4.0, None)], "none": []}
    row, none = summary(bands)
    assert (row["bands"], row["hold the limit"], row["in %"]) == ("3", "2", "67")
    assert row["median of half-width/error"] == "2.00"
    assert none["bands"] == "0" and none["median error %"] == "none"
