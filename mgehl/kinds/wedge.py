"""The rigid wedge bearing: a plane pad over a plate, with a pillar or a blocked exit in its film."""

from dataclasses import dataclass

from mgehl.config_value import key_field
from mgehl.discretization.mesh import Mesh
from mgehl.errors import ConfigError
from mgehl.kinds.choice import Choice, word_of
from mgehl.kinds.kind import Effort, Kind, kept_together
from mgehl.model.wedge import PILLARS, WedgeBearing

LARGEST_ASPECT = 100.0
"""Largest ratio of a pad's length and width."""

FEWEST_CELLS = 2
"""Cells that a pillar must have, and so must the distance from the exit to the line of no gap."""

EFFORT = Effort(
    1.0, 17e-6, 0.1, 900.0, "a wedge makes no convolutions", False
)  # fmt: skip


@dataclass(frozen=True)
class WedgeSection:
    exit: float = key_field(
        20e-3, "where the pad ends: distance from the line of no gap", "m", low=1e-6, high=10.0
    )
    inlet: float = key_field(
        50e-3, "where the pad begins: distance from the line of no gap", "m", low=1e-6, high=10.0
    )
    width: float = key_field(20e-3, "width of the pad", "m", low=1e-6, high=10.0)
    slope: float = key_field(1e-3, "slope m of the pad", "", low=1e-8, high=0.1)
    reversed: bool = key_field(
        False, "turned by 180 degrees: the plate moves with the differencing", kind=bool
    )
    blocked_exit: bool = key_field(False, "no flow at the exit", kind=bool)
    pillar: str = key_field("none", "rigid pillar between pad and plate", choices=PILLARS, kind=str)
    pillar_x: float = key_field(35e-3, "centre of the pillar along the motion", "m", low=0.0, high=10.0)
    pillar_y: float = key_field(0.0, "centre of the pillar across the motion", "m", low=-10.0, high=10.0)
    pillar_size: float = key_field(8e-3, "side or diameter of the pillar", "m", low=1e-6, high=10.0)


def pillar_words(pillar):
    """What stands in the film."""
    return "no pillar" if pillar == "none" else f"{pillar} pillar"


def exit_words(blocked):
    """What the exit is."""
    return "exit blocked" if blocked else "exit open"


def pillar_choice(tables):
    """The `Choice` of no pillar, whose place and size do nothing; None with one."""
    if word_of(tables, "wedge.pillar") != "none":
        return None
    idle = ("wedge.pillar_x", "wedge.pillar_y", "wedge.pillar_size")
    return Choice('where wedge.pillar = "none"', (), idle=idle)


