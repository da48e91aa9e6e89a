from dataclasses import asdict, replace
from math import cos, pi, radians, sin, sqrt
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import dblquad

from mgehl.discretization.mesh import Mesh
from mgehl.model.films import chittenden
from mgehl.model.hertz import hertz_contact, hertz_pressure
from mgehl.model.lubricant import Barus, ConstantDensity, DowsonHigginson, Lubricant
from mgehl.model.point import LOAD, PointContact, radii_along

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())


def headline(speed=7.5e-3):
    return PointContact(800.0, 12.7e-3, 12.7e-3, 219.78e9, speed, LUBRICANT)


def elliptical(radius_x=12.7e-3, radius_y=40e-3):
    return PointContact(800.0, radius_x, radius_y, 219.78e9, 0.1, LUBRICANT)


def test_load_is_the_integral_of_the_hertz_pressure():
    """Liu eq. 50: also in ellipses, since Y is y/b."""
    disc = dblquad(lambda t, r: r * hertz_pressure(r, 0.0), 0.0, 1.0, 0.0, 2.0 * pi)[0]
    assert LOAD == pytest.approx(disc, rel=1e-9)


def test_headline_groups():
    """U = eta0 u/(E' R), W = w/(E' R^2), G = alpha E', by hand."""
    groups = headline().groups
    assert groups.U == pytest.approx(2.5795e-13, rel=1e-4)
    assert groups.W == pytest.approx(2.2568e-5, rel=1e-4)
    assert groups.G == pytest.approx(4000.0, rel=1e-4)
    assert groups.M == pytest.approx(groups.W / (2.0 * groups.U) ** 0.75, rel=1e-13)
    assert groups.L == pytest.approx(groups.G * (2.0 * groups.U) ** 0.25, rel=1e-13)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0), (1e4, 2.5)])
@pytest.mark.parametrize("radius_y", [12.7e-3, 40e-3])
def test_moes_round_trip(M, L, radius_y):
    contact = PointContact.from_moes(M, L, 12.7e-3, radius_y, 219.78e9, LUBRICANT)
    assert contact.groups.M == pytest.approx(M, rel=1e-12)
    assert contact.groups.L == pytest.approx(L, rel=1e-12)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0), (1e4, 2.5)])
def test_reynolds_coefficient_and_alpha_bar_of_a_circle(M, L):
    """1/lambda = 1/[pi (128/(3 M^4))^(1/3)] and alpha_bar = (L/pi)(1.5 M)^(1/3)."""
    lubricant = Lubricant(Barus(0.02, 25e-9), ConstantDensity())
    contact = PointContact.from_moes(M, L, 0.01, 0.01, 200e9, lubricant)
    assert contact.lambda_ == pytest.approx(pi * (128.0 / (3.0 * M**4)) ** (1.0 / 3.0), rel=1e-12)
    alpha_bar = contact.lubricant.pressure_viscosity * contact.hertz.p_h
    assert alpha_bar == pytest.approx(L / pi * (1.5 * M) ** (1.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize("M", [20.0, 200.0])
def test_film_in_moes_units(M):
    """H_Moes = H sqrt(6 pi/lambda) for a circle, the scaling of the reference films."""
    contact = PointContact.from_moes(M, 10.0, 0.01, 0.01, 200e9, LUBRICANT)
    per_H = contact.film_scale * contact.moes_scale
    assert per_H == pytest.approx(sqrt(6.0 * pi / contact.lambda_), rel=1e-12)


def test_scales_of_a_circle():
    """H in units of a^2/R, approach 1, k_e 1, and the deflection factor 2/pi^2 of Eq. 49."""
    contact = headline()
    assert contact.film_scale == pytest.approx(contact.hertz.a**2 / 12.7e-3, rel=1e-15)
    assert contact.k_e == 1.0
    assert contact.approach == pytest.approx(1.0, rel=1e-13)
    assert contact.deflection_scale == pytest.approx(2.0 / pi**2, rel=1e-13)


@pytest.mark.parametrize("radii", [(12.7e-3, 40e-3), (40e-3, 12.7e-3)])
def test_undeformed_gap_is_the_paraboloid(radii):
    """x^2/2R_x + y^2/2R_y in metres at x = 0.5 a, y = -2 b."""
    contact = elliptical(*radii)
    x, y = 0.5 * contact.hertz.a, -2.0 * contact.hertz.b
    metres = x**2 / (2.0 * radii[0]) + y**2 / (2.0 * radii[1])
    gap = contact.undeformed_gap(0.5, -2.0) * contact.film_scale
    assert gap == pytest.approx(metres, rel=1e-13)
    assert contact.undeformed_gap(np.zeros(3), np.array([0.0, 1.0, 2.0])).shape == (3,)


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


def test_hertz_is_that_of_the_same_bodies():
    contact = elliptical()
    assert contact.hertz == hertz_contact(800.0, 12.7e-3, 40e-3, 219.78e9)
    assert contact.k_e == contact.hertz.a / contact.hertz.b < 1.0


def test_formulas_in_metres():
    """All four of the headline case agree within a factor of two, minimum below central."""
    formulas = headline().formulas
    central = formulas.hamrock_dowson_central
    assert formulas.hamrock_dowson_minimum < central
    for film in (formulas.nijenbanning_venner_moes, formulas.grubin):
        assert 0.5 * central < film < 2.0 * central


def test_hamrock_dowson_gets_b_over_a():
    """The ellipticity is k = b/a, above one where the contact is long across the motion."""
    contact = elliptical(12.7e-3, 40e-3)
    U, W, G = contact.groups.U, contact.groups.W, contact.groups.G
    k = contact.hertz.b / contact.hertz.a
    assert k > 1.0
    expected = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k)) * 12.7e-3
    assert contact.formulas.hamrock_dowson_central == pytest.approx(expected, rel=1e-13)


