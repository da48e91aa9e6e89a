from math import nan

import pytest

from mgehl.output.digits import film_words, with_band


@pytest.mark.parametrize(
    "value, half_width, text",
    [(12.1436, 0.37, "12.1 ± 0.4"), (12.1436, 0.13, "12.14 ± 0.13"), (12.1436, 0.4000001, "12.1 ± 0.5"),
     (12.1436, 0.4, "12.1 ± 0.4"), (12.1436, 0.95, "12.1 ± 1.0"), (378.1, 2.6, "378 ± 3"),
     (407.6, 58.0, "410 ± 60"), (1407.6, 158.0, "1410 ± 160"), (0.0123, 0.00021, "0.0123 ± 0.0003"),
     (-0.001, 0.3, "0.0 ± 0.3"), (5.0, 0.0, "5.000000000 ± 0.000000000")],
)  # fmt: skip
def test_band_has_a_digit_or_two_and_the_film_as_many_decimals(value, half_width, text):
    """It is never shown narrower than it is."""
    assert with_band(value, half_width) == text


def test_a_film_without_a_band_has_four_decimals():
    assert with_band(12.1436, None) == "12.1436"
    assert with_band(12.1436, nan) == "12.1436"
    assert with_band(-0.0, None) == with_band(-4.9e-5, None) == "0.0000", "zero has no sign"
    assert with_band(2e9, None) == "2.000e+09"
    assert with_band(nan, 0.1) == "nan"


def test_a_small_coefficient_has_its_digits():
    assert with_band(2e-10, 1e-11) == "2.000e-10 ± 1.0e-11"
    assert with_band(3.2e-4, 1.1e-5) == "0.000320 ± 0.000011"


def test_a_thick_film_is_in_um():
    assert film_words(9994.0, 30.0) == "9990 ± 30 nm"
    assert film_words(382200.0, 400.0) == "382.2 ± 0.4 um" and film_words(12345.0) == "12.3450 um"
