"""What point and line contacts have in common."""

from dataclasses import replace
from math import isfinite

import pytest

from mgehl.discretization.mesh import Mesh
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


def mesh_of(contact, nodes):
    return Mesh(nodes, nodes, (-1.9, 1.3), (-1.5, 1.5), contact.k_e)


@every_contact
@pytest.mark.parametrize("cells", [1.0, 2.0, 7.5])
def test_matched_speed_gives_the_inlet_its_cells(contact, cells):
    mesh = mesh_of(contact, 65)
    matched = contact.matched_speed(mesh, cells)
    assert matched > contact.speed
    assert contact.at_speed(matched).inlet_length == pytest.approx(cells * 3.2 / 64, rel=1e-12)
    assert contact.at_speed(matched).inlet_cells(mesh) == pytest.approx(cells, rel=1e-12)


@every_contact
def test_matched_speed_never_lowers_the_speed(contact):
    assert contact.matched_speed(mesh_of(contact, 16385), 2.0) == contact.speed
    assert contact.matched_speed(mesh_of(contact, 65), 0.0) == contact.speed
