"""A run in time in words."""

from mgehl.output.digits import pressure_words, with_band
from mgehl.output.friction_result import strength_lines

ALIKE = 1e-4
"""Part of a mean below which its band is not told."""

SPIKE = "a spike that three nodes do not hold"
"""What a largest pressure is beyond `NARROW`."""


def time_lines(time):
    """What happened in a run in time, and the means over its last passage."""
    yield (
        f"in time: {1e3 * time.end_s:.6g} ms in {time.steps} steps, {time.halved} of them halved, half "
        f"of them in {time.convolutions_a_step:.3g} convolutions or fewer; {time.passages:.3g} passages"
    )
    yield f"oil: storage and flow close to {time.largest_closure:.1e} of what is stored in every step"
    if time.means:
        pressure, friction = time.means["max_pressure_GPa"], time.means["friction"]
        yield (
            f"over the last passage: mean gap {mean_words(time.means['mean_gap_nm'])} nm, largest pressure "
            f"{pressure_words(pressure.value, pressure.band or None)}, load on solids "
            f"{mean_words(time.means['load_on_solids'], 100.0)} %"
            + (f", friction {mean_words(friction)} of the load" if friction.value else "")
        )
    else:
        yield "no means: the run ends before its first passage"
    if time.whole:
        gap, solids, friction = (time.whole[key] for key in ("mean_gap_nm", "load_on_solids", "friction"))
        yield (
            f"over the whole run: mean gap {gap:.4g} nm, load on solids {100.0 * solids:.4g} %"
            + (f", friction {friction:.4g} of the load" if friction else "")
        )
    if time.spikes:
        yield f"in {time.spikes} of {time.steps} steps the largest pressure is the grid's: {SPIKE}"
    yield from strength_lines(time.largest_shear_MPa)


def mean_words(mean, scale=1.0):
    """A `Mean` times `scale`, with its band where passages are not alike: those say nothing of the grid."""
    if mean.band and mean.band > ALIKE * abs(mean.value):
        return with_band(scale * mean.value, scale * mean.band)
    return f"{scale * mean.value:.4g}"
