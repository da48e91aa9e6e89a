from dataclasses import replace
from math import cos, pi, radians, sin

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.model.coating import Coating
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.model.point import PointContact, radii_along

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())


def elliptical(radius_x=12.7e-3, radius_y=40e-3):
    return PointContact(800.0, radius_x, radius_y, 219.78e9, 0.1, LUBRICANT)


@pytest.mark.parametrize("radii", [(12.7e-3, 12.7e-3), (12.7e-3, 40e-3), (40e-3, 12.7e-3)])
def test_dry_contact_closes_in_dimensionless_units(radii):
    """At the centre -approach + deflection_scale iint P/r = 0 for the Hertz pressure.

    With x = a r cos t, y = b r sin t the integral of P/r over dx dy/a^2 is
    (pi/4) (1/k_e) int_0^2pi dt/sqrt(cos^2 t + sin^2 t/k_e^2), as int_0^1 sqrt(1 - r^2) dr = pi/4.
    """
    contact = elliptical(*radii)
    t = np.arange(4096) * 2.0 * pi / 4096
    mean = (1.0 / np.sqrt(np.cos(t) ** 2 + (np.sin(t) / contact.k_e) ** 2)).mean()
    integral = pi / 4.0 / contact.k_e * 2.0 * pi * mean
    assert contact.deflection_scale * integral == pytest.approx(contact.approach, rel=1e-9)


class TestMotionAtAnAngle:
    """Formulas see the curvatures along and across the motion; every turn of axes is the same contact."""

    @pytest.mark.parametrize("angle", (0.0, 20.0, 45.0, 130.0, -75.0))
    def test_radii_are_those_of_the_paraboloid_along_and_across(self, angle):
        """The curvature of x^2/2R_x + y^2/2R_y along a direction is its second difference there."""
        along, across = radii_along(angle, 12.7e-3, 40e-3)
        for radius, degrees in ((along, angle), (across, angle + 90.0)):
            x, y = cos(radians(degrees)), sin(radians(degrees))
            assert 1.0 / radius == pytest.approx(x**2 / 12.7e-3 + y**2 / 40e-3, rel=1e-13)

    @pytest.mark.parametrize("angle", (25.0, 90.0, 155.0, 290.0))
    def test_cells_in_the_inlet_are_those_of_its_frame(self, angle):
        contact = replace(elliptical(), angle=angle)
        mesh = Mesh(65, 65, (-3.0, 2.0), (-2.0, 4.0), contact.k_e)
        there = contact.in_frame(contact.frame)
        assert there.inlet_cells(mesh.in_frame(contact.frame)) == pytest.approx(contact.inlet_cells(mesh))

    @pytest.mark.parametrize("angle", (0.0, 40.0, 90.0))
    def test_moes_numbers_are_of_the_radius_along_the_motion(self, angle):
        contact = PointContact.from_moes(200.0, 10.0, 12.7e-3, 40e-3, 219.78e9, LUBRICANT, angle=angle)
        assert (contact.groups.M, contact.groups.L) == pytest.approx((200.0, 10.0), rel=1e-12)
        radius, _ = radii_along(angle, 12.7e-3, 40e-3)
        W = contact.load / (219.78e9 * radius**2)
        assert contact.groups.W == pytest.approx(W, rel=1e-13)


def test_a_coating_as_soft_as_rubber_and_thicker_than_the_contact_counts_in_what_formulas_see():
    """Its regime, the heat in its inlet and the density in its middle are those of bodies of rubber."""
    hard, rubber = replace(elliptical(), load=1.0), 5e6
    coating = Coating(50e-3, rubber, 0.3, None, 0.3, hard.reduced_modulus)
    coated = replace(hard, deformation=coating)
    soft = replace(hard, reduced_modulus=2.0 * rubber / (1.0 - 0.3**2))
    assert hard.regime == "rigid isoviscous" and coated.regime == soft.regime == "elastic isoviscous"
    assert coated.heated_film(0.04, 0.14) == pytest.approx(soft.heated_film(0.04, 0.14), rel=1e-5)
    assert coated.density_ratio - 1.0 == pytest.approx(soft.density_ratio - 1.0, rel=1e-3)


def test_a_layer_as_thick_as_a_half_space_has_its_inlet_and_its_formulas():
    """Cells of layered bodies were counted by a width that was widened twice: 4.5 times too many."""
    steel, layer = 226e9, Coating(40e-3, 1e9, 0.45, None, 0.3, 226e9)
    oil = Lubricant(Barus(0.1, 18e-9), DowsonHigginson())
    coated = PointContact(5.0, 11.43e-3, 11.43e-3, steel, 0.1, oil, deformation=layer)
    alone = replace(coated, reduced_modulus=steel / coated.widening**3, deformation=None)
    assert 1e-9 * alone.reduced_modulus == pytest.approx(2.48, rel=0.02)  # the width is an estimate
    assert coated.inlet_length * coated.x_scale == pytest.approx(alone.inlet_length * alone.x_scale)
    assert coated.compared == pytest.approx(alone.compared)
    assert coated.regime == alone.regime == "elastic isoviscous"
