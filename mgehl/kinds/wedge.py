"""The rigid wedge bearing: a plane pad over a plate; a pillar, a pocket or a blocked exit in its film."""

from dataclasses import dataclass, replace

from mgehl.config_value import number, switch, word
from mgehl.discretization.mesh import Mesh
from mgehl.kinds.choice import Choice, given, value_of, word_of
from mgehl.kinds.kind import Effort, Kind, kept_together
from mgehl.kinds.loaded_checks import check_own_laws_up_to
from mgehl.kinds.lubricant import check_laws, lubricant_from
from mgehl.kinds.time import check_motion
from mgehl.kinds.wedge_checks import STEEPEST, cell_of, check_on_grid, check_pad
from mgehl.model.wedge import PILLARS, Pocket, WedgeBearing

FILMS = ("wedge.length", "wedge.inlet_film", "wedge.exit_film")
REPLACED = ("wedge.exit", "wedge.inlet", "wedge.slope", "wedge.reversed")
"""Keys that describe a pad by its films, and those that they stand for."""

PILLAR = ("wedge.pillar_x", "wedge.pillar_y", "wedge.pillar_size")
POCKET = ("wedge.pocket_from", "wedge.pocket_to", "wedge.pocket_width")
"""Where a pillar and a pocket are."""

LAWS = ("lubricant.viscosity_law", "lubricant.pressure_viscosity", "lubricant.density_law")
"""Keys that say what a pressure changes."""

MORE_THAN_ITS_OWN, LARGEST_CHECKED = 10.0, 1e9
"""Own laws are checked up to so many times 6 eta u L/h^2 above the ambient pressure, at most up to so many
Pa. By a constant viscosity no pad reaches that once; a viscosity that rises adds to it."""

EFFORT = Effort(1.0, 17e-6, 0.1, 900.0, "a wedge makes none, and takes the time of some", False)
TEARING = replace(EFFORT, node_seconds=1.2e-4)
"""The same where its film may tear: 2, 5 and 40 s on 129, 257 and 513 nodes a side."""


@dataclass(frozen=True)
class WedgeSection:
    # fmt: off
    exit: float = number(20e-3, "where the pad ends: distance from the line of no gap", "m", 1e-6, 10.0)
    inlet: float = number(50e-3, "where the pad begins: distance from the line of no gap", "m", 1e-6, 10.0)
    width: float = number(20e-3, "width of the pad", "m", 1e-6, 10.0)
    slope: float = number(1e-3, "slope m of the pad", "", 1e-8, STEEPEST)
    length: float | None = number(None, "length of a pad that is described by its films; x then goes from "
        "the inlet with the motion", "m", 1e-6, 10.0)
    inlet_film: float | None = number(None, "film where the pad begins, beside wedge.length", "m", 1e-9,
        0.1)
    exit_film: float | None = number(None, "film where it ends, smaller or larger", "m", 1e-9, 0.1)
    sides: str = word("open", "what is at the sides: the surroundings, or walls (one line of nodes where "
        "nothing varies across)", ("open", "closed"))
    ambient_pressure: float = number(0.0, "pressure around the pad, above that at which the film tears",
        "Pa", 0.0, 1e9)
    pressure_laws: bool = switch(False, "whether viscosity and density follow the pressure, by the laws of "
        "lubricant")
    reversed: bool = switch(False, "turned by 180 degrees: the plate moves with the differencing")
    blocked_exit: bool = switch(False, "no flow at the exit")
    pillar: str = word("none", "rigid pillar between pad and plate", PILLARS)
    pillar_x: float = number(35e-3, "centre of the pillar along the motion", "m", 0.0, 10.0)
    pillar_y: float = number(0.0, "centre of the pillar across the motion", "m", -10.0, 10.0)
    pillar_size: float = number(8e-3, "side or diameter of the pillar", "m", 1e-6, 10.0)
    pocket_depth: float = number(0.0, "depth of a rectangular pocket in the pad, its bottom along the pad "
        "(0: no pocket)", "m", 0.0, 0.1)
    pocket_from: float | None = number(None, "where the pocket begins along x", "m", 0.0, 10.0)
    pocket_to: float | None = number(None, "where it ends along x", "m", 0.0, 10.0)
    pocket_width: float | None = number(None, "its width, about the middle of the pad (unset: the pad's)",
        "m", 1e-6, 10.0)
    # fmt: on

    @property
    def by_films(self):
        """Whether the pad is described by its films."""
        return self.length is not None

    @property
    def ends(self):
        """The pad's first and last x."""
        return (0.0, self.length) if self.by_films else (self.exit, self.inlet)


def pillar_words(pillar):
    """What stands in the film."""
    return "no pillar" if pillar == "none" else f"{pillar} pillar"


def exit_words(blocked):
    """What the exit is."""
    return "exit blocked" if blocked else "exit open"


def pocket_words(depth):
    """What is cut into the pad."""
    return f"pocket {1e6 * depth:.4g} um deep" if depth else "no pocket"


def wedge_choices(tables):
    """Every `Choice` that keys of [wedge] make."""
    if word_of(tables, "wedge.pillar") == "none":
        yield Choice('where wedge.pillar = "none"', idle=PILLAR)
    if films := given(tables, FILMS):
        yield Choice(f"with {films[0]}", REPLACED, needs=FILMS)
    if word_of(tables, "contact.kind") == "wedge" and not value_of(tables, "wedge.pressure_laws"):
        yield Choice("without wedge.pressure_laws = true", LAWS)
    depth = value_of(tables, "wedge.pocket_depth")
    if depth:
        yield Choice("beside wedge.pocket_depth", needs=POCKET[:2])
    elif depth is not None:
        yield Choice("without wedge.pocket_depth", POCKET)


