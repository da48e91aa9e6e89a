"""The loaded line contact: a cylinder on a flat, per length."""

from mgehl.discretization.mesh import Mesh
from mgehl.kinds.bodies import OF_A_LINE
from mgehl.kinds.kind import Effort
from mgehl.kinds.loaded import LoadedKind
from mgehl.kinds.time import reference
from mgehl.model.line import LineContact

EFFORT = Effort(70.0, 3e-7, 5e-3, 2500.0, "line contacts on 1025 to 16385 nodes took 20 to 180")


class LineKind(LoadedKind):
    """A cylinder on a flat, pressed by a force per length."""

    name, noun = "line", "line contact"
    about = "A lubricated line contact: a cylinder on a flat, per length."
    load_key, load_unit = "contact.load_per_length", "N/m"
    takes = (
        "contact.load_per_length", "contact.radius_x", "contact.reduced_modulus", "contact.boundary_film",
        "contact.ambient_pressure", "contact.surface", "contact.surface_body",
        "surface", "second_surface", *OF_A_LINE,
        "lubricant", "motion.speed", "motion.slide_to_roll", "motion.ring_rotation", "time",
        "friction", "heat",
        "grid.nodes", "grid.x", "discretization", "solver", "relaxation",
    )  # fmt: skip
    essential = {
        "contact.kind": "line", "contact.load_per_length": "1859 N/mm",
        "contact.radius_x": "12.7 mm", "contact.reduced_modulus": "219.78 GPa",
        "lubricant.viscosity": "0.096 Pa*s", "lubricant.pressure_viscosity": "18.2 1/GPa",
        "motion.speed": "100 mm/s", "grid.nodes": 1025, "solver.start": "film",
    }  # fmt: skip
    short = {"contact.load_per_length": lambda load: f"{1e-3 * load:.4g} N/mm"}

    def pressed(self, config, shared):
        """A `LineContact`."""
        load, speed = reference(config, self.load_key), reference(config, "motion.speed")
        return LineContact(load=load, speed=speed, **shared)

    def mesh(self, config, contact):
        """A single line of nodes."""
        grid = self.with_domain(config, contact).grid
        return Mesh(grid.nodes, 1, grid.x, (0.0, 0.0))

    def size(self, config, contact):
        """The half-width."""
        a, radius = contact.hertz.a, config.contact.radius_x
        return self.load_key, f"{a:.2g} m", f"{radius:g} m", a / radius

    def newton_effort(self, config):
        """The same from every start."""
        return EFFORT

    def load(self, contact):
        """In N/mm."""
        return f"{1e-3 * contact.load:.4g}", "N/mm"


LINE = LineKind()
