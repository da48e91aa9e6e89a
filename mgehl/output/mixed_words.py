"""Film and contact of rough bodies in words."""

from math import isfinite

from mgehl.output.digits import with_band

MOLECULE = 0.5
"""In nm: about the thickness of a molecule of oil. A thinner film is none."""


def mixed_lines(mixed):
    """Film and contact of rough bodies: what carries the load, on which area, how wide the gap is and how
    thick the film."""
    ratio = f"lambda {_known(mixed.lambda_ratio)} ({_ratio_words(mixed)})"
    if not mixed.Sq_nm:
        ratio = "no roughness is within the contact"
    return [
        f"{ratio}: contact carries {_shares(mixed)}",
        *_real_contact(mixed),
        *_carried_by_solids(mixed),
        *_mean_gaps(mixed),
        f"film that is not torn, within the {mixed.hertz_region}: mean {_known(mixed.mean_film_nm)} nm, "
        f"minimum {_known(mixed.minimum_film_nm)} nm, {_known(mixed.valley_film_nm)} nm in valleys "
        f"deeper than Sq; torn on {100 * mixed.torn_share:.2f} % of it{filling_words(mixed)}",
    ]


def _real_contact(mixed):
    if not mixed.patches:
        return
    unit = mixed.area_unit.replace("µm²", "um^2")
    yield (
        f"real contact area {1e12 * mixed.contact_area_m2:.4g} {unit}, "
        f"{100 * mixed.contact_area_over_hertz:.2f} % of the Hertz area, in {_counted(mixed.patches)}, "
        f"the largest {1e12 * mixed.largest_patch_m2:.4g} {unit}"
    )


def _ratio_words(mixed):
    """What lambda is the ratio of."""
    film = f" {mixed.lambda_ratio * mixed.Sq_nm:.4g} nm" if mixed.lambda_ratio is not None else ""
    return f"smooth film of the formula{film} over Sq {mixed.Sq_nm:.4g} nm"


def filling_words(result):
    """How full cavities are; nothing where there is none."""
    filling = result.torn_filling
    return "" if filling is None else f", where {100 * filling:.0f} % of the gap is filled"


def _shares(mixed):
    """What carries the load; films of which another grid may make contact are named apart."""
    contact = load_words(mixed, "contact_load_share")
    near, film = (100.0 * share for share in (mixed.near_contact_load_share, mixed.film_load_share))
    if not (mixed.patches and near):
        return f"{contact} of the load, the film {film:.2f} %"
    others = f"other films {film - near:.2f} %"
    return f"{contact} of the load, films at most a tenth thicker {near:.2f} %, {others}"


def _carried_by_solids(mixed):
    """What solids carry beside the fluid in their layers, and what pockets carry."""
    if mixed.patches:
        solids = load_words(mixed, "solid_load_fraction")
        yield (
            f"solids carry {solids} of the load, the fluid in contact's layers "
            f"{100 * (mixed.contact_load_share - mixed.solid_load_fraction):.2f} %, pockets that "
            f"contact shuts in {100 * mixed.sealed_load_fraction:.2f} %"
        )


def _mean_gaps(mixed):
    """Mean gaps with their bands, and how these came about."""
    mean, loaded = mean_gaps(mixed)
    yield (
        f"gap, contact included: mean {mean} nm within the {mixed.hertz_region}, {loaded} nm by pressure "
        f"(where the load rests)"
    )
    if mixed.loaded_gap_nm < MOLECULE:
        yield (
            "the load rests on gaps thinner than a molecule: real bodies keep a boundary film "
            "(contact.boundary_film, 2 nm is usual)"
        )
    if mixed.error:
        yield f"{gap_band_words(mixed.error)}"


def gap_band_words(error):
    """How the bands of a `GapError` came about, or why there are none; what the grid does not hold."""
    if error.mean_nm is None:
        return f"no band of gap, pressure and load: {error.how}"
    rest = f"; the grid's: {', '.join(error.the_grids)}" if error.the_grids else ""
    return f"bands of gap, pressure and load: {error.how}{rest}"


def load_words(mixed, name):
    """A part of the load in %, by its name in `MixedResult`, with its band."""
    percent, band = 100.0 * getattr(mixed, name), mixed.error and getattr(mixed.error, name)
    return f"{percent:.2f} %" if band is None else f"{with_band(percent, 100.0 * band)} %"


def mean_gaps(mixed):
    """Both mean gaps of a `MixedResult` in nm, with their bands."""
    bands = (mixed.error.mean_nm, mixed.error.loaded_nm) if mixed.error else (None, None)
    gaps = mixed.mean_gap_nm, mixed.loaded_gap_nm
    return [
        _known(gap) if band is None else with_band(gap, band) for gap, band in zip(gaps, bands, strict=True)
    ]


def mixed_note(mixed):
    """The same in a line, under the title of a picture; nothing of smooth bodies."""
    if not mixed:
        return ""
    gap = f", mean gap {mean_gaps(mixed)[0]} nm" if mixed.error and mixed.error.mean_nm else ""
    where = "no contact" if not mixed.patches else (
        f"contact carries {100 * mixed.contact_load_share:.1f} % "
        f"of the load on {100 * mixed.contact_area_over_hertz:.1f} % of the Hertz area, in "
        f"{_counted(mixed.patches)}"
    )  # fmt: skip
    return f"lambda {_known(mixed.lambda_ratio)}, {where}{gap}"


def _counted(patches):
    """A number of patches."""
    return f"{patches} {'patch' if patches == 1 else 'patches'}"


def _known(value):
    """Three digits; of a number that does not exist a dash."""
    return "-" if value is None or not isfinite(value) else f"{value:.3g}"
