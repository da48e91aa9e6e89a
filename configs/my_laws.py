"""Functions of one's own: a configuration names them as "my_laws.py:NAME", see wavy.toml, pocket.toml.

Each takes arrays and returns arrays of the same shape, all in SI units. A law of the lubricant takes one
argument, the conditions: at.pressure, at.viscosity, at.pressure_viscosity, at.shear_rate, at.temperature,
as far as there are any. Viscosity and density come with their derivatives by p, which are compared to
differences of the values before a run: a slip of the pen is one line, not an iteration that will not
converge. Where p = 0 the viscosity is lubricant.viscosity and the slope of its logarithm
lubricant.pressure_viscosity, to a tenth: formulas and the domain go by them.
"""

import numpy as np

# Squalane at 40 degrees Celsius: Tait's equation of state and Doolittle's free volume.
BULK_MODULUS = 1.19e9  # Pa
BULK_SLOPE = 11.74
DOOLITTLE = 4.71
OCCUPIED = 0.6568

CARREAU = 6e6  # Pa: the stress about which the oil ceases to be Newtonian

AMPLITUDE = 15e-9  # m
WAVELENGTH = 60e-6  # m


def volume(p):
    """V/V0 by Tait's equation of state, and its derivative by p."""
    stiffness = BULK_MODULUS / (1.0 + BULK_SLOPE)
    value = 1.0 - np.log1p(p / stiffness) / (1.0 + BULK_SLOPE)
    return value, -1.0 / ((1.0 + BULK_SLOPE) * (stiffness + p))


def doolittle(at):
    """lubricant.viscosity_law: eta in Pa s and d eta/dp; alpha is 22.07 1/GPa where p = 0."""
    ratio, slope = volume(at.pressure)
    free = ratio - OCCUPIED
    eta = at.viscosity * np.exp(DOOLITTLE * OCCUPIED * (1.0 / free - 1.0 / (1.0 - OCCUPIED)))
    return eta, -eta * DOOLITTLE * OCCUPIED / free**2 * slope


def tait(at):
    """lubricant.density_law: the density over that at p = 0, and its derivative by p."""
    ratio, slope = volume(at.pressure)
    return 1.0 / ratio, -slope / ratio**2


def dowson_higginson(at):
    """lubricant.density_law by two constants of another oil than the built-in law's."""
    p = at.pressure
    stiffness, ratio = 2.22e9, 1.66  # Pa; the density at the highest pressure over that at none
    return (stiffness + ratio * p) / (stiffness + p), (ratio - 1.0) * stiffness / (stiffness + p) ** 2


def carreau(at):
    """friction.model: the shear stress in Pa, of oil that a rising shear rate makes ever less viscous."""
    return at.viscosity * at.shear_rate / (1.0 + (at.viscosity * at.shear_rate / CARREAU) ** 2) ** 0.35


def waves(x, _y):
    """contact.surface: height in m, a peak positive: it lowers the gap. Here waves along the motion.

    They belong to the body that stands still; x and y are counted from the centre of the contact.
    """
    return -AMPLITUDE * np.cos(2.0 * np.pi * x / WAVELENGTH)


def liner(k):
    """contact.deformation: deflection at wave number k in 1/m over that of half-spaces.

    Of an elastic liner, 0.2 mm thick, bonded to a rigid base; contact.reduced_modulus is then
    2 E/(1 - nu^2) of the liner, which is also what a half-space of it would have.
    """
    thickness, poisson = 0.2e-3, 0.4
    kt, s = k * thickness, 3.0 - 4.0 * poisson
    decay = np.exp(-2.0 * kt)
    above = s * (1.0 - decay**2) - 4.0 * kt * decay
    return above / (s * (1.0 + decay**2) + (1.0 + s**2 + 4.0 * kt**2) * decay)
