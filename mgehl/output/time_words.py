"""A run in time in words."""

from mgehl.output.digits import pressure_words, with_band
from mgehl.output.friction_result import OUT_OF_RANGE, is_out_of_range, strength_lines

ALIKE = 1e-4
"""Part of a mean below which its band is not told."""

BEYOND, MUCH = 5e-4, 5.0
"""Part of the load beyond the domain that is told, and per cent from which on a larger one is advised."""

OF_PASSAGE, OF_RUN = "over the last passage", "over the whole run"
"""What means are over."""

SPIKE = "a spike that three nodes do not hold"
"""What a largest pressure is beyond `NARROW`."""


def time_lines(time):
    """What happened in a run in time, and the means over its last passage."""
    passages = f"; {time.passages:.3g} passages" if time.passages else ""
    yield (
        f"in time: {1e3 * time.end_s:.6g} ms in {time.steps} steps, {time.halved} of them halved, half "
        f"of them in {time.convolutions_a_step:.3g} convolutions or fewer{passages}"
    )
    yield f"oil: storage and flow close to {time.largest_closure:.1e} of what is stored in every step"
    if time.means:
        yield f"means {OF_PASSAGE}: {', '.join(_means(time, *_of_passage(time)))}"
    elif time.passages:
        yield "no means: the run ends before its first passage"
    if time.whole:
        yield f"means {OF_RUN}: {', '.join(_means(time, *_of_run(time)))}"
    if time.most_pressure_GPa is not None:
        most, least = pressure_words(time.most_pressure_GPa), time.least_film_nm
        yield f"of all steps: largest pressure {most}, smallest film {least:.4g} nm"
    if abs(time.squeezed_beyond) >= BEYOND:
        most, out = 100.0 * abs(time.squeezed_beyond), time.squeezed_beyond > 0.0
        what = "carried by what is squeezed out" if out else "added by what is sucked in"
        larger = "; a larger domain tells more surely" if most >= MUCH else ""
        yield f"up to {most:.1f} % of the load is {what} beyond the domain{larger}"
    if time.error and (time.means or time.whole):
        has_bands = time.error.means or time.error.whole
        yield f"{'bands' if has_bands else 'no band'} of means: {time.error.how}"
    if time.spikes and not (time.error and "max_pressure_GPa" in time.error.at_the_end):
        yield f"in {time.spikes} of {time.steps} steps the largest pressure is the grid's: {SPIKE}"
    yield from strength_lines(time.largest_shear_MPa)


def _of_passage(time):
    """Means over the last passage and the half-widths of their bands: how far grids and steps are apart,
    and passages."""
    bands = time.error.means if time.error else {}
    return {name: mean.value for name, mean in time.means.items()}, {
        name: of_a_mean(mean.between_passages, bands.get(name)) for name, mean in time.means.items()
    }


def _of_run(time):
    """Means over the whole run and the half-widths of their bands."""
    return time.whole, time.error.whole if time.error else {}


def of_a_mean(passages, grids):
    """The half-width about a mean of which passages and grids differ by so much: that passages are alike
    says nothing of the grid. None where grids tell none."""
    return None if grids is None else grids + (passages or 0.0)


def _means(time, values, bands):
    """Means in words, with the bands that there are."""
    pressure, friction = "max_pressure_GPa", "friction"
    yield f"mean gap {_mean(values, bands, 'mean_gap_nm')} nm"
    yield f"the largest pressure {pressure_words(values[pressure], _told(values, bands, pressure))}"
    yield f"load on solids {_mean(values, bands, 'load_on_solids', 100.0)} %"
    if values[friction]:
        words = _friction(time, values, bands)
        yield f"friction {words if words == OUT_OF_RANGE else f'{words} of the load'}"


def _friction(time, values, bands):
    """The mean coefficient."""
    of_oil = values["friction"], time.largest_shear_MPa
    return OUT_OF_RANGE if is_out_of_range(*of_oil) else _mean(values, bands, "friction")


def means_in_short(time):
    """(Mean, its words) of gap and friction: over the whole run where speed or load change, else over the
    last passage; nothing before its end."""
    over, (values, bands) = (OF_RUN, _of_run(time)) if time.whole else (OF_PASSAGE, _of_passage(time))
    if values:
        yield f"mean gap {over}", f"{_mean(values, bands, 'mean_gap_nm')} nm"
    if values.get("friction"):
        yield f"friction {over}", _friction(time, values, bands)


def _mean(values, bands, name, scale=1.0):
    """One mean times `scale`, with its band."""
    value, band = values[name], _told(values, bands, name)
    return f"{scale * value:.4g}" if band is None else with_band(scale * value, scale * band)


def _told(values, bands, name):
    """A band that is worth to be told; else None."""
    band = bands.get(name)
    return band if band and band > ALIKE * abs(values[name]) else None