class WedgeKind(Kind):
    """A pad whose gap is given: no load, no elasticity, constant viscosity and density."""

    name, noun, model = "wedge", "wedge bearing", WedgeBearing
    about = "A rigid wedge bearing, with a pillar or a blocked exit in its film."
    takes = (
        "wedge", "lubricant.viscosity", "motion.speed", "grid.nodes", "discretization.couette",
        "discretization.face_mobility", "discretization.couette_at_interface",
        "discretization.cavitation", "solver.tolerance", "solver.max_steps",
        "solver.squeeze",  # without effect, but every configuration.toml of a wedge has it
    )  # fmt: skip
    essential = {
        "contact.kind": "wedge", "wedge.exit": "20 mm", "wedge.inlet": "50 mm", "wedge.width": "20 mm",
        "wedge.slope": 1e-3, "wedge.pillar": "square",
        "wedge.pillar_x": "35 mm", "wedge.pillar_y": "0 mm", "wedge.pillar_size": "8 mm",
        "lubricant.viscosity": "0.096 Pa*s", "motion.speed": "1 m/s", "grid.nodes": 129,
    }  # fmt: skip
    short = {"wedge.blocked_exit": exit_words, "wedge.pillar": pillar_words}
    cavitates = False

    def check_keys(self, config):
        """The pad must have a length."""
        wedge = config.wedge
        if not wedge.exit < wedge.inlet:
            raise ConfigError(f"wedge.inlet = {wedge.inlet:g}: must be above wedge.exit = {wedge.exit:g}")

    def contact(self, config):
        """A `WedgeBearing`."""
        section = config.wedge
        return WedgeBearing(
            exit=section.exit,
            inlet=section.inlet,
            width=section.width,
            slope=section.slope,
            viscosity=config.lubricant.viscosity,
            speed=config.motion.speed,
            turned=section.reversed,
            blocked_exit=section.blocked_exit,
            pillar=section.pillar,
            pillar_x=section.pillar_x,
            pillar_y=section.pillar_y,
            pillar_size=section.pillar_size,
        )

    def mesh(self, config, contact):
        """A square of nodes over the pad and half a cell beyond its exit."""
        nodes = config.grid.nodes
        x, edges = contact.placement(nodes)
        half = 0.5 * contact.width / contact.y_scale
        return Mesh(nodes, nodes, x, (-half, half), edges=edges)

    def check(self, config, contact):
        """The pad must be a plate, its gap and its pillar larger than cells of the grid."""
        wedge, length = config.wedge, config.wedge.inlet - config.wedge.exit
        if not 1.0 / LARGEST_ASPECT <= wedge.width / length <= LARGEST_ASPECT:
            raise ConfigError(
                f"wedge.width = {wedge.width:g}: must be within a factor of {LARGEST_ASPECT:g} of the "
                f"pad's length of {length:g}"
            )
        dx, dy = _cell(contact, self.mesh(config, contact))
        if wedge.exit < FEWEST_CELLS * dx:
            raise ConfigError(
                f"wedge.exit = {wedge.exit:g}: must be at least {FEWEST_CELLS} cells from the line of no "
                f"gap, {FEWEST_CELLS * dx:.3g} with {config.grid.nodes} nodes"
            )
        if wedge.pillar != "none":
            _check_pillar(wedge, FEWEST_CELLS * max(dx, dy), config.grid.nodes)

    def effort(self, config):
        """One linear solve, or a few."""
        return EFFORT

    def lines(self, config, contact, mesh):
        """Gap, scales, cells and pillar."""
        section, (dx, dy) = config.wedge, _cell(contact, mesh)
        lines = [
            f"gap        {1e6 * section.slope * section.exit:.4g} um at the exit, "
            f"{1e6 * section.slope * section.inlet:.4g} um at the inlet",
            f"scales     P 1/mm is {1e-6 * contact.pressure_scale:.4g} MPa",
            f"cells      {1e3 * dx:.3g} mm by {1e3 * dy:.3g} mm, {section.exit / dx:.1f} from the exit to "
            "where the gap would end",
        ]
        if section.pillar != "none":
            across = f"{section.pillar_size / dx:.1f} by {section.pillar_size / dy:.1f} cells"
            lines.append(f"pillar     {section.pillar}, {across}")
        return lines

    def parts(self, solution):
        """What stands in the film, the exit, cavitation, the nodes."""
        torn = ["film cavitates"] if solution.result.cavitated_nodes else []
        stands, leaves = _pad(solution.contact)
        return [f"wedge with {stands}", leaves, *torn, self.nodes(solution.mesh)]

    def heading(self, solution):
        """What stands in the film, the exit, the nodes."""
        stands, leaves = _pad(solution.contact)
        nodes = kept_together(self.nodes(solution.mesh, times="×"))
        return ", ".join([f"Wedge bearing with {stands}", leaves, nodes])

    def position_labels(self, contact):
        """In mm."""
        return "X, mm", "Y, mm"

    def scalars(self, solution):
        """Load and pressure: there are no groups and no central film."""
        result = solution.result
        return {
            "speed": (solution.contact.speed, "m s-1", "entrainment speed"),
            "normal_load": (result.load_N, "N", "load that the pressure carries"),
            "maximum_pressure": (1e6 * result.max_pressure_MPa, "Pa", "largest pressure"),
        }


WEDGE = WedgeKind()


def _pad(bearing):
    """What stands in the film, and what the exit is."""
    return pillar_words(bearing.pillar), exit_words(bearing.blocked_exit)


def _cell(bearing, mesh):
    """Sides of a cell in m."""
    return mesh.dX * bearing.x_scale, mesh.dY * bearing.y_scale


def _check_pillar(wedge, smallest, nodes):
    """A pillar stands within the pad and is larger than a few cells."""
    half = 0.5 * wedge.pillar_size
    if wedge.pillar_size < smallest:
        raise ConfigError(
            f"wedge.pillar_size = {wedge.pillar_size:g}: must be at least {FEWEST_CELLS} cells, "
            f"{smallest:.3g} with {nodes} nodes"
        )
    if not (wedge.exit < wedge.pillar_x - half and wedge.pillar_x + half < wedge.inlet):
        raise ConfigError(
            f"wedge.pillar_x = {wedge.pillar_x:g}: the pillar of {wedge.pillar_size:g} m must stand "
            f"between the exit at {wedge.exit:g} and the inlet at {wedge.inlet:g}"
        )
    if not abs(wedge.pillar_y) + half < 0.5 * wedge.width:
        raise ConfigError(
            f"wedge.pillar_y = {wedge.pillar_y:g}: the pillar of {wedge.pillar_size:g} m must stand within "
            f"the width of {wedge.width:g}"
        )
