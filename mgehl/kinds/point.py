"""The loaded point contact: a ball or an ellipsoid on a flat."""

from dataclasses import asdict, dataclass

from mgehl.config_value import number
from mgehl.discretization.fluid import FOLDING
from mgehl.discretization.mesh import Mesh
from mgehl.errors import ConfigError
from mgehl.kinds.bodies import MOTION
from mgehl.kinds.choice import Choice, given, word_of
from mgehl.kinds.kind import Effort
from mgehl.kinds.loaded import LoadedKind
from mgehl.kinds.time import range_of, reference
from mgehl.model.coating import Coating
from mgehl.model.own_function import OwnFunction, is_own
from mgehl.model.own_laws import OwnCompliance
from mgehl.model.point import PointContact

LARGEST_RADIUS_RATIO = 1e3
"""Largest ratio of the two radii: a longer ellipse is a line contact."""

MOES = "moes.M", "moes.L"
MOES_REPLACES = "contact.load", "motion.speed", "motion.ring_rotation", *MOTION
"""Moes numbers, and the keys that they stand for."""

FILM = Effort(45.0, 2.6e-7, 0.013, 1300.0, "full films on 65 to 2049 nodes took 22 to 106")
CONTACT = Effort(25.0, 4e-7, 0.01, 1800.0, "full contact on 257 to 1025 nodes took 18 to 31")
MEAN = Effort(500.0, 2e-7, 0.01, 1300.0, "folding means of the mobility took 348 and 761 on 129 nodes")


@dataclass(frozen=True)
class CoatingSection:
    # fmt: off
    thickness: float | None = number(None, "thickness of the layer on one body, where contact.deformation "
        "= coated", "m", 1e-9, 1.0)
    modulus: float | None = number(None, "Young's modulus of the layer", "Pa", 1e6, 1e13)
    poisson: float = number(0.3, "Poisson's ratio of the layer", low=0.0, high=0.5)
    substrate_modulus: float | None = number(None, "Young's modulus beneath it (unset: half of the "
        "compliance 2/E' is that body's)", "Pa", 1e6, 1e13)
    substrate_poisson: float = number(0.3, "Poisson's ratio beneath it", low=0.0, high=0.5)
    # fmt: on


@dataclass(frozen=True)
class MoesSection:
    M: float | None = number(None, "Moes load number, instead of load and speed", "", 0.01, 1e7)
    L: float | None = number(None, "Moes material number, instead of load and speed", "", 0.1, 100.0)


def point_choices(tables):
    """A coating belongs to coated bodies; Moes numbers come as a pair and stand for load and speed."""
    if deformation := word_of(tables, "contact.deformation"):
        is_coated, said = deformation == "coated", f'where contact.deformation = "{deformation}"'
        needs = ("coating.thickness", "coating.modulus") if is_coated else ()
        yield Choice(said, () if is_coated else ("coating",), needs=needs)
    if found := given(tables, MOES):
        yield Choice(f"with {found[0]}", MOES_REPLACES, needs=MOES)


