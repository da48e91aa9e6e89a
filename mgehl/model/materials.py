"""Elasticity of materials that bodies are often made of."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """An isotropic elastic solid at room temperature."""

    modulus: float
    """Young's modulus in Pa."""
    poisson: float
    source: str
    """A key of `mgehl.model.sources.SOURCES`."""


MATERIALS = {
    "steel": Material(206e9, 0.30, "iso6336"),  # 200 to 210 GPa
    "cast iron": Material(118e9, 0.30, "iso6336"),  # grey iron; 90 to 130 GPa
    "bronze": Material(113e9, 0.30, "iso6336"),  # tin bronze; 100 to 120 GPa
    "aluminium": Material(70e9, 0.33, "handbook"),  # alloys 68 to 75 GPa
    "silicon nitride": Material(310e9, 0.26, "astmf2094"),  # of bearing grade; 270 to 330 GPa
    "tungsten carbide": Material(630e9, 0.22, "handbook"),  # with 6 % cobalt; 550 to 650 GPa
    "sapphire": Material(403e9, 0.235, "goto1989"),  # mean over directions, which differ by some 10 %
    "glass": Material(82e9, 0.206, "schott"),  # N-BK7; float glass 70 to 74 GPa
    "PEEK": Material(4.0e9, 0.40, "victrex"),  # unfilled, 23 C; 3.5 to 4.2 GPa, less when warm
}
"""By their names; beside them how far makers and grades differ."""

ALSO = {
    "100Cr6": "steel",
    "AISI 52100": "steel",
    "52100": "steel",
    "16MnCr5": "steel",
    "aluminum": "aluminium",
    "Si3N4": "silicon nitride",
    "WC": "tungsten carbide",
    "BK7": "glass",
}
"""Other names of theirs."""


def reduced_modulus(first, second):
    """E' of 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; each body is its (E in Pa, nu)."""
    return 2.0 / sum((1.0 - poisson**2) / modulus for modulus, poisson in (first, second))