class WedgeKind(Kind):
    """A pad whose gap is given: no load, no elasticity; constant viscosity and density, or laws of them."""

    name, noun, is_loaded = "wedge", "wedge bearing", False
    about = "A rigid wedge bearing, with a pillar, a pocket or a blocked exit in its film."
    takes = (
        "wedge", "lubricant", "motion.speed", "grid.nodes", "discretization.couette",
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
    short = {
        "wedge.blocked_exit": exit_words, "wedge.pillar": pillar_words, "wedge.pocket_depth": pocket_words,
    }  # fmt: skip
    cavitates = False

    def check_keys(self, config):
        """The pad must have a length, its pocket must lie within it, laws must fit the viscosity."""
        if config.wedge.pressure_laws:
            check_laws(config)
        check_pad(config.wedge)
        check_motion(config)

    def contact(self, config):
        """A `WedgeBearing`: x of a pad that is described by its films goes with the motion."""
        section, pocket, slope, level = config.wedge, None, config.wedge.slope, 0.0
        side = -1.0 if section.by_films else 1.0
        first, last = sorted(side * end for end in section.ends)
        if section.by_films:
            level, slope = section.inlet_film, (section.inlet_film - section.exit_film) / section.length
        if section.pocket_depth:
            along = tuple(sorted(side * end for end in (section.pocket_from, section.pocket_to)))
            pocket = Pocket(section.pocket_depth, along, section.pocket_width or section.width)
        return WedgeBearing(
            exit=first, inlet=last, width=section.width, slope=slope, level=level,
            viscosity=config.lubricant.viscosity, speed=config.motion.speed,
            turned=section.reversed or section.by_films, blocked_exit=section.blocked_exit,
            pillar=section.pillar, pillar_x=side * section.pillar_x, pillar_y=side * section.pillar_y,
            pillar_size=section.pillar_size, pocket=pocket,
            ambient_pressure=section.ambient_pressure, closed_sides=section.sides == "closed",
            laws=lubricant_from(config) if section.pressure_laws else None,
        )  # fmt: skip

    def mesh(self, config, contact):
        """A square of nodes over the pad and half a cell beyond its exit; a line where all lines are alike.
        The outermost nodes lie on open sides, and half a cell from walls."""
        nodes = config.grid.nodes
        x, edges = contact.placement(nodes)
        if contact.is_line:
            return Mesh(nodes, 1, x, (0.0, 0.0), edges=edges)
        half = 0.5 * contact.width / contact.y_scale
        half *= (nodes - 1) / nodes if contact.closed_sides else 1.0
        return Mesh(nodes, nodes, x, (-half, half), edges=edges)

    def check(self, config, contact):
        """The pad must be a plate, its gap, its pillar and its pocket larger than cells of the grid."""
        check_on_grid(config.wedge, contact, self.mesh(config, contact), config.grid.nodes)
        if config.wedge.pressure_laws:
            check_own_laws_up_to(contact.lubricant, _largest_pressure(contact))

    def effort(self, config):
        """A linear solve or two on each grid; several where the film may tear."""
        return TEARING if config.discretization.cavitation else EFFORT

    def lines(self, config, contact, mesh):
        """Gap, scales, cells, pillar and pocket."""
        section, (dx, dy) = config.wedge, cell_of(contact, mesh)
        exit, inlet = (f"{1e6 * film:.4g} um" for film in contact.films)
        size = f"{1e3 * dx:.3g} mm" + ("" if mesh.is_line else f" by {1e3 * dy:.3g} mm")
        left = f", {section.exit / dx:.1f} from the exit to where the gap would end"
        yield f"gap        {exit} at the exit, {inlet} at the inlet"
        yield f"scales     P 1/mm is {1e-6 * contact.pressure_scale:.4g} MPa"
        yield f"cells      {size}{'' if section.by_films else left}"
        if section.pillar != "none":
            across = f"{section.pillar_size / dx:.1f} by {section.pillar_size / dy:.1f} cells"
            yield f"pillar     {section.pillar}, {across}"
        if contact.pocket:
            (first, last), across = contact.pocket.along, contact.pocket.width
            wide = "all across" if across >= contact.width else f"by {across / dy:.1f}"
            cells = f"{(last - first) / dx:.1f} cells {wide}"
            yield f"pocket     {1e6 * section.pocket_depth:.4g} um deep, {cells}"

    def parts(self, solution):
        """What is in the film, the exit, cavitation, the nodes."""
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


WEDGE = WedgeKind()


def _largest_pressure(bearing):
    """Up to which laws are checked, in Pa."""
    length, film = bearing.inlet - bearing.exit, min(bearing.films)
    own = 6.0 * bearing.viscosity * bearing.speed * length / film**2
    return min(LARGEST_CHECKED, bearing.ambient_pressure + MORE_THAN_ITS_OWN * own)


def _pad(bearing):
    """What is in the film, and what the exit is."""
    depth = bearing.pocket.depth if bearing.pocket else 0.0
    within = pocket_words(depth) if depth else pillar_words(bearing.pillar)
    return within, exit_words(bearing.blocked_exit)
