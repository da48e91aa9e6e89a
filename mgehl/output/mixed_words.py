"""Film and contact of rough bodies, and what resists the motion, in words."""

from math import isfinite

from mgehl.output.digits import with_band

MOLECULE = 0.5
"""In nm: about the thickness of a molecule of oil. A thinner film is none."""


def mixed_lines(mixed):
    """Film and contact of rough bodies: what carries the load, on which area, how wide the gap is and how
    thick the film."""
    patches = counted(mixed.patches, "patch", "patches")
    unit = mixed.area_unit.replace("µm²", "um^2")
    largest = f", the largest {1e12 * mixed.largest_patch_m2:.4g} {unit}" if mixed.patches else ""
    return [
        f"lambda {_known(mixed.lambda_ratio)} (smooth film of the formula over Sq {mixed.Sq_nm:.4g} nm): "
        f"contact carries {_shares(mixed)}",
        f"real contact area {1e12 * mixed.contact_area_m2:.4g} {unit}, "
        f"{100 * mixed.contact_area_over_hertz:.2f} % of the Hertz area, in {patches}{largest}",
        *_carried_by_solids(mixed),
        *_mean_gaps(mixed),
        f"film within the {mixed.hertz_region}: mean {_known(mixed.mean_film_nm)} nm, minimum "
        f"{_known(mixed.minimum_film_nm)} nm, {_known(mixed.valley_film_nm)} nm in valleys deeper than Sq; "
        f"torn on {100 * mixed.torn_share:.2f} % of it{filling_words(mixed)}",
    ]


def filling_words(result):
    """How full cavities are; nothing where there is none, or of an older result."""
    filling = result.torn_filling
    return "" if filling is None else f", where {100 * filling:.0f} % of the gap is filled"


def _shares(mixed):
    """What carries the load; films of which another grid may make contact are named apart."""
    contact = load_words(mixed, "contact_load_share")
    near, film = (
        100.0 * (share or 0.0) for share in (mixed.near_contact_load_share, mixed.film_load_share)
    )
    if not (mixed.patches and near):
        return f"{contact} of the load, the film {film:.2f} %"
    others = f"other films {film - near:.2f} %"
    return f"{contact} of the load, films at most a tenth thicker {near:.2f} %, {others}"


def _carried_by_solids(mixed):
    """What solids carry beside the fluid in their layers, and what pockets carry; none of older results."""
    if mixed.patches and mixed.solid_load_fraction is not None:
        solids = load_words(mixed, "solid_load_fraction")
        yield (
            f"solids carry {solids} of the load, the fluid in contact's layers "
            f"{100 * (mixed.contact_load_share - mixed.solid_load_fraction):.2f} %, pockets that "
            f"contact shuts in {100 * mixed.sealed_load_fraction:.2f} %"
        )


def _mean_gaps(mixed):
    """Mean gaps with their bands, and how these came about; nothing of an older result."""
    if mixed.mean_gap_nm is None:
        return
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
        f"{counted(mixed.patches, 'patch', 'patches')}"
    )  # fmt: skip
    return f"lambda {_known(mixed.lambda_ratio)}, {where}{gap}"


def counted(number, one, more):
    """A number of things, by their name in the singular or the plural."""
    return f"{number} {one if number == 1 else more}"


def _known(value):
    """Three digits; of a number that does not exist a dash."""
    return "-" if value is None or not isfinite(value) else f"{value:.3g}"


STRONGEST = 300.0
"""Largest shear stress in MPa that oils were seen to bear: a tenth of 3 GPa [Arana et al. 2019]."""


def friction_lines(friction, verbose):
    """What resists, in words: of sliding surfaces, and `verbose` of rolling ones, too."""
    if not friction or not (verbose or friction.slide_to_roll or friction.model != "newtonian"):
        return
    unit = "/m" if friction.per_metre else ""
    beyond = friction.rolling_beyond
    more = f" (and {beyond:.2g} beyond the domain, were it flooded)" if beyond else ""
    rolling = f"rolling takes {friction.rolling_coefficient:.3g} of the load on each body{more}"
    if not friction.slide_to_roll:
        yield f"friction 0: the surfaces do not slide; {rolling}"
        return
    # What the load on solids makes of it: without solids there is none.
    has_band = friction.coefficient_band and friction.solid_coefficient
    band = f" ± {friction.coefficient_band:.2g}" if has_band else ""
    yield (
        f"friction {friction.coefficient:.5f}{band} ({friction.model}): film "
        f"{friction.film_coefficient:.5f}, solids {friction.solid_coefficient:.5f}; {rolling}; "
        f"{friction.power_loss_W:.3g} W{unit}, largest shear {friction.largest_shear_MPa:.4g} MPa"
    )
    yield from strength_lines(friction.largest_shear_MPa)
    if friction.temperatures:
        yield temperature_words(friction.temperatures)
    if friction.is_the_grids:
        yield "friction is the grid's, as the load on solids is"


def strength_lines(shear_MPa):
    """What to think of a larger shear stress than oils bear; nothing of others, nor of None."""
    if shear_MPa and shear_MPa > STRONGEST:
        yield (
            f"no oil bears more than some {STRONGEST:g} MPa: friction.model eyring or limiting knows less "
            "friction, and less heat"
        )


def temperature_words(found):
    """How much warmer surfaces and film are than the bodies."""
    film = (
        ""
        if found.film is None
        else f", film on average {found.film:.3g} K, at most {found.largest_film:.3g} K"
    )
    return f"flash temperature: body 1 up to {found.largest_1:.3g} K, body 2 {found.largest_2:.3g} K{film}"


def heating_words(reduction, is_thinned):
    """What the heat of shear in the inlet takes of the film, in a list; nothing below a per cent."""
    if reduction is None or reduction > 0.99:
        return []
    percent = "all of it, by a formula out of range"
    if reduction > 0.0:
        percent = f"some {100.0 * (1.0 - reduction):.0f} %"
    if is_thinned:
        return [f"shear in the inlet has taken {percent} (lubricant.heating)"]
    return [f"this is the isothermal film; shear in the inlet would take {percent}"]
