from dataclasses import replace
from math import isfinite

import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.model.point import PointContact
from mgehl.model.surface.shapes import Dent

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
    assert (dented.roughness > 0.0) == (away == 6.0)
    assert dented.lambda_ratio is None and isfinite(dented.skewness)
    assert dented.is_rough and not contact.is_rough
