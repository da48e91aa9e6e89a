"""Tables of runs, films and gaps with their bands."""

from mgehl.output.table import _films, _gaps, with_bands

RESULT = {"central_film_nm": 12.14361, "minimum_film_nm": 5.05}


def test_a_file_has_all_digits_and_the_bands_beside_them():
    row = _films(RESULT | {"error": {"central_nm": 0.37, "minimum_nm": None}})
    assert row == {
        "central nm": "12.1436",
        "minimum nm": "5.0500",
        "central ± nm": "0.37",
        "minimum ± nm": "",
    }


def test_runs_of_before_have_none():
    assert _films(RESULT)["central ± nm"] == ""


def test_a_table_that_is_shown_has_no_more_digits_than_films_have():
    rows = [
        _films(RESULT | {"error": {"central_nm": 0.37, "minimum_nm": 0.2}}) | {"run": "a"},
        _films(RESULT),
    ]
    assert with_bands(rows) == [
        {"central nm": "12.1 ± 0.4", "minimum nm": "5.0 ± 0.2", "run": "a"},
        {"central nm": "12.1436", "minimum nm": "5.0500"},
    ]


ROUGH = {"mean_gap_nm": 13.741264, "loaded_gap_nm": 2.911206}


def test_mean_gaps_of_rough_bodies_have_bands_too():
    row = _gaps({"mixed": ROUGH | {"error": {"mean_nm": 0.0636, "loaded_nm": 0.0488}}})
    assert (row["mean gap nm"], row["loaded gap ± nm"]) == ("13.7413", "0.0488")
    assert with_bands([row]) == [{"mean gap nm": "13.74 ± 0.07", "loaded gap nm": "2.91 ± 0.05"}]


def test_without_bands_or_rough_bodies_they_are_bare_or_empty():
    assert with_bands([_gaps({"mixed": ROUGH | {"error": None}})])[0]["mean gap nm"] == "13.7413"
    assert set(_gaps({"mixed": None}).values()) == {""}
