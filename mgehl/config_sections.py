"""The sections that several kinds of contact read: keys with default, unit, range and meaning.

Those that one kind alone takes are in its module of `mgehl.kinds`.
"""

from dataclasses import dataclass

from mgehl.config_value import AUTO, key_field
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.fluid import FACE_MOBILITIES
from mgehl.discretization.scheme import INTERFACES, Scheme
from mgehl.kinds import KINDS
from mgehl.kinds.surface_kinds import BODIES, STILL
from mgehl.model.course import absolute_course
from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS
from mgehl.model.oils import OILS
from mgehl.model.own_function import absolute
from mgehl.model.rheology import Friction


@dataclass(frozen=True)
class ContactSection:
    kind: str = key_field(
        "point", "loaded point or line contact, or a rigid wedge bearing",
        choices=tuple(KINDS), kind=str,
    )  # fmt: skip
    load: float | str = key_field(
        800.0, "normal load of a point contact; in time a table FILE.csv of s, N or FILE.py:FUNCTION", "N",
        low=1e-6, high=1e9, own=absolute_course,
    )  # fmt: skip
    load_per_length: float | str = key_field(
        500e3, "load of a line contact; in time as contact.load", "N/m", low=1e-6, high=1e12,
        own=absolute_course,
    )  # fmt: skip
    radius_x: float = key_field(12.7e-3, "reduced radius along x", "m", low=1e-6, high=100.0)
    radius_y: float = key_field(12.7e-3, "reduced radius along y", "m", low=1e-6, high=100.0)
    reduced_modulus: float = key_field(
        219.78e9, "E' of 2/E' = sum of (1 - nu^2)/E, without coating", "Pa", low=1e3, high=1e13
    )
    deformation: str = key_field(
        "half-space", "what a point contact's bodies are in depth",
        choices=("half-space", "coated"), kind=str, own=absolute,
    )  # fmt: skip
    boundary_film: float = key_field(
        0.0, "film that adsorbed layers keep between solids; contact is where it would be thinner", "m",
        low=0.0, high=1e-6,
    )  # fmt: skip
    surface: str | None = key_field(
        None, "heights, a peak positive, by a function of one's own", kind=str, own=absolute
    )
    surface_body: str = key_field(
        STILL, "the body that carries contact.surface: as surface.body", choices=BODIES, kind=str
    )


@dataclass(frozen=True)
class LubricantSection:
    viscosity: float = key_field(
        0.096, "viscosity at ambient pressure", "Pa*s", low=1e-6, high=1e4,
        instead="lubricant.kinematic_viscosity takes cSt, beside lubricant.density",
    )  # fmt: skip
    viscosity_law: str = key_field(
        "barus", "viscosity-pressure law", choices=tuple(VISCOSITY_LAWS), kind=str, own=absolute
    )
    pressure_viscosity: float = key_field(
        18.2e-9, "pressure-viscosity coefficient", "1/Pa", low=1e-10, high=1e-6
    )
    density_law: str = key_field(
        "dowson-higginson", "density-pressure law", choices=tuple(DENSITY_LAWS), kind=str, own=absolute
    )
    oil: str | None = key_field(
        None, "a measured oil, for viscosity and its law at lubricant.temperature",
        choices=tuple(OILS), kind=str,
    )  # fmt: skip
    temperature: float | None = key_field(
        None, "temperature of the oil in the inlet", "K", low=200.0, high=600.0
    )
    kinematic_viscosity: float | None = key_field(
        None, "viscosity over density, beside lubricant.density", "m^2/s", low=1e-9, high=10.0
    )
    kinematic_viscosity_40: float | None = key_field(
        None, "the same at 40 degrees C, from which with that at 100 it is found at lubricant.temperature",
        "m^2/s", low=2e-6, high=0.1,
    )  # fmt: skip
    kinematic_viscosity_100: float | None = key_field(
        None, "the same at 100 degrees C", "m^2/s", low=1e-6, high=0.1
    )
    density: float | None = key_field(
        None, "density at that temperature, some 5 % less at 80 than a data sheet's at 15 degrees C",
        "kg/m^3", low=100.0, high=1e4,
    )  # fmt: skip
    conductivity: float | None = key_field(
        None, "thermal conductivity (mineral oils: .12 to .15)", "W/m/K", low=1e-3, high=1e3
    )
    thermoviscosity: float | None = key_field(
        None, "beta of viscosity ~ exp(-beta T) (mineral oils: .02 to .06)", "1/K", low=1e-5, high=1.0
    )
    heating: str = key_field(
        "none", "whether shear in the inlet thins the oil by a factor of the film (Gupta and others)",
        choices=("none", "factor"), kind=str,
    )  # fmt: skip


