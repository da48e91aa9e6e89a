"""Film-thickness formulas to compare with; every function returns metres."""

from dataclasses import dataclass
from math import exp, log, sqrt

SOFT = 2.0
"""Isoviscous film over the piezoviscous one from which on the oil hardly stiffens: the formula of Ertel
and Grubin says half of the film there, and less."""


@dataclass(frozen=True)
class Formula:
    """What a formula is called and what it assumes. All assume smooth bodies, Newtonian oil of one
    temperature, and as much of it as the inlet takes."""

    label: str
    assumes: str
    source: str
    """A key of `mgehl.model.sources.SOURCES`."""
    bodies: str = "hard"
    """"hard": the oil stiffens before the bodies yield; "soft": they yield before it does; "any"."""
    incompressible: bool = False
    """Otherwise made for the density law of Dowson and Higginson."""


FORMULAS = {
    "hamrock_dowson": Formula(
        "Hamrock and Dowson", "hard bodies, oil that Dowson and Higginson's law compresses", "hamrock1977"
    ),
    "hamrock_dowson_soft": Formula(
        "Hamrock and Dowson, soft", "soft bodies, oil of constant viscosity and density", "hamrock1978",
        "soft", True,
    ),
    "nijenbanning_venner_moes": Formula(
        "Nijenbanning, Venner and Moes", "rigid, soft or hard bodies, incompressible oil",
        "nijenbanning1994", "any", True,
    ),
    "chittenden": Formula(
        "Chittenden and others", "as Hamrock and Dowson, moving in any direction", "chittenden1985"
    ),
    "dowson_higginson": Formula(
        "of the Dowson-Higginson type", "hard bodies, oil that their law compresses", "dowson1966"
    ),
    "moes": Formula("Moes", "rigid, soft or hard bodies, incompressible oil", "moes1992", "any", True),
    "grubin": Formula(
        "Ertel and Grubin", "hard bodies, Hertz's gap near its edge, incompressible oil of Barus' law",
        "grubin1949", incompressible=True,
    ),
}  # fmt: skip
"""By their names, less the film that they tell: _central, _minimum."""


def formula_of(name):
    """The `Formula` of a film's name."""
    return FORMULAS[name.removesuffix("_central").removesuffix("_minimum")]


def both(name, found):
    """{film: metres} of a formula that tells the central and the minimum one."""
    return dict(zip((f"{name}_central", f"{name}_minimum"), found, strict=True))


def applies(name, regime):
    """Whether a film's formula is made for bodies of a `regime`."""
    made_for = formula_of(name).bodies
    if made_for == "soft":
        return regime == "elastic isoviscous"
    return made_for == "any" or "isoviscous" not in regime


def hamrock_dowson(groups, radius_x, ellipticity):
    """Central and minimum film of Hamrock and Dowson; `ellipticity` k = b/a."""
    U, W, G = groups.U, groups.W, groups.G
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * exp(-0.73 * ellipticity))
    minimum = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - exp(-0.68 * ellipticity))
    return central * radius_x, minimum * radius_x


def hamrock_dowson_soft(groups, radius_x, ellipticity):
    """Central and minimum film of Hamrock and Dowson (1978) for bodies of low modulus."""
    U, W = groups.U, groups.W
    central = 7.32 * (1.0 - 0.72 * exp(-0.28 * ellipticity)) * U**0.64 * W**-0.22
    minimum = 7.43 * (1.0 - 0.85 * exp(-0.31 * ellipticity)) * U**0.65 * W**-0.21
    return central * radius_x, minimum * radius_x


def chittenden(groups, along, across):
    """Central and minimum film of Chittenden, Dowson, Dunn and Taylor (1985) for entrainment at any angle,
    to 20 %. `along` and `across` are radii along and across the motion, in m; groups are by the first."""
    slender = (across / along) ** (2.0 / 3.0)
    common = groups.U**0.68 * groups.G**0.49 * groups.W**-0.073 * along
    return 4.31 * common * (1.0 - exp(-1.23 * slender)), 3.68 * common * (1.0 - exp(-0.67 * slender))


def dowson_higginson(groups, radius_x):
    """Central and minimum film of a line contact, of the type of Dowson and Higginson."""
    U, W, G = groups.U, groups.W, groups.G
    central = 3.06 * U**0.69 * G**0.56 * W**-0.10
    minimum = 2.65 * U**0.70 * G**0.54 * W**-0.13
    return central * radius_x, minimum * radius_x


