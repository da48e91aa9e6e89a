"""Where hardly any oil flows through, a solution is solved on until no node makes oil."""

import pytest

import mgehl
from mgehl.solver import closing
from mgehl.solver.mass import CLOSED

ROLLER = {
    "contact.kind": "line", "contact.load_per_length": 1.4059e6, "contact.radius_x": 0.032776,
    "contact.reduced_modulus": 110e9, "contact.boundary_film": 5e-9,
    "surface.kind": "self-affine", "surface.rms": 1e-8, "surface.hurst": 0.689, "surface.seed": 75,
    "surface.shortest_wavelength": 9.3253e-5, "surface.longest_wavelength": 1.90065e-4,
    "lubricant.viscosity": 0.0098064, "lubricant.pressure_viscosity": 1.0584e-8,
    "motion.speed": 1.24358e-3, "grid.nodes": 1025, "solver.start": "film", "solver.error": False,
}  # fmt: skip
"""Solids carry nearly all; the layers let some oil through."""


def test_no_node_makes_oil_where_layers_alone_let_some_through(monkeypatch):
    closed = mgehl.solve(mgehl.load(None, ROLLER)).summary
    monkeypatch.setattr(closing, "ROUNDS", 0)
    first = mgehl.solve(mgehl.load(None, ROLLER)).summary
    assert first.settled and not first.converged and first.mass.made_share > CLOSED
    assert closed.converged and closed.mass.made_share < CLOSED
    assert closed.work.convolutions < first.work.convolutions + 40.0
    assert closed.mixed.mean_gap_nm == pytest.approx(first.mixed.mean_gap_nm, rel=1e-6)
