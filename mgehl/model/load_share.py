"""Part of the load that peaks carry in mixed lubrication, by fits of others: to compare with, and no more.

Lambda is the film that smooth bodies would have over the rms of the heights. A fit knows nothing of the
wavelengths, nor of the load. Each function takes Lambda and returns a part from 1 (no film) to 0.
"""

from math import erf, exp


def aihara(film_ratio):
    """exp(-1.8 Lambda^1.2)  [Aihara 1987]."""
    return exp(-1.8 * film_ratio**1.2)


def zhou_hoeprich(film_ratio):
    """exp(-2.32 Lambda^0.97)  [Zhou and Hoeprich]."""
    return exp(-2.32 * film_ratio**0.97)


def error_function(film_ratio):
    """1 - erf(Lambda), a rule of thumb."""
    return 1.0 - erf(film_ratio)