@dataclass(frozen=True)
class MotionSection:
    speed: float | str = key_field(
        5e-6, "entrainment speed u of the flow rho u h; in time a table FILE.csv of s, m/s or "
        "FILE.py:FUNCTION", "m/s", low=1e-12, high=1e3, own=absolute_course,
        instead="body_1.rotation and motion.ring_rotation take rpm",
    )  # fmt: skip
    angle: float = key_field(
        0.0, "direction in which both surfaces move, from +x towards +y", "deg", low=-360.0, high=360.0
    )
    slide_to_roll: float = key_field(
        0.0, "2 (u_1 - u_2)/(u_1 + u_2) of both surfaces' speeds; 2: body 2 stands still",
        low=-100.0, high=100.0,
    )  # fmt: skip
    ring_rotation: float | None = key_field(
        None, "of one ring of a rolling bearing against the other; body_1 is the ball, body_2 the raceway",
        "rad/s", low=1e-9, high=1e6,
    )  # fmt: skip


@dataclass(frozen=True)
class FrictionSection:
    model: str | None = key_field(
        None, "how the sheared oil resists (unset: newtonian)",
        choices=("newtonian", "eyring", "limiting"), kind=str, own=absolute,
    )  # fmt: skip
    eyring_stress: float | None = key_field(
        None, "tau_0 of tau = tau_0 asinh(eta gamma'/tau_0), below a limit, too", "Pa", low=1e3, high=1e9
    )
    limiting_coefficient: float | None = key_field(
        None, "largest shear stress of the oil over its pressure (.03 to .06 measured)", above=0.0, high=1.0
    )
    boundary_coefficient: float = key_field(
        Friction.boundary_coefficient,
        "shear stress between solids over the pressure they carry (.08 to .135 measured)",
        low=0.0, high=2.0,
    )  # fmt: skip
    thinning: bool | None = key_field(
        None, "whether shear thins the film (unset: where there is an Eyring stress and surfaces slide)",
        kind=bool,
    )  # fmt: skip


@dataclass(frozen=True)
class HeatSection:
    conductivity_1: float | None = key_field(
        None, "thermal conductivity of body 1 (steel: 46); all four give flash temperatures",
        "W/m/K", low=1e-3, high=1e4,
    )  # fmt: skip
    conductivity_2: float | None = key_field(None, "the same of body 2", "W/m/K", low=1e-3, high=1e4)
    capacity_1: float | None = key_field(
        None, "heat capacity of body 1 per volume (steel: 3.6e6)", "J/m^3/K", low=1e3, high=1e8
    )
    capacity_2: float | None = key_field(None, "the same of body 2", "J/m^3/K", low=1e3, high=1e8)


@dataclass(frozen=True)
class GridSection:
    nodes: int = key_field(257, "nodes along each side, 2^k + 1", low=65, high=16385, kind=int)
    x: tuple | str = key_field(
        AUTO,
        "domain along x in units of the Hertz semi-axis a: two numbers, or by film and peaks",
        kind=tuple,
    )
    y: tuple | str = key_field(AUTO, "the same along y in units of the semi-axis b", kind=tuple)
    load_beyond: bool | None = key_field(
        None, "whether load carried beyond the domain is counted (unset: where films answer to it)",
        kind=bool,
    )  # fmt: skip


