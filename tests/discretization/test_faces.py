from dataclasses import replace

import numpy as np
import pytest
from handmade import ALONG, Row, conductances, flows

from mgehl.discretization.axes import axes_of
from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.flow import EE, SHIFT, WW, E, W
from mgehl.discretization.fluid import FACE_MOBILITIES, Fluid, fluid_state
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED

along_both = pytest.mark.parametrize("along", ALONG)
every_scheme = pytest.mark.parametrize("couette", SCHEMES)

MOTIONS = {"along x": (1.0, 0.0), "against x": (-1.0, 0.0), "at an angle": (0.6, 0.8)}


def plain_fluid(P, H, rho, eps):
    zero = np.zeros_like(P)
    return Fluid(P, H, H, rho, zero, eps, zero, zero)


def flows_of(row, axis, P, H, rho, eps, scheme, status=None):
    """Values of the flows (leaving W, entering E) through the faces of a row made by hand."""
    given = (np.asarray(each, float) for each in (P, H, rho, eps))
    laid = map(row.lay, np.broadcast_arrays(*given))
    status = np.full(np.shape(P), LUBRICATED) if status is None else status
    return [row.faces(flow.value) for flow in flows(plain_fluid(*laid), row.status(status), axis, scheme)]


def fluid_of(state, scheme):
    return fluid_state(state.P, state.H, state.contact, scheme.contact_law)


def test_couette_flow_across_the_lines_in_units_of_the_ellipse():
    """k_e 0.8 rho H of the line before (1B), with k_e = 2."""
    row, mesh = Row("y"), Mesh(3, 5, (0.0, 1.0), (0.0, 1.0), k_e=2.0)
    carried, _ = flows_of(row, axes_of(mesh, (0.6, 0.8))[1], [0.0, 0.0], [3.0, 5.0], 1.5, 0.0, Scheme())
    assert carried == pytest.approx(2.0 * 0.8 * 1.5 * 3.0, rel=1e-15)


def arrays_of(flow):
    return (flow.value, *flow.by_P.values(), *flow.by_H.values())


def closed_faces(status, axis):
    """Faces along an axis with contact on either side, by the statuses themselves."""
    return (axis.at(status) == CONTACT) | (axis.at(status, 1) == CONTACT)


def reaches_across(flow, status, axis):
    """Faces whose far nodes are solid: they are served by the nodes on their two sides."""
    across = np.zeros(flow.value.shape, dtype=bool)
    for node in {WW, EE} & set(flow.by_P):
        first, last = axis.reachable(status, [SHIFT[node]])
        axis.of_faces(across, first, last)[:] |= axis.at(status, SHIFT[node], first, last) == CONTACT
    return across


@every_scheme
def test_contact_closes_a_face_for_both_flows_and_all_derivatives(couette, mixed):
    """Liu eq. 4: nothing passes a closed face, and the open ones carry what they would without."""
    scheme = Scheme(couette, motion=(0.6, 0.8))
    fluid, no_contact = fluid_of(mixed, scheme), np.where(mixed.status == CONTACT, LUBRICATED, mixed.status)
    for axis in axes_of(mixed.mesh, scheme.motion):
        closed = closed_faces(mixed.status, axis)
        assert closed.any() and not closed.all()
        blocked = flows(fluid, mixed.status, axis, scheme, linearised=True)
        open_ones = flows(fluid, no_contact, axis, scheme, linearised=True)
        for flow, free in zip(blocked, open_ones, strict=True):
            unlike = closed | reaches_across(flow, mixed.status, axis)
            for array, free_array in zip(arrays_of(flow), arrays_of(free), strict=True):
                assert (array[closed] == 0.0).all()
                assert (array[~unlike] == free_array[~unlike]).all()
            assert free.value[closed].all()


# Liu eqs. 20-24: the pressure rise P_i - P_i-1 times eps/dX where the face carries no net flow.
BLOCKED_RISE = {
    "1B": lambda rho, H, i: rho[i - 1] * H[i - 1],
    "2B": lambda rho, H, i: (3.0 * rho[i - 1] * H[i - 1] - rho[i - 2] * H[i - 2]) / 2.0,
    "2C": lambda rho, H, i: (rho[i] * H[i] + rho[i - 1] * H[i - 1]) / 2.0,
    "S1B": lambda rho, H, i: rho[i] * H[i - 1],
    "S2C": lambda rho, H, i: (rho[i] * H[i - 1] + rho[i - 1] * H[i]) / 2.0,
    "3B": lambda rho, H, i: (
        (2.0 * rho[i] * H[i] + 5.0 * rho[i - 1] * H[i - 1] - rho[i - 2] * H[i - 2]) / 6.0
    ),
}


