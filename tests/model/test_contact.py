from dataclasses import replace
from math import isfinite

import numpy as np
import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.model.point import PointContact
from mgehl.model.surface.shapes import Dent
from mgehl.model.surface.waviness import Waviness

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())
BODY = {"radius_x": 12.7e-3, "reduced_modulus": 219.78e9, "lubricant": LUBRICANT}
CONTACTS = {
    "circle": PointContact(load=800.0, radius_y=12.7e-3, speed=7.5e-3, **BODY),
    "ellipse": PointContact(load=800.0, radius_y=40e-3, speed=7.5e-3, **BODY),
    "line": LineContact(load=1.86e6, speed=7.5e-3, **BODY),
}
every_contact = pytest.mark.parametrize("contact", CONTACTS.values(), ids=CONTACTS)


@every_contact
@pytest.mark.parametrize("away", [6.0, 60.0], ids=["a tail", "nothing at all"])
def test_a_dent_far_beside_the_contact_is_no_roughness(contact, away):
    """Its tail is 1e-130 m high. In time it may come in: the contact has the schemes of rough bodies."""
    a = contact.x_scale
    dented = replace(contact, surface=Dent(1e-6, 1.4 * a, x=-away * a))
    assert dented.roughness == 0.0
    assert dented.lambda_ratio is None and isfinite(dented.skewness)
    assert dented.is_rough and not contact.is_rough


@pytest.mark.parametrize("where, is_rough", [(0.0, True), (0.94, False)])
def test_roughness_is_that_within_the_ellipse(where, is_rough):
    """A dent beside the contact, within its semi-axes along x and y, had an Sq of 15 nm and a lambda."""
    smooth = CONTACTS["circle"]
    a = smooth.x_scale
    contact = replace(smooth, surface=Dent(5e-7, 0.2 * a, where * a, where * a))
    x = np.linspace(-1.0, 1.0, 401) * a
    inside = x[None, :] ** 2 + x[:, None] ** 2 <= a**2
    expected = np.std(contact.surface.height(x[None, :], x[:, None])[inside])
    assert contact.roughness == pytest.approx(expected, rel=0.02, abs=1e-15)
    assert is_rough == (contact.roughness > 1e-9) == (contact.lambda_ratio is not None)


@every_contact
@pytest.mark.parametrize("waves", [16, 32, 64])
@pytest.mark.parametrize("phase", [0.0, 0.25])
def test_regular_waves_have_their_rms_however_short_and_wherever_their_peaks_are(contact, waves, phase):
    """A/sqrt(2); where samples lay on all peaks, or on all zeros, it was A, or nothing."""
    length = contact.x_scale / waves
    wavy = replace(contact, surface=Waviness(1e-8, length, x=phase * length))
    assert wavy.roughness == pytest.approx(1e-8 / 2.0**0.5, rel=0.01)
    long = replace(contact, surface=Waviness(1e-8, contact.x_scale))
    assert wavy.heights.shape == long.heights.shape  # places in common, by which contacts are compared
