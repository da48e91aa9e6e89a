"""The fluid of study waviness, named "FILE.py:FUNCTION" in its configurations.

[Venner, Couhier, Lubrecht, Greenwood 1997]: Roelands' law by p0 and z, and the density of Dowson and
Higginson with the coefficients of that time, which differ from [Liu eq. 47] by 0.8 % at 2 GPa.
"""

import numpy as np

PRESSURE, EXPONENT = 1.98e8, 0.68
"""p0 in Pa and z."""

STIFF = 0.59e9
"""Pa."""


def roelands(at):
    """eta and d eta/dp; its slope at p = 0 is `at.pressure_viscosity` times `at.viscosity`."""
    q, alpha = 1.0 + at.pressure / PRESSURE, at.pressure_viscosity
    eta = at.viscosity * np.exp(alpha * PRESSURE / EXPONENT * (q**EXPONENT - 1.0))
    return eta, eta * alpha * q ** (EXPONENT - 1.0)


def dowson_higginson(at):
    """rho/rho_0 and its derivative."""
    p = at.pressure
    return (STIFF + 1.34 * p) / (STIFF + p), 0.34 * STIFF / (STIFF + p) ** 2