class PointKind(LoadedKind):
    """A paraboloid on a flat, pressed by a force."""

    name, noun = "point", "point contact"
    about = "A lubricated point contact: a ball or an ellipsoid on a flat."
    load_key, load_unit = "contact.load", "N"
    takes = (
        "contact.load", "contact.radius_x", "contact.radius_y", "contact.reduced_modulus",
        "contact.deformation", "contact.boundary_film", "contact.ambient_pressure",
        "contact.surface", "contact.surface_body",
        "body_1", "body_2",
        "surface", "second_surface",
        "coating", "lubricant", "motion", "time", "friction", "heat", "moes",
        "grid", "discretization", "solver", "relaxation",
    )  # fmt: skip
    essential = {
        "contact.kind": "point", "contact.load": "800 N",
        "contact.radius_x": "12.7 mm", "contact.radius_y": "12.7 mm",
        "contact.reduced_modulus": "219.78 GPa",
        "lubricant.viscosity": "0.096 Pa*s", "lubricant.pressure_viscosity": "18.2 1/GPa",
        "motion.speed": "0.5 m/s", "grid.nodes": 129, "solver.start": "film",
    }  # fmt: skip
    short = {"contact.load": lambda load: f"{load:.4g} N", "motion.angle": lambda angle: f"at {angle:g}°"}

    def check_keys(self, config):
        """A coating must leave a substrate that is possible; otherwise as any loaded contact."""
        try:
            _deformation_from(config)
        except ValueError as error:
            modulus = config.coating.substrate_modulus
            raise ConfigError(f"coating.substrate_modulus = {modulus!r}: {error}") from None
        super().check_keys(config)

    def pressed(self, config, shared):
        """A `PointContact`, by load and speed or by Moes numbers."""
        moes = config.moes
        shared |= {"radius_y": config.contact.radius_y, "deformation": _deformation_from(config)}
        shared |= {"angle": reference(config, "motion.angle"), "load_beyond": config.grid.load_beyond}
        if moes.M is not None:
            return PointContact.from_moes(moes.M, moes.L, **shared)
        load, speed = reference(config, self.load_key), reference(config, "motion.speed")
        return PointContact(load=load, speed=speed, **shared)

    def mesh(self, config, contact):
        """A square of nodes over the ellipse."""
        grid = self.with_domain(config, contact).grid
        return Mesh(grid.nodes, grid.nodes, grid.x, grid.y, contact.k_e)

    def check(self, config, contact):
        """As for any loaded contact; besides, the radii must not be too different."""
        radii = config.contact.radius_x, config.contact.radius_y
        if max(radii) > LARGEST_RADIUS_RATIO * min(radii):
            raise ConfigError(
                f"contact.radius_y = {radii[1]:g}: must be within a factor of {LARGEST_RADIUS_RATIO:g} of "
                f"contact.radius_x = {radii[0]:g}"
            )
        super().check(config, contact)

    def size(self, config, contact):
        """The size of the ellipse, as wide as a soft layer makes it."""
        section, hertz, wide = config.contact, contact.hertz, contact.widening
        key = "moes.M" if config.moes.M is not None else self.load_key
        size = f"{wide * hertz.a:.2g} m by {wide * hertz.b:.2g} m"
        radii = f"{section.radius_x:g} m and {section.radius_y:g} m"
        return key, size, radii, wide * max(hertz.a / section.radius_x, hertz.b / section.radius_y)

    def newton_effort(self, config):
        """By the start and the mean of the mobility."""
        if not config.solver.from_film:
            return CONTACT
        return MEAN if config.discretization.face_mobility in FOLDING else FILM

    def parts(self, solution, times="x"):
        """With the direction of the motion, where that is not x."""
        speed, *others = super().parts(solution, times)
        return [speed + angle_words(solution.config), *others]

    def lines(self, config, contact, mesh):
        """With the direction of the motion."""
        *others, last = super().lines(config, contact, mesh)
        return [*others, last + angle_words(config)]

    def load(self, contact):
        """In N."""
        return f"{contact.load:.4g}", "N"

    def hertz_words(self, hertz):
        """Both semi-axes."""
        return f"{super().hertz_words(hertz)}   b {1e3 * hertz.b:.4g} mm"


POINT = PointKind()


def angle_words(config):
    """The direction after a speed, in time the farthest ones; nothing where it is that of x."""
    least, most = range_of(config, "motion.angle")
    angles = dict.fromkeys([least, most] if reference(config, "motion.angle") < most else [most, least])
    return f" at {' to '.join(f'{angle:g}°' for angle in angles)}" if any(angles) else ""


def _deformation_from(config):
    """What the bodies are in depth; None for half-spaces."""
    if config.contact.deformation == "coated":
        return Coating(**asdict(config.coating), reduced_modulus=config.contact.reduced_modulus)
    name = config.contact.deformation
    return OwnCompliance(OwnFunction(name)) if is_own(name) else None
