"""Tables of runs, films with their bands."""

from mgehl.output.table import _films, with_bands

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
