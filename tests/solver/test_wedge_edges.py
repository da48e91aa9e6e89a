"""Edges of a pocket that lie anywhere between nodes: exact steps, edges at the pad's own, rupture there."""

import numpy as np
import pytest
from contacts import solved

from mgehl.config import config_from_tables
from mgehl.discretization.residual import linearise
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED
from mgehl.kinds import contact_from, mesh_from
from mgehl.solver.from_config import scheme_from
from mgehl.solver.wedge import WedgeProblem
from mgehl.studies.study import merged

LENGTH, FILM, DEPTH, ETA = 20e-3, 10e-6, 9e-6, 0.01
STEP = {
    "contact": {"kind": "wedge"},
    "wedge": {"length": LENGTH, "inlet_film": FILM, "exit_film": FILM, "width": 10e-3, "sides": "closed",
              "pocket_depth": DEPTH, "pocket_from": 0.0, "pocket_to": 14e-3},
    "lubricant": {"viscosity": ETA}, "motion": {"speed": 1.0}, "grid": {"nodes": 65},
    "discretization": {"cavitation": True},
}  # fmt: skip
"""Rayleigh's step bearing: its pocket begins with the pad."""


def pressures(solution):
    """x from the inlet and p in Pa."""
    return 1e-3 * solution.mesh.X, solution.contact.pressure_scale * solution.fields.P[0]


@pytest.mark.parametrize("end", [14e-3, 14.05e-3, 14.1e-3, 14.2e-3, 14.36e-3])
@pytest.mark.parametrize("couette", ["1B", "3B"])
def test_rayleigh_s_step_is_exact_at_nodes(end, couette):
    """p rises to the step, where the flows of both gaps are one, and falls: none of the film tears."""
    found = solved(STEP, {"wedge": {"pocket_to": end}, "discretization": {"couette": couette}})
    deep, rest = FILM + DEPTH, LENGTH - end
    top = 6.0 * ETA * DEPTH / (deep**3 / end + FILM**3 / rest)
    x, p = pressures(found)
    expected = top * np.minimum(x / end, (LENGTH - x) / rest)
    np.testing.assert_allclose(p[:-1], expected[:-1], rtol=0.0, atol=1e-9 * top)
    assert found.result.converged and found.result.cavitated_nodes == 0
    assert found.result.mass.enters == pytest.approx(
        10e-3 * (0.5 * FILM + FILM**3 * top / (12 * ETA * rest))
    )


@pytest.mark.parametrize("sides", ["open", "closed"])
def test_a_pocket_as_large_as_the_pad_is_a_pad_with_larger_films(sides):
    """Cells on the pad's edges lie half outside; their gap is that of the pad, and none of it tears."""
    films = {"inlet_film": 20e-6, "exit_film": 10e-6, "sides": sides}
    films |= {"pocket_to": LENGTH, "pocket_depth": 10e-6}
    whole = solved(STEP, {"wedge": films})
    shallow = {key: value for key, value in STEP["wedge"].items() if not key.startswith("pocket")}
    pad = solved(STEP | {"wedge": shallow | {"inlet_film": 30e-6, "exit_film": 20e-6, "sides": sides}})
    assert whole.result.cavitated_nodes == 0
    assert whole.result.load_N == pytest.approx(pad.result.load_N, rel=1e-4)
    np.testing.assert_allclose(whole.film, pad.film, rtol=1e-12)


POCKET = {"inlet_film": 1.1e-6, "exit_film": 1e-6, "pocket_depth": 0.4e-6, "pocket_from": 4.2e-3,
          "pocket_to": 9.9e-3, "ambient_pressure": 1e5}  # fmt: skip

BACKWARDS = {"exit": 20e-3, "inlet": 40e-3, "slope": 1e-4, "sides": "closed", "pocket_depth": 0.4e-6,
             "pocket_from": 30.2e-3, "pocket_to": 35.8e-3}  # fmt: skip


@pytest.mark.parametrize("torn", [(13, 19), (14, 20)], ids=["before the edge, too", "behind it"])
@pytest.mark.parametrize("turned", [True, False], ids=["along the axis", "against it"])
def test_derivatives_beside_edges(make_grid, torn, turned):
    """Of the net inflow of every node, by pressures and contents, beside what is measured."""
    tables = merged(STEP, {"wedge": POCKET})
    if not turned:
        tables["wedge"] = BACKWARDS
    config = config_from_tables(tables)
    bearing = contact_from(config)
    problem = WedgeProblem(make_grid(mesh_from(config, bearing)), bearing, scheme_from(config, bearing))
    state, chance = problem.first_guess(), np.random.default_rng(1)
    inner = state.status != BOUNDARY
    nodes = slice(*(torn if turned else (-torn[1], -torn[0])))
    state.status[inner] = LUBRICATED
    state.status[:, nodes] = CAVITATED
    pulls = state.status == CAVITATED
    state.P[:] = np.where(pulls | ~inner, 0.0, chance.uniform(0.01, 0.03, state.P.shape))
    state.p[:] = state.P
    state.filling[:] = np.where(pulls, chance.uniform(0.6, 0.9, state.P.shape), 1.0)
    evaluation = problem.evaluate(state)
    found = linearise(evaluation, problem.rows(state.status))
    for i in np.flatnonzero(inner[0]):
        unknown = state.filling if pulls[0, i] else state.P
        before, unknown[0, i] = unknown[0, i], unknown[0, i] + 1e-6
        state.p[:] = state.P
        measured = (problem.evaluate(state).inflow - evaluation.inflow)[0] / 1e-6
        unknown[0, i], state.p[0, i] = before, before if not pulls[0, i] else state.P[0, i]
        told = np.zeros(measured.size)
        for (_, shift), column in zip(found.offsets, found.by_unknown, strict=True):
            if 0 < i - shift < measured.size - 1:
                told[i - shift] = column[0, i - shift]
        flowing = problem.rows(state.status)[0] == 0
        np.testing.assert_allclose(
            told[flowing], measured[flowing], rtol=1e-5, atol=1e-5 * np.abs(measured).max()
        )
