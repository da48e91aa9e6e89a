from dataclasses import replace

import numpy as np
import pytest
from dense import dense_stencil

from mgehl.discretization.axes import few_lines, own
from mgehl.discretization.contact_law import BoundaryFilm, UnifiedEquations
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.fluid import FACE_MOBILITIES
from mgehl.discretization.residual import linearise, residual
from mgehl.discretization.rows import FLOW, GAP, PRESSURE
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED
from mgehl.discretization.storage import Storage
from mgehl.model.rheology import Eyring, Friction

every_scheme = pytest.mark.parametrize("couette", SCHEMES)
every_mean = pytest.mark.parametrize("mean", FACE_MOBILITIES)
AT_AN_ANGLE = (0.6, 0.8)
along_and_at_an_angle = pytest.mark.parametrize("motion", [(1.0, 0.0), AT_AN_ANGLE])


def central_differences(function, x, d):
    """Matrix of a function's derivatives by every node of a ghosted array, of which none reaches farther
    than two lines or nodes: so every fifth is moved at once."""
    line, node = np.indices(x.shape)
    matrix = np.zeros((own(x).size, x.size))
    for first in np.ndindex(5, 5):
        moved = (line % 5 == first[0]) & (node % 5 == first[1])
        slope = (function(x + d * moved) - function(x - d * moved)) / (2.0 * d)
        for j, i in np.argwhere(moved):
            near = own((np.abs(line - j) <= 2) & (np.abs(node - i) <= 2))
            matrix[near.ravel(), j * x.shape[1] + i] = slope[near]
    return matrix


def assert_linearised(state, scheme, storage=None):
    rows = state.rows
    linear = linearise(state.evaluation(scheme), rows, storage)
    for name, d, stencil in (("P", 1e-6, linear.A), ("H", 1e-7, linear.B)):

        def function(changed, name=name):
            return residual(state.evaluation(scheme, storage=storage, **{name: changed}), rows)

        measured = central_differences(function, getattr(state, name), d)
        found, scale = dense_stencil(linear.offsets, stencil), np.abs(stencil).max()
        np.testing.assert_allclose(found, measured, rtol=1e-6, atol=1e-8 * scale)


@along_and_at_an_angle
@every_mean
@every_scheme
def test_linearisation_matches_central_differences(couette, mean, motion, mixed):
    assert_linearised(mixed, Scheme(couette, mean, motion=motion))


@every_mean
def test_linearisation_of_oil_that_shear_thins_matches_central_differences(mean, state):
    """The mobility along X and the one across differ, and so do their slopes."""
    friction = Friction(Eyring(1e4), slide_to_roll=2.0, thins=True)
    state.contact = replace(state.contact, friction=friction)
    assert_linearised(state, Scheme("3B", mean))
    fluid = state.evaluation().fluid
    ratio = fluid.across[state.H > 0.0] / fluid.eps[state.H > 0.0]
    assert 0.05 < ratio.min() < ratio.max() < 0.9


OPTIONS = {
    "untreated": {"couette_at_interface": "untreated", "motion": AT_AN_ANGLE},
    "against": {"motion": (-1.0, 0.0)},
    "across": {"motion": (0.0, 1.0)},
    "unified": {"motion": (-0.6, -0.8), "contact_law": UnifiedEquations(0.1)},
    "geometric share": {"face_mobility": "geometric", "mobility_share": 0.4},
    "harmonic share": {"face_mobility": "harmonic", "mobility_share": 0.4},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@every_scheme
def test_linearisation_of_options_matches_central_differences(couette, options, mixed):
    assert_linearised(mixed, Scheme(couette, **options))


LAYERS = {"motion": AT_AN_ANGLE, "contact_law": BoundaryFilm(0.1)}


@pytest.mark.parametrize("mean", ["arithmetic", "geometric", "linear-gap"])
@every_scheme
def test_linearisation_in_a_film_and_beside_layers_matches_central_differences(couette, mean, film):
    assert_linearised(film, Scheme(couette, mean, **({} if mean == "arithmetic" else LAYERS)))


@along_and_at_an_angle
@every_mean
@every_scheme
def test_linearisation_by_contents_matches_central_differences(couette, mean, motion, mixed):
    """Cavities answer to the flow by what they hold; their pressure is given."""
    scheme, torn = Scheme(couette, mean, motion=motion), mixed.status == CAVITATED
    filling = np.random.default_rng(3).uniform(0.3, 0.9, torn.shape)
    storage = Storage.begun(mixed.evaluation(filling=np.full(torn.shape, 0.5)).fluid, 2.0)
    rows = np.where(own(torn), FLOW, mixed.rows)
    linear = linearise(mixed.evaluation(scheme, filling=filling), rows, storage)
    fields = {"P": mixed.P, "H": mixed.H, "filling": filling}

    def measured(name, d):
        def function(changed):
            changes = fields | {name: changed}
            return residual(mixed.evaluation(scheme, storage=storage, **changes), rows)

        return central_differences(function, fields[name], d)

    by_unknown = np.where(torn.ravel(), measured("filling", 1e-6), measured("P", 1e-6))
    for stencil, expected in ((linear.by_unknown, by_unknown), (linear.B, measured("H", 1e-7))):
        found, scale = dense_stencil(linear.offsets, stencil), np.abs(stencil).max()
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8 * scale)
    by_P = dense_stencil(linear.offsets, linear.A)
    assert not by_P[:, torn.ravel()].any()


def test_rows_of_a_given_pressure_or_gap_couple_to_nothing_else(mixed):
    rows = mixed.rows
    linear = linearise(mixed.evaluation(), rows)
    for stencil, kind in ((linear.A, PRESSURE), (linear.B, GAP)):
        assert (stencil[0][rows == kind] == -1.0 / mixed.mesh.dX).all()
        assert not stencil[0][(rows != FLOW) & (rows != kind)].any()
        assert not stencil[1:][:, rows != FLOW].any()


@every_mean
@pytest.mark.parametrize("motion", [(1.0, 0.0), AT_AN_ANGLE], ids=["along x", "at an angle"])
def test_a_few_lines_at_a_time_give_what_all_at_once_do(motion, mean, mixed, monkeypatch):
    """To the last digit, in the arrays of a linearisation that is not needed any more, too."""
    scheme = Scheme("2B", mean, motion=motion)
    evaluation, rows = mixed.evaluation(scheme), mixed.rows
    whole = linearise(evaluation, rows)
    monkeypatch.setattr("mgehl.discretization.axes.FEW", rows.shape[1])
    assert len(few_lines(rows)) == len(rows) > 2
    room = linearise(evaluation, np.full_like(rows, PRESSURE))
    parts = linearise(evaluation, rows, room=room)
    assert parts.A is room.A and parts.B is room.B
    np.testing.assert_array_equal(parts.A, whole.A)
    np.testing.assert_array_equal(parts.B, whole.B)


@pytest.fixture(params=[0.3, 40.0, "each its own"])
def rate(request, state):
    if request.param != "each its own":
        return request.param
    shape = own(state.P).shape
    return np.arange(1.0, 1.0 + np.prod(shape)).reshape(shape)


@pytest.fixture
def storage(state, rate):
    return Storage.begun(state.evaluation(P=0.9 * state.P, H=1.1 * state.H).fluid, rate)


def test_linearisation_of_a_time_step_matches_central_differences(state, storage):
    assert_linearised(state, Scheme("2B", motion=AT_AN_ANGLE), storage)
