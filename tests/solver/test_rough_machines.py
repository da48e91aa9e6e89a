"""Rough contacts of machines, of sorts that were not found once."""

import pytest
from contacts import solved

STEEL = {
    "contact": {"radius_x": 3.8e-3, "radius_y": 19e-3, "reduced_modulus": 226e9, "load": 10.0},
    "lubricant": {"viscosity": 0.15, "pressure_viscosity": 16e-9},
    "motion": {"speed": 3.2e-3},
    "surface": {"kind": "self-affine", "rms": 52e-9, "hurst": 0.58, "seed": 29,
                "shortest_wavelength": 9.5e-6, "longest_wavelength": 27e-6},
}  # fmt: skip
"""A wide contact, lambda 0.2."""

POLYMER = {
    "contact": {"radius_x": 38.6e-3, "radius_y": 19.8e-3, "reduced_modulus": 4e9, "load": 291.0,
                "boundary_film": 5e-9},
    "lubricant": {"viscosity": 0.0168, "pressure_viscosity": 14.7e-9},
    "motion": {"speed": 1.7, "angle": 62.3},
    "surface": {"kind": "waviness", "amplitude": 1.4e-6, "wavelength_x": 189e-6},
}  # fmt: skip
"""Waves at an angle to the motion, lambda 0.6."""

RIDGES = {
    "contact": {"radius_x": 2.92e-3, "radius_y": 2.92e-3, "reduced_modulus": 226e9, "load": 13.2},
    "lubricant": {"viscosity": 0.0149, "pressure_viscosity": 9.6e-9, "viscosity_law": "roelands"},
    "motion": {"speed": 1.37},
    "surface": {"kind": "waviness", "amplitude": 110e-9, "wavelength_x": 28.3e-6, "wavelength_y": 19.6e-6},
}
"""Short waves along both axes under a film as thick as they are, which coarser grids do not see."""

CASES = [(STEEL, 24.21), (POLYMER, 579.97), (RIDGES, 58.16)]


@pytest.mark.parametrize("case, mean_gap", CASES, ids=["steel", "polymer", "ridges"])
def test_they_are_found_and_no_node_makes_oil(case, mean_gap):
    """They carry no load on contact. What enters the domain leaves it."""
    tables = case | {"grid": {"nodes": 129}, "solver": {"error": False}}
    result = solved(tables).result
    assert result.converged and result.contact.nodes == 0
    assert result.mixed.mean_gap_nm == pytest.approx(mean_gap, rel=1e-3)
    mass = result.mass
    assert mass.leaves == pytest.approx(mass.enters, rel=1e-7)
    made = mass.made_by_film, mass.made_by_cavity, mass.made_by_contact, mass.largest_node
    assert max(map(abs, made)) < 1e-7 * mass.enters
