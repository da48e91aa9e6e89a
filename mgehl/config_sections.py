"""The sections that several kinds of contact read: keys with default, unit, range and meaning.

Those that one kind alone takes are in its module of `mgehl.kinds`.
"""

from dataclasses import dataclass

from mgehl.config_value import AUTO, interval, number, switch, whole, word
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.fluid import FACE_MOBILITIES
from mgehl.discretization.scheme import INTERFACES, Scheme
from mgehl.kinds import KINDS
from mgehl.kinds.surface_kinds import BODIES, STILL
from mgehl.model.course import absolute_course
from mgehl.model.own_function import absolute


@dataclass(frozen=True)
class ContactSection:
    # fmt: off
    kind: str = word("point", "loaded point or line contact, or a rigid wedge bearing", tuple(KINDS))
    load: float | str = number(800.0, "normal load of a point contact; in time a table FILE.csv of s, N or "
        "FILE.py:FUNCTION", "N", 1e-6, 1e9, own=absolute_course)
    load_per_length: float | str = number(500e3, "load of a line contact; in time as contact.load", "N/m",
        1e-6, 1e12, own=absolute_course)
    radius_x: float = number(12.7e-3, "reduced radius along x", "m", 1e-6, 100.0)
    radius_y: float = number(12.7e-3, "reduced radius along y", "m", 1e-6, 100.0)
    reduced_modulus: float = number(219.78e9, "E' of 2/E' = sum of (1 - nu^2)/E, without coating", "Pa",
        1e3, 1e13)
    deformation: str = word("half-space", "what a point contact's bodies are in depth",
        ("half-space", "coated"), own=absolute)
    boundary_film: float = number(0.0, "film that adsorbed layers keep between solids; contact is where it "
        "would be thinner", "m", 0.0, 1e-6)
    ambient_pressure: float = number(0.0, "pressure of the oil around the contact, above that at which the "
        "film tears; pressures of a run are above it", "Pa", 0.0, 1e9)
    surface: str | None = word(None, "heights, a peak positive, by a function of one's own", own=absolute)
    surface_body: str = word(STILL, "the body that carries contact.surface: as surface.body", BODIES)
    # fmt: on


@dataclass(frozen=True)
class MotionSection:
    # fmt: off
    speed: float | str = number(5e-6, "entrainment speed u of the flow rho u h, of a wedge the plate's "
        "speed; in time 0, too, or a table FILE.csv of s, m/s or FILE.py:FUNCTION", "m/s", 0.0, 1e3,
        own=absolute_course, instead="body_1.rotation and motion.ring_rotation take rpm")
    angle: float | str = number(0.0, "direction in which both surfaces move, from +x towards +y; in time a "
        "table FILE.csv of s, deg or FILE.py:FUNCTION", "deg", -360.0, 360.0, own=absolute_course)
    slide_to_roll: float | None = number(None, "2 (u_1 - u_2)/(u_1 + u_2) of both surfaces' speeds; 2: "
        "body 2 stands still (unset: 0, nothing slides)", low=-100.0, high=100.0)
    ring_rotation: float | None = number(None, "of one ring of a rolling bearing against the other; body_1 "
        "is the ball, body_2 the raceway", "rad/s", 1e-9, 1e6)
    # fmt: on

    @property
    def slip(self):
        """The slide-to-roll ratio; 0 where none is given."""
        return self.slide_to_roll or 0.0


@dataclass(frozen=True)
class GridSection:
    # fmt: off
    nodes: int = whole(257, "nodes along each side, 2^k + 1", 65, 16385)
    x: tuple | str = interval(AUTO, "domain along x in units of the Hertz semi-axis a: two numbers, or by "
        "film and peaks")
    y: tuple | str = interval(AUTO, "the same along y in units of the semi-axis b")
    load_beyond: bool | None = switch(None, "whether load carried beyond the domain is counted (unset: "
        "where films answer to it)")
    # fmt: on


@dataclass(frozen=True)
class DiscretizationSection:
    # fmt: off
    couette: str | None = word(None, "differential scheme of the Couette flow (unset: 3B, and 3L of rough "
        "bodies)", tuple(SCHEMES))
    face_mobility: str = word("linear-gap", "mean of two nodes' mobilities at the face between them; by "
        "arithmetic, the paper's, contact of smooth bodies shuts its faces", FACE_MOBILITIES)
    contact_model: str = word("lcic", "interface conditions, the unified equations that have none, or "
        "contact without a fluid", ("lcic", "unified", "dry"))
    unified_gap: float = number(0.0, "smallest gap of the unified Poiseuille flow", "m", 0.0)
    couette_at_interface: str = word(Scheme.couette_at_interface, "Couette flow at the edge of contact: "
        "none, or as if there were no contact", INTERFACES)
    cavitation: bool | None = switch(None, "whether the film tears where its pressure falls to zero "
        "(unset: not in a wedge)")
    film_threshold: float = number(0.02e-9, "gap H_th at which a node is in contact", "m", 0.0)
    # fmt: on


@dataclass(frozen=True)
class SolverSection:
    # fmt: off
    method: str = word("newton-mg", "Newton's method with multigrid, or the paper's single-loop relaxation",
        ("newton-mg", "relaxation"))
    tolerance: float = number(1e-8, "rms residual and load error at convergence", above=0.0, high=1e-2)
    start: str = word("film", "first guess: a full film, or contact", ("film", "contact"))
    max_steps: int = whole(400, "Newton steps on one grid at the most", 0, 10000)
    idle_steps: int | None = whole(None, "steps in vain after which a solve is given up (unset: 15; in "
        "time 30; with peaks near the other body none)", 1, 10000)
    max_work: int = whole(3000, "convolutions after which a run ends without an answer; in time after "
        "which it has no beginning", 10, 10**7)
    linear_tolerance: float = number(0.1, "relative tolerance of GMRES in a Newton step", above=0.0,
        high=0.5)
    sweeps: int = whole(1, "line relaxations after the coarse grids", 1, 10)
    omega: float = number(0.8, "damping of the line relaxation", low=0.1, high=1.0)
    first_nodes: int = whole(65, "nodes of the first grid of the nested iteration", 33)
    inlet_cells: float = number(2.0, "cells the inlet gets on coarse grids by raising the speed", low=0.0,
        high=1000.0)
    squeeze: float = number(0.0, "rate of implicit time steps, per residual and cell (contact, "
        "continuation: at least 3)", low=0.0, high=1e6)
    error: bool = switch(True, "whether coarser grids are solved, too, for bands: two, in time or dry one")
    # fmt: on

    @property
    def by_newton(self):
        """Whether it is Newton's method, not the relaxation."""
        return self.method == "newton-mg"

    @property
    def from_film(self):
        """Whether the first guess is a film, not contact."""
        return self.start == "film"


@dataclass(frozen=True)
class RelaxationSection:
    fluid_update: str = word("line", "fluid pressures by lines or by points", ("line", "point"))
    contact_update: str = word("line", "contact pressures by lines or by points", ("line", "point"))
    omega: float = number(0.02, "relaxation factor of the pressure", above=0.0, high=1.0)
    contact_share: float = number(1.0 / 3.0, "part of it on contact nodes", above=0.0, high=1.0)
    stability: float = number(1.0, "stability factor C_c of the contact pressure", low=1.0, high=1000.0)
    load_factor: float = number(0.05, "H0 correction per unit of load error", above=0.0, high=10.0)
    load_every: int = whole(2, "sweeps from one correction of H0 to the next", 1, 1000)
    max_sweeps: int = whole(20000, "sweeps at the most", 1, 10**9)
