"""Films in words: with their bands, and what heat and shear take from them."""

from mgehl.output.digits import film_words, with_band
from mgehl.output.film_error import NOT_ASKED

HARDLY = 2e-3
"""Part of a film by which shear must thin it to be told."""

UNKNOWN = 3
"""Digits of a film that has no band, though one was asked for."""


def digits_of(error):
    """Digits of films that a `FilmError` gives no band though one was asked for; else None."""
    return None if error.how == NOT_ASKED.how else UNKNOWN


def films_words(result):
    """Central and minimum film of a `Result` with their bands."""
    error, digits = result.error, digits_of(result.error)
    central = film_words(result.central_film_nm, error.central_nm, digits)
    return f"central film {central}, minimum {film_words(result.minimum_film_nm, error.minimum_nm, digits)}"


def band_words(error):
    """How the bands of a `FilmError` came about, or why there are none."""
    return f"{'no band' if error.central_nm is None else 'bands'}: {error.how}"


def heating_words(reduction, is_thinned):
    """What the heat of shear in the inlet takes of the film, in a list; nothing below a per cent."""
    if reduction is None or reduction > 0.99:
        return []
    percent = "all of it, by a formula out of range"
    if reduction > 0.0:
        percent = f"some {100.0 * (1.0 - reduction):.0f} %"
    if is_thinned:
        return [f"shear in the inlet has taken {percent} by the formula (lubricant.heating)"]
    return [f"this is the isothermal film; shear in the inlet would take {percent}"]


def thinning_words(result):
    """The film that there would be if shear did not thin the oil, the minimum where the central one would
    hardly be another."""
    friction, mixed = result.friction, result.mixed
    if not friction or friction.unthinned_film_nm is None:
        if friction and friction.thins:
            yield "shear thins the oil: how thick the film would be without that is not known"
        return
    error, thick = result.error, friction.unthinned_film_nm
    films = {
        "central film": (result.central_film_nm, error.central_nm, thick),
        "minimum film": (result.minimum_film_nm, error.minimum_nm, friction.unthinned_minimum_nm),
    }
    if mixed:
        films = {"mean gap": (mixed.mean_gap_nm, mixed.error and mixed.error.mean_nm, thick)}
    for name, (own, band, thick) in films.items():
        if thick is not None and thick - own > HARDLY * own:
            thick = f"{thick:.4g}" if band is None else with_band(thick, band)
            yield f"shear thins the oil: without that the {name} would be {thick} nm"
            return
    yield "shear thins the oil, the film hardly"
