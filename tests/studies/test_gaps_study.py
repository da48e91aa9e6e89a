"""Study gaps on tiny grids: what is drawn, how a band is judged, what is said of all."""

import csv
from types import SimpleNamespace

import pytest

from mgehl.cli import main
from mgehl.studies.gaps import LAYERS, SHORTEST, _band, draw, summary


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_a_case_on_two_grids(tmp_path):
    """Of a seed whose first surface 65 nodes show."""
    here = tmp_path / "gaps"
    grids = ["--nodes", "65,129", "--cases", "1", "--seed", "36"]
    assert main(["study", "gaps", *grids, "--quiet", "--out", str(here)]) == 0
    (row,) = read(here / "gaps.csv")
    assert row["converged"] == "yes yes"
    for gap in ("mean gap", "by pressure"):
        nm, limit, band = (float(row[f"{gap} {what}"]) for what in ("nm", "limit nm", "band %"))
        off = 100.0 * abs(limit - nm) / nm
        assert float(row[f"{gap} off by %"]) == pytest.approx(off, abs=0.1)
        assert row[f"{gap} holds"] == ("yes" if off <= band else "no")
    assert 0.0 < float(row["of the band"]) < float(row["convolutions"])
    said = {each["what"]: each["value"] for each in read(here / "gaps-summary.csv")}
    assert said["cases"] == "1" and said["mean gap: bands that hold"].endswith("of 1")


@pytest.mark.parametrize("nodes", ["65", "65,129,257", "65,257"])
def test_it_takes_two_grids_one_twice_as_fine(nodes, tmp_path, capsys):
    assert main(["study", "gaps", "--nodes", nodes, "--out", str(tmp_path / "gaps")]) == 2
    assert nodes.split(",")[0] in capsys.readouterr().err


def test_more_cases_begin_with_the_same():
    assert draw(9, 7)[:3] == draw(3, 7) != draw(3, 8)
    assert {case.shortest for case in draw(40, 7)} == set(SHORTEST)
    assert {case.layers for case in draw(40, 7)} == set(LAYERS)


def found(gap, band=None, settled=True):
    """As much of a `Result` as a band is judged by."""
    error = SimpleNamespace(mean_nm=band)
    return SimpleNamespace(mixed=SimpleNamespace(mean_gap_nm=gap, error=error), settled=settled)


@pytest.mark.parametrize("band, holds", [(0.5, "yes"), (0.3, "no")])
def test_the_limit_lies_a_third_of_the_difference_beyond_the_finer_grid(band, holds):
    row = _band("mean", found(10.0, band), found(10.3))
    assert (row[" limit nm"], row[" off by %"], row[" holds"]) == ("10.4", "4.00", holds)


@pytest.mark.parametrize("band, settled", [(None, True), (0.5, False)])
def test_without_a_band_or_a_finer_answer_nothing_is_judged(band, settled):
    row = _band("mean", found(10.0, band), found(10.3, settled=settled))
    assert row[" nm"] == "10" and {row[" limit nm"], row[" holds"]} == {""}


def test_the_summary_counts_what_was_judged():
    def row(band, off, holds):
        of = {f"{gap} {what}": text for gap in ("mean gap", "by pressure")
              for what, text in (("band %", band), ("off by %", off), ("holds", holds))}  # fmt: skip
        return of | {"converged": "yes yes", "convolutions": "100", "of the band": "20" if holds else ""}

    said = {each["what"]: each["value"] for each in summary([
        row("3.0", "1.0", "yes"), row("2.0", "4.0", "no"), row("", "", ""),
    ])}  # fmt: skip
    assert said["cases"] == "3" and said["mean gap: bands that hold"] == "1 of 2"
    assert said["mean gap: band over error, median"] == "1.75"
    assert said["work of the bands, median part of the run's"] == "0.20"