def nijenbanning_venner_moes(groups, radius_x, radius_y):
    """Central film of Nijenbanning, Venner and Moes for every regime."""
    D = radius_x / radius_y
    RI, EI, RP, EP = point_asymptotes(groups, D)
    H00 = 1.8 / D
    s = 1.5 * (1.0 + exp(-1.2 * EI / RI))
    isoviscous = RI**1.5 + (EI**-4.0 + H00**-4.0) ** (-3 / 8)
    H = (isoviscous ** (2 * s / 3) + _below_both(RP, EP, 8.0) ** s) ** (1.0 / s)
    return H * radius_x * sqrt(2.0 * groups.U)


def point_asymptotes(groups, D):
    """H_Moes of a point contact of D = R_x/R_y: rigid and elastic isoviscous, the same piezoviscous."""
    M, L = groups.M, groups.L
    shape = 1.0 + 0.006 * log(D) + 0.63 * D ** (4 / 7)
    RI = 145.0 * (1.0 + 0.796 * D ** (14 / 15)) ** (-15 / 7) / D * M**-2.0
    EI = 3.18 * shape ** (-14 / 25) * D ** (-1 / 15) * M ** (-2 / 15)
    RP = 1.29 * (1.0 + 0.691 * D) ** (-2 / 3) * L ** (2 / 3)
    EP = 1.48 * shape ** (-7 / 20) * D ** (-1 / 24) * M ** (-1 / 12) * L**0.75
    return RI, EI, RP, EP


def line_asymptotes(groups):
    """The same of a line contact [Moes 1992]."""
    M, L = groups.M, groups.L
    return 3.0 / M, 2.621 * M**-0.2, 1.287 * L ** (2 / 3), 1.311 * M**-0.125 * L**0.75


def moes_line(groups, radius_x):
    """Central film of a line contact for every regime [Moes 1992]."""
    RI, EI, RP, EP = line_asymptotes(groups)
    s = (7.0 + 8.0 * exp(-2.0 * EI / RI)) / 5.0
    isoviscous = RI ** (7 / 3) + EI ** (7 / 3)
    H = (isoviscous ** (3 * s / 7) + _below_both(RP, EP, 3.5) ** s) ** (1.0 / s)
    return H * radius_x * sqrt(2.0 * groups.U)


def _below_both(RP, EP, power):
    """The piezoviscous film between both asymptotes; none where pressure does not stiffen the oil."""
    return (RP**-power + EP**-power) ** (-1.0 / power) if RP > 0.0 else 0.0


def is_isoviscous(RI, EI, RP, EP):
    """Whether a film is as thick as oil makes it that the pressure does not stiffen."""
    return max(RI, EI) > min(RP, EP)


def hardly_stiffens(RI, EI, RP, EP):
    """Whether the film is that of oil which the pressure hardly stiffens."""
    return max(RI, EI) > SOFT * min(RP, EP)


def regime(RI, EI, RP, EP):
    """Name of the asymptote that a film is nearest to; a piezoviscous one is bounded by elasticity."""
    isoviscous = (RI, "rigid isoviscous") if RI > EI else (EI, "elastic isoviscous")
    piezoviscous = (RP, "rigid piezoviscous") if RP < EP else (EP, "elastic piezoviscous")
    return max(isoviscous, piezoviscous)[1]


def grubin(pressure_viscosity, viscosity, speed, a, gap_coefficient):
    """Ertel-Grubin film of a heavily loaded contact with dry edge gap C s^(3/2)."""
    return (12.0 * 0.2687 * pressure_viscosity * viscosity * speed * a) ** 0.75 / sqrt(gap_coefficient)


def inlet_heating(pressure, Q, slide_to_roll):
    """Film with heat by shear in the inlet over the isothermal one, of Gupta and others (1992). `pressure`
    is p_h/E', Q = eta0 beta u^2/k with the oil's thinning beta in 1/K and conductivity k."""
    slid = 1.0 + 2.23 * abs(slide_to_roll) ** 0.83
    return (1.0 - 13.2 * pressure * Q**0.42) / (1.0 + 0.213 * slid * Q**0.64)