@along_both
@pytest.mark.parametrize("couette", BLOCKED_RISE)
def test_blocked_flow_recursion(couette, along):
    """Pressures by Eqs. 20-24 up to a contact node leave every face of the row without flow."""
    row, rng, n, dX = Row(along), np.random.default_rng(3), 9, 0.5
    rho, H, eps = rng.uniform(1.0, 1.4, n), np.linspace(1.0, 0.2, n), rng.uniform(0.5, 2.0, n)
    P = np.zeros(n)
    # The first face has no WW node: 2B and 3B fall back on 2C there.
    rules = ["2C" if couette in ("2B", "3B") else couette] + [couette] * (n - 2)
    for i, rule in enumerate(rules, start=1):
        P[i] = P[i - 1] + BLOCKED_RISE[rule](rho, H, i) * dX / (0.5 * (eps[i - 1] + eps[i]))
    status = np.full(n, LUBRICATED)
    status[0], status[-1] = BOUNDARY, CONTACT
    leaving, entering = flows_of(row, row.axis(dX, dX), P, H, rho, eps, Scheme(couette), status)
    assert np.abs(entering).max() < 1e-14
    assert leaving[-1] == 0.0
    if SCHEMES[couette].conservative:
        assert np.abs(leaving).max() < 1e-14
    # ... and the recursion is not empty: pressure climbs towards the block.
    assert (np.diff(P) > 0.1).all()


@pytest.mark.parametrize("mean", FACE_MOBILITIES)
def test_conductances_are_what_a_pressure_drives_through_a_face(mean, mixed):
    """Flow by a unit of pressure at E over the cell, at a held mobility: the rest of the flow cancels."""
    scheme = Scheme(face_mobility=mean)
    fluid = fluid_of(mixed, scheme)
    for axis in axes_of(mixed.mesh, scheme.motion):
        still = flows(replace(fluid, P=np.zeros_like(fluid.P)), mixed.status, axis, scheme)[0].value
        driven = flows(fluid, mixed.status, axis, scheme)[0].value
        rise = axis.at(fluid.P, 1) - axis.at(fluid.P)
        expected = (still - driven) / axis.cell
        conductance = conductances(fluid, mixed.status, axis, scheme)
        rounding = 1e-14 * np.abs(expected).max()
        np.testing.assert_allclose(conductance * rise, expected, rtol=1e-10, atol=rounding)
        assert (conductance[closed_faces(mixed.status, axis)] == 0.0).all() and conductance.any()


@pytest.mark.parametrize("h_b", [1e-2, 1e-3, 1e-4])
def test_with_the_boundary_film_the_flow_through_contact_goes_to_nothing(h_b, mixed):
    """What a pressure drives into contact falls with the square of the film that it keeps."""
    scheme = Scheme("1B", "linear-gap", contact_law=BoundaryFilm(h_b))
    H = np.where(mixed.status == CONTACT, h_b, 0.5)
    fluid = fluid_state(mixed.P, H, mixed.contact, scheme.contact_law)
    for axis in axes_of(mixed.mesh, scheme.motion):
        closed = closed_faces(mixed.status, axis)
        conductance = conductances(fluid, mixed.status, axis, scheme)
        assert 0.0 < conductance[closed].max() < 8.0 * (h_b / 0.5) ** 2 * conductance.max()


@every_scheme
def test_contact_at_its_boundary_film_carries_nothing_wherever_the_pressure_falls(couette, mixed):
    """Layers are not compressed: they need not become thicker behind a peak, so that it could not close."""
    scheme = Scheme(couette, "linear-gap", contact_law=BoundaryFilm(0.1))
    fluid = fluid_state(mixed.P, np.full_like(mixed.H, 0.1), mixed.contact, scheme.contact_law)
    immobile = replace(fluid, eps=np.zeros_like(fluid.eps))
    for axis in axes_of(mixed.mesh, scheme.motion):
        assert all((flow.value == 0.0).all() for flow in flows(immobile, mixed.status, axis, scheme))


@every_scheme
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_untreated_interface_stops_poiseuille_flow_only(couette, motion, mixed):
    """Every face keeps the Couette flow that a fluid without mobility has, closed ones nothing else."""
    untreated = Scheme(couette, couette_at_interface="untreated", motion=motion)
    fluid, no_contact = fluid_of(mixed, untreated), np.full_like(mixed.status, LUBRICATED)
    immobile = replace(fluid, eps=np.zeros_like(fluid.eps))
    for axis in axes_of(mixed.mesh, motion):
        carried = flows(immobile, no_contact, axis, untreated)
        both = flows(fluid, no_contact, axis, untreated)
        closed = closed_faces(mixed.status, axis)
        found = flows(fluid, mixed.status, axis, untreated)
        for flow, couette_flow, free in zip(found, carried, both, strict=True):
            np.testing.assert_array_equal(flow.value[closed], couette_flow.value[closed])
            np.testing.assert_array_equal(flow.value[~closed], free.value[~closed])
            assert flow.value[closed].any() == bool(axis.couette)
            assert (free.value != couette_flow.value)[closed].all()


