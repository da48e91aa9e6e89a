"""Deflection of layered bodies by the method of images.

A body that is layered or graded in depth, and alike in all directions, answers a pressure wave exp(ikx)
with a wave of the same length: relative to a half-space, with the compliance

    c(k) = c_0 + sum_j c_j exp(-k d_j)

Every term is the transform of a closed form: c_0/r, and c_j/sqrt(r^2 + d_j^2), the half-space felt at the
depth d_j. Their integrals over rectangles are exact.
"""

from dataclasses import dataclass

import numpy as np

RANGE = (1e-3, 1e5)
"""Wave numbers that matter, in 1/a: from far beyond the largest domain to within the smallest cell."""

SAMPLES = 801

CHANGE = 0.01
"""By how much c(k) must differ from its value at an end of the range before it counts as changed: this part
of c(k) itself, or of its whole change."""

PER_OCTAVE = (2, 3, 4, 6, 8)
"""Images per factor of two in depth that are tried, until `ACCURACY` is reached."""

ACCURACY = 1e-6
"""Relative error of c(k) that is aimed at."""

WORST = 1e-4
"""Relative error of c(k) that is still taken."""


@dataclass(frozen=True, eq=False)
class Images:
    """The sum of a half-space of compliance `surface` and of images: `strengths` at `depths`."""

    surface: float
    strengths: np.ndarray
    depths: np.ndarray
    error: float
    """Largest relative error of c(k) over `RANGE`."""

    def widening(self, radius=1.0):
        """Radius s of the dry contact over `radius`, that of Hertz on half-spaces: an estimate.

        Half-spaces c times as compliant make it c^(1/3) times as wide; c is the mean of c(k) that the
        elastic energy of a Hertz pressure of that width makes.
        """
        xi = np.linspace(0.0, 40.0, 4001)[1:]
        energy = ((np.sin(xi) - xi * np.cos(xi)) / xi**3) ** 2
        s = 1.0
        for _ in range(30):
            s = np.average(self.compliance(xi / (s * radius)), weights=energy) ** (1.0 / 3.0)
        return float(s)

    def compliance(self, k):
        """c(k), shape as `k`, which counts in reciprocal units of the depths."""
        return self.surface + np.exp(-np.multiply.outer(k, self.depths)) @ self.strengths


def wave_numbers():
    """Those in 1/a at which `fit_images` asks for a compliance."""
    return np.geomspace(*RANGE, SAMPLES)


def fit_images(compliance):
    """`Images` of a compliance, a function of an array of wave numbers in 1/a.

    By least squares on depths in geometric sequence. Raises ValueError where c(k) cannot be had to
    within `WORST`: it grows without end, jumps or oscillates.
    """
    k = wave_numbers()
    c = compliance(k)
    surface, rest = c[-1], c - c[-1]
    if np.ptp(c) <= 1e-12 * surface:
        return Images(surface, np.zeros(0), np.zeros(0), 0.0)
    # An image of depth d works below k = 1/d.
    shallow, deep = 0.3 / k[_changed(c, c[-1])[-1]], 10.0 / k[_changed(c, c[0])[0]]
    best = None
    for per_octave in PER_OCTAVE:
        depths = np.geomspace(shallow, deep, int(per_octave * np.log2(deep / shallow)) + 1)
        waves = np.exp(-np.outer(k, depths)) / c[:, None]
        strengths = np.linalg.lstsq(waves, rest / c, rcond=None)[0]
        error = float(np.abs(waves @ strengths - rest / c).max())
        if best is None or error < best.error:
            best = Images(surface, strengths, depths, error)
        if error <= ACCURACY:
            break
    if best.error > WORST:
        raise ValueError(f"is off by {best.error:.1e} as a sum of images, more than {WORST:g}")
    return best


def _changed(c, end):
    """Where c(k) differs from that at one of its ends."""
    return np.flatnonzero(np.abs(c - end) > CHANGE * min(end, np.ptp(c)))
