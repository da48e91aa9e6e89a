import numpy as np
import pytest
from contacts import contact_of

from mgehl.model.peaks import reach_of_peaks
from mgehl.studies.study import merged

WAVES = {"kind": "waviness", "wavelength_x": 10e-6, "wavelength_y": 10e-6}
LIGHT = {"contact": {"load": 1.0}, "motion": {"speed": 0.01}}


def reach(tables, film=0.0):
    contact = contact_of(tables)
    return reach_of_peaks(contact, film), contact


def waves(height):
    """A light ball with waves of an amplitude in m, whose crests meet at the centre."""
    return merged(LIGHT, {"surface": WAVES | {"amplitude": height}})


@pytest.mark.parametrize("height", [20e-9, 100e-9, 1e-6])
def test_there_the_last_crest_is_as_high_as_the_gap(height):
    """The next one, a wavelength farther out, is lower than the gap."""
    (X, Y), contact = reach(waves(height))
    assert X == Y > 1.0
    gaps = contact.film_scale * contact.dry_gap(np.array([X, X + 10e-6 / contact.x_scale]), np.zeros(2))
    assert gaps[0] < height < gaps[1]


def test_a_film_keeps_the_bodies_apart():
    (bare, _), contact = reach(waves(100e-9))
    (less, _), _ = reach(waves(100e-9), 50e-9)
    assert 1.0 < less < bare
    assert reach(waves(100e-9), 100e-9 - contact.mean_height)[0] == (0.0, 0.0)


@pytest.mark.parametrize("across", [False, True])
def test_a_ridge_reaches_along_itself_alone(across):
    """On a ball under 1 N it touches far out along y, and within the contact along x."""
    ridge = {"kind": "ridge", "amplitude": 200e-9, "width": 20e-6, "angle": 90.0 if across else 0.0}
    (X, Y), _ = reach(merged(LIGHT, {"surface": ridge}))
    along, beside = (X, Y) if across else (Y, X)
    assert along > 1.3 and beside < 1.0


def test_a_peak_outside_of_the_contact_is_found():
    """The first peaks reach farther than the contact; on the way there is a higher one."""
    ridge = {"kind": "ridge", "amplitude": 300e-9, "width": 20e-6, "x": 60e-6, "angle": 90}
    (alone, _), _ = reach(waves(100e-9))
    (both, _), contact = reach(merged(waves(100e-9), {"second_surface": ridge}))
    assert contact.x_scale < 60e-6 < alone * contact.x_scale and both > 1.3 * alone