@every_scheme
@pytest.mark.parametrize("interface", ["closed", "untreated"])
def test_nothing_passes_a_wall(couette, interface):
    """Not even an untreated Couette flow, and nothing is extrapolated from beyond."""
    row, scheme = Row("y"), Scheme(couette, couette_at_interface=interface)
    ones = row.lay(np.ones(4), 7.0)  # whatever lies beyond
    fluid = plain_fluid(row.lay([4.0, 3.0, 2.0, 1.0], 9.0), ones, ones, ones)
    for flow in flows(fluid, row.status(np.full(4, LUBRICATED)), row.axis(), scheme):
        assert flow.value[:, 0] == pytest.approx([0.0, 2.0, 2.0, 2.0, 0.0], rel=1e-15, abs=0.0)


@every_scheme
def test_motion_turns_the_couette_flow_round_and_nothing_else(couette, mixed):
    """Flows with and against the motion: their mean is the Poiseuille flow, half their difference rho H."""
    forth, back = Scheme(couette, motion=(0.6, 0.8)), Scheme(couette, motion=(-0.6, -0.8))
    fluid = fluid_of(mixed, forth)
    immobile = replace(fluid, eps=np.zeros_like(fluid.eps))
    still = replace(fluid, rho=np.zeros_like(fluid.rho))
    axes = zip(axes_of(mixed.mesh, forth.motion), axes_of(mixed.mesh, back.motion), strict=True)
    for ahead, behind in axes:
        every = (
            flows(fluid, mixed.status, ahead, forth), flows(fluid, mixed.status, behind, back),
            flows(immobile, mixed.status, ahead, forth), flows(still, mixed.status, ahead, forth),
        )  # fmt: skip
        for one, other, carried, driven in zip(*every, strict=True):
            np.testing.assert_allclose(one.value + other.value, 2.0 * driven.value, rtol=1e-13, atol=1e-15)
            np.testing.assert_allclose(one.value - other.value, 2.0 * carried.value, rtol=1e-13, atol=1e-15)


@along_both
@every_scheme
@pytest.mark.parametrize("velocity, behind", [(1.0, W), (-1.0, E)])
def test_half_a_cavity_passes_half_the_couette_flow(velocity, behind, couette, along):
    """Through the face ahead; its derivative by the filling is the full flow; pressures drive as ever."""
    row, scheme = Row(along), Scheme(couette)
    gap, P = [12.0, 11.0, 13.0, 12.0, 10.0, 11.0], [2.0, 1.0, 0.0, 0.0, 3.0, 1.0]
    torn = np.array([False, False, True, True, False, False])
    fluid = plain_fluid(*(row.lay(np.array(each)) for each in (P, gap, np.full(6, 2.0), np.full(6, 5.0))))
    holds = row.lay(torn, False), row.lay(np.where(torn, 0.5, 1.0), 1.0)
    half = replace(fluid, torn=holds[0], filling=holds[1])
    status, axis = row.status(np.full(6, LUBRICATED)), row.axis(couette=velocity)
    from_cavity = torn[:-1] if behind == W else torn[1:]

    def found(fluid, **how):
        return flows(fluid, status, axis, scheme, **how)

    def immobile(fluid):
        return replace(fluid, eps=np.zeros_like(fluid.eps))

    carried = found(immobile(fluid)), found(immobile(half), linearised=True)
    for full, part in zip(*carried, strict=True):
        whole = row.faces(full.value)
        assert (velocity * whole > 0.0).all()
        filled = np.where(from_cavity, 0.5, 1.0)
        np.testing.assert_allclose(row.faces(part.value), filled * whole, rtol=1e-14)
        by_filling = row.faces(part.by_P[behind])
        np.testing.assert_allclose(by_filling[from_cavity], whole[from_cavity], rtol=1e-14)
    pairs = ((found(each)[0], found(immobile(each))[0]) for each in (fluid, half))
    driven = [row.faces(one.value - other.value) for one, other in pairs]
    np.testing.assert_allclose(driven[1], driven[0], rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(driven[0], [5.0, 5.0, 0.0, -15.0, 10.0], rtol=1e-13, atol=1e-13)