@dataclass(frozen=True)
class DiscretizationSection:
    couette: str | None = key_field(
        None,
        "differential scheme of the Couette flow (unset: 3B, and 3L of rough bodies)",
        choices=tuple(SCHEMES), kind=str,
    )  # fmt: skip
    face_mobility: str = key_field(
        "linear-gap", "mean of two nodes' mobilities at the face between them",
        choices=FACE_MOBILITIES, kind=str,
    )  # fmt: skip
    contact_model: str = key_field(
        "lcic", "interface conditions, the unified equations that have none, or contact without a fluid",
        choices=("lcic", "unified", "dry"), kind=str,
    )  # fmt: skip
    unified_gap: float = key_field(0.0, "smallest gap of the unified Poiseuille flow", "m", low=0.0)
    couette_at_interface: str = key_field(
        Scheme.couette_at_interface,
        "Couette flow at the edge of contact: none, or as if there were no contact",
        choices=INTERFACES, kind=str,
    )  # fmt: skip
    cavitation: bool | None = key_field(
        None, "whether the film tears where its pressure falls to zero (unset: not in a wedge)", kind=bool
    )
    film_threshold: float = key_field(0.02e-9, "gap H_th at which a node is in contact", "m", low=0.0)


@dataclass(frozen=True)
class SolverSection:
    method: str = key_field(
        "newton-mg", "Newton's method with multigrid, or the paper's single-loop relaxation",
        choices=("newton-mg", "relaxation"), kind=str,
    )  # fmt: skip
    tolerance: float = key_field(1e-8, "rms residual and load error at convergence", above=0.0, high=1e-2)
    start: str = key_field(
        "film", "first guess: a full film, or contact",
        choices=("film", "contact"), kind=str,
    )  # fmt: skip
    max_steps: int = key_field(200, "Newton steps on one grid at the most", low=0, high=10000, kind=int)
    idle_steps: int | None = key_field(
        None,
        "steps in vain after which a solve is given up (unset: 15; in time 30; rough, soft, layered 60)",
        low=1, high=10000, kind=int,
    )  # fmt: skip
    max_work: int = key_field(
        3000, "convolutions after which a run ends without an answer", low=10, high=10**7, kind=int
    )
    linear_tolerance: float = key_field(
        0.1, "relative tolerance of GMRES in a Newton step", above=0.0, high=0.5
    )
    sweeps: int = key_field(1, "line relaxations after the coarse grids", low=1, high=10, kind=int)
    omega: float = key_field(0.8, "damping of the line relaxation", low=0.1, high=1.0)
    cycle_couette: str = key_field(
        "same", "differential scheme of the preconditioner's operators",
        choices=("same", *SCHEMES), kind=str,
    )  # fmt: skip
    first_nodes: int = key_field(65, "nodes of the first grid of the nested iteration", low=33, kind=int)
    inlet_cells: float = key_field(
        2.0, "cells the inlet gets on coarse grids by raising the speed", low=0.0, high=1000.0
    )
    squeeze: float = key_field(
        0.0, "rate of implicit time steps, per residual and cell (contact, continuation: at least 3)",
        low=0.0, high=1e6,
    )  # fmt: skip
    error: bool = key_field(
        True, "whether two coarser grids are solved, too, for bands about the films", kind=bool
    )
    release_budget: int = key_field(
        2, "times a contact node may be released on Eq. 2", low=0, high=100, kind=int
    )


@dataclass(frozen=True)
class RelaxationSection:
    fluid_update: str = key_field(
        "line", "fluid pressures by lines or by points", choices=("line", "point"), kind=str
    )
    contact_update: str = key_field(
        "line", "contact pressures by lines or by points", choices=("line", "point"), kind=str
    )
    omega: float = key_field(0.02, "relaxation factor of the pressure", above=0.0, high=1.0)
    contact_share: float = key_field(1.0 / 3.0, "part of it on contact nodes", above=0.0, high=1.0)
    stability: float = key_field(1.0, "stability factor C_c of the contact pressure", low=1.0, high=1000.0)
    load_factor: float = key_field(0.05, "H0 correction per unit of load error", above=0.0, high=10.0)
    load_every: int = key_field(
        2, "sweeps from one correction of H0 to the next", low=1, high=1000, kind=int
    )
    max_sweeps: int = key_field(20000, "sweeps at the most", low=1, high=10**9, kind=int)
