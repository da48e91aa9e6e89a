"""Point and line contacts without a fluid: the same bodies, pressed together at rest."""

from dataclasses import replace

from mgehl.errors import ConfigError
from mgehl.kinds import loaded_checks
from mgehl.kinds.bodies import MOTION
from mgehl.kinds.choice import Choice, value_of, word_of
from mgehl.kinds.kind import Effort
from mgehl.kinds.line import LineKind
from mgehl.kinds.loaded import LoadedKind, p_h_words
from mgehl.kinds.point import PointKind
from mgehl.model.peaks import reach_of_peaks
from mgehl.model.room import end_beyond

EFFORT = Effort(35.0, 3e-8, 2e-3, 400.0, "dry contacts on 129 to 1025 nodes took 17 to 60")

ROOM = 1.5
"""End of a domain that is "auto", over the reach of the smooth contact."""

OF_A_FLUID = (
    "lubricant", "motion", "friction", "heat", *MOTION, "relaxation",
    "contact.boundary_film", "contact.ambient_pressure", "grid.load_beyond",
    "discretization.couette", "discretization.face_mobility", "discretization.unified_gap",
    "discretization.couette_at_interface", "discretization.cavitation", "discretization.film_threshold",
    "solver.method", "solver.start", "solver.linear_tolerance", "solver.sweeps", "solver.omega",
    "solver.first_nodes", "solver.inlet_cells", "solver.squeeze",
    "solver.idle_steps",
)  # fmt: skip
"""Sections and keys that only a fluid uses. A dry contact accepts them and does nothing with them."""

OF_MOES = ("lubricant", "motion")
"""Sections of a fluid that a dry contact uses all the same, to turn Moes numbers into a load."""


def fluid_choices(tables):
    """What a contact without a fluid, which may get one again, makes of the fluid's keys."""
    if word_of(tables, "discretization.contact_model") == "dry":
        needed = OF_MOES if value_of(tables, "moes.M") is not None else ()
        idle = tuple(name for name in OF_A_FLUID if name not in needed)
        yield Choice('where discretization.contact_model = "dry"', idle=idle)


class DryKind(LoadedKind):
    """What is different without a fluid; to be mixed into a kind of loaded contact."""

    about = "A dry contact."
    content = "Pressure and gap of a"

    def check_keys(self, config):
        """The relaxation is a method for a fluid."""
        if not config.solver.by_newton:
            raise ConfigError(
                'solver.method = "relaxation": means nothing where discretization.contact_model = "dry"'
            )
        super().check_keys(config)

    def contact(self, config):
        """The contact of the lubricated kind, at rest."""
        return replace(super().contact(config), speed=0.0)

    def domain(self, contact, _nodes):
        """The ends of a domain that holds the smooth contact and its peaks, and some room."""
        ends = (max(ROOM * contact.reach, end_beyond(peak)) for peak in reach_of_peaks(contact, 0.0))
        return [(-end, end) for end in ends]

    def check_fluid(self, grid, contact):
        """The smooth contact must lie in the domain."""
        loaded_checks.check_reach(grid, contact)

    def effort(self, config):
        """The `Effort` of a dry contact: the same on every grid."""
        return EFFORT

    def lines(self, config, contact, mesh):
        """What is solved, the contact of smooth bodies, the load."""
        hertz = contact.hertz
        return [
            "solved     the dry contact: bodies pressed together without a fluid; no speed, no lubricant",
            f"Hertz      {self.hertz_words(hertz)}   {p_h_words(hertz)}, of smooth half-spaces",
            f"load       {contact.load:.6g} {self.load_unit}",
            f"roughness  {1e9 * contact.roughness:.4g} nm rms within the semi-axes",
            f"cells      {1e6 * mesh.dX * contact.x_scale:.4g} um along x",
        ]

    def parts(self, solution, times="x"):
        """Load and nodes."""
        return ["dry", " ".join(self.load(solution.contact)), self.nodes(solution.mesh, times)]


class DryPoint(DryKind, PointKind):
    """A paraboloid on a flat without a fluid."""

    noun = "dry point contact"

    def contact(self, config):
        """The contact, without a direction of motion."""
        return replace(super().contact(config), angle=0.0)


class DryLine(DryKind, LineKind):
    """A cylinder on a flat without a fluid."""

    noun = "dry line contact"


DRY = {"point": DryPoint(), "line": DryLine()}
"""By contact.kind."""