def test_inlet_length_of_the_headline_case():
    """s* = (h/C)^(2/3) with the Ertel-Grubin h and C = 1.2004 a^2/R."""
    contact = headline()
    a = contact.hertz.a
    C = 8.0 * sqrt(2.0) / (3.0 * pi) * a**2 / 12.7e-3
    h = (12.0 * 0.2687 * 18.2e-9 * 0.096 * 7.5e-3 * a) ** 0.75 / sqrt(C)
    assert contact.formulas.grubin == pytest.approx(h, rel=1e-12)
    assert contact.inlet_length == pytest.approx((h / C) ** (2.0 / 3.0), rel=1e-12)


class TestMotionAtAnAngle:
    """Formulas see the curvatures along and across the motion; every turn of axes is the same contact."""

    def at(self, angle, radius_x=12.7e-3, radius_y=40e-3, **changes):
        return replace(elliptical(radius_x, radius_y), angle=angle, **changes)

    @pytest.mark.parametrize("angle", (0.0, 20.0, 45.0, 130.0, -75.0))
    def test_radii_are_those_of_the_paraboloid_along_and_across(self, angle):
        """The curvature of x^2/2R_x + y^2/2R_y along a direction is its second difference there."""
        along, across = radii_along(angle, 12.7e-3, 40e-3)
        for radius, degrees in ((along, angle), (across, angle + 90.0)):
            x, y = cos(radians(degrees)), sin(radians(degrees))
            assert 1.0 / radius == pytest.approx(x**2 / 12.7e-3 + y**2 / 40e-3, rel=1e-13)

    @pytest.mark.parametrize(
        "angle, radii", {0: (0.01, 0.03), 90: (0.03, 0.01), 180: (0.01, 0.03), 270: (0.03, 0.01)}.items()
    )
    def test_along_the_axes_they_are_the_radii_to_the_last_bit(self, angle, radii):
        assert radii_along(angle, 0.01, 0.03) == radii

    def test_a_ball_has_one_radius_whatever_the_angle(self):
        assert radii_along(33.0, 12.7e-3, 12.7e-3) == (12.7e-3, 12.7e-3)

    def test_aligned_it_moves_along_x(self):
        contact = self.at(30.0)
        assert contact.aligned.motion == (1.0, 0.0)
        assert (contact.aligned.radius_x, contact.aligned.radius_y) == radii_along(30.0, 12.7e-3, 40e-3)
        assert contact.aligned.aligned is contact.aligned

    @pytest.mark.parametrize("angle", (0.0, 25.0, 65.0, 90.0, 155.0, 205.0, 245.0, 295.0, 335.0))
    def test_in_its_frame_it_is_the_same_contact(self, angle):
        """Gap, pressure, film scale in m, inlet, groups, formulas: none knows of the axes."""
        contact = self.at(angle)
        frame = contact.frame
        there = contact.in_frame(frame)
        x, y = 0.7e-4, -1.3e-4
        mine = contact.undeformed_gap(*np.divide(frame.users_point(x, y), _scales(contact)))
        gap = there.undeformed_gap(*np.divide((x, y), _scales(there)))
        assert gap * there.film_scale == pytest.approx(mine * contact.film_scale, rel=1e-12)
        assert there.hertz.p_h == pytest.approx(contact.hertz.p_h, rel=1e-12)
        assert there.inlet_length * there.x_scale == pytest.approx(contact.inlet_length * contact.x_scale)
        assert there.groups == contact.groups
        assert (there.regime, asdict(there.formulas)) == (contact.regime, asdict(contact.formulas))
        assert there.moes_scale == contact.moes_scale and there.expected_film == contact.expected_film
        assert frame.users_point(*there.motion) == pytest.approx(contact.motion, abs=1e-15)

    @pytest.mark.parametrize("angle", (25.0, 90.0, 155.0, 290.0))
    def test_cells_in_the_inlet_are_those_of_its_frame(self, angle):
        contact = self.at(angle)
        mesh = Mesh(65, 65, (-3.0, 2.0), (-2.0, 4.0), contact.k_e)
        there = contact.in_frame(contact.frame)
        assert there.inlet_cells(mesh.in_frame(contact.frame)) == pytest.approx(contact.inlet_cells(mesh))

    def test_cells_along_an_axis_are_those_of_the_mesh(self):
        """In units of a: dX along x, and dY b/a along y."""
        contact = self.at(0.0)
        mesh = Mesh(65, 65, (-3.0, 2.0), (-2.0, 4.0), contact.k_e)
        assert contact.cell_along_motion(mesh) == mesh.dX
        turned = self.at(90.0)
        assert turned.cell_along_motion(mesh) == pytest.approx(mesh.dY * turned.hertz.b / turned.hertz.a)

    @pytest.mark.parametrize("angle", (0.0, 40.0, 90.0))
    def test_moes_numbers_are_of_the_radius_along_the_motion(self, angle):
        contact = PointContact.from_moes(200.0, 10.0, 12.7e-3, 40e-3, 219.78e9, LUBRICANT, angle=angle)
        assert (contact.groups.M, contact.groups.L) == pytest.approx((200.0, 10.0), rel=1e-12)
        radius, _ = radii_along(angle, 12.7e-3, 40e-3)
        W = contact.load / (219.78e9 * radius**2)
        assert contact.groups.W == pytest.approx(W, rel=1e-13)

    @pytest.mark.parametrize("angle", (0.0, 90.0, 180.0, -90.0))
    def test_along_an_axis_it_has_the_formulas_that_it_always_had(self, angle):
        assert asdict(self.at(angle).formulas).keys() == asdict(elliptical().formulas).keys()

    def test_at_an_angle_the_formula_made_for_it_joins_them(self):
        contact = self.at(30.0)
        like = contact.aligned
        found = contact.formulas
        central, minimum = chittenden(contact.groups, like.radius_x, like.radius_y)
        assert (found.chittenden_central, found.chittenden_minimum) == (central, minimum)
        assert found.hamrock_dowson_central == like.formulas.hamrock_dowson_central

    def test_a_surface_turns_with_the_axes(self):
        contact = self.at(110.0, surface=SimpleNamespace(height=lambda x, y: 1e-6 * x + 2e-6 * y))
        there = contact.in_frame(contact.frame)
        x, y = contact.frame.users_point(1e-4, 3e-4)
        assert there.surface.height(1e-4, 3e-4) == contact.surface.height(x, y)


def _scales(contact):
    return contact.x_scale, contact.y_scale


@pytest.mark.parametrize("M, hardly_yields", [(2.0, True), (4.0, True), (6.0, False), (200.0, False)])
def test_a_load_hardly_yields_where_the_rigid_film_is_the_thicker(moes_contact, M, hardly_yields):
    assert moes_contact(M, 5.0).hardly_yields is hardly_yields


def test_formulas_for_every_regime_are_near_those_of_heavy_loads(moes_contact):
    contact = moes_contact(500.0, 10.0)
    assert contact.flooded_film == pytest.approx(contact.formulas.hamrock_dowson_central, rel=0.25)


def test_what_stands_for_a_contact_lies_along_the_motion(paper_contact):
    turned = paper_contact(radius_y=30e-3, angle=90.0)
    assert (turned.likeness.radius_x, turned.likeness.radius_y) == (30e-3, turned.radius_x)
