"""From a configuration to the objects of a run."""

from dataclasses import asdict

from mgehl.discretization.contact_law import InterfaceConditions, UnifiedEquations
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.model.coating import Coating
from mgehl.model.line import LineContact
from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS, Lubricant
from mgehl.model.own_function import OwnFunction, is_own
from mgehl.model.own_laws import OwnCompliance, OwnDensity, OwnSurface, OwnViscosity
from mgehl.model.point import PointContact
from mgehl.model.wedge import WedgeBearing
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.settings import NestedSettings, NewtonSettings, SolverSettings

OPTIONS_PREFIX = "mgehl_"
"""Prefix under which PETSc options reach the solvers of a run."""


def contact_from(config):
    """The contact that a `Config` describes: a point, a line or a wedge."""
    return {"point": _point_from, "line": _line_from, "wedge": _wedge_from}[config.contact.kind](config)


def _lubricant_from(config):
    section = config.lubricant
    ambient = section.viscosity, section.pressure_viscosity
    if is_own(section.viscosity_law):
        viscosity = OwnViscosity(*ambient, OwnFunction("lubricant.viscosity_law", section.viscosity_law))
    else:
        viscosity = VISCOSITY_LAWS[section.viscosity_law](*ambient)
    if is_own(section.density_law):
        density = OwnDensity(OwnFunction("lubricant.density_law", section.density_law))
    else:
        density = DENSITY_LAWS[section.density_law]()
    return Lubricant(viscosity, density)


def _surface_from(config):
    name = config.contact.surface
    return OwnSurface(OwnFunction("contact.surface", name)) if name else None


def _deformation_from(config):
    """What the bodies are in depth; None for half-spaces."""
    section = config.contact
    if section.deformation == "coated":
        return Coating(**asdict(config.coating), reduced_modulus=section.reduced_modulus)
    if is_own(section.deformation):
        return OwnCompliance(OwnFunction("contact.deformation", section.deformation))
    return None


def _point_from(config):
    section, moes = config.contact, config.moes
    body = (section.radius_x, section.radius_y, section.reduced_modulus)
    lubricant = _lubricant_from(config)
    more = {"surface": _surface_from(config), "deformation": _deformation_from(config)}
    if moes.M is not None:
        return PointContact.from_moes(moes.M, moes.L, *body, lubricant, **more)
    return PointContact(section.load, *body, config.motion.speed, lubricant, **more)


def _line_from(config):
    section, lubricant = config.contact, _lubricant_from(config)
    body = (section.radius_x, section.reduced_modulus)
    speed, surface = config.motion.speed, _surface_from(config)
    return LineContact(section.load_per_length, *body, speed, lubricant, surface)


def _wedge_from(config):
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


def mesh_from(config, contact):
    """The finest mesh."""
    grid, kind = config.grid, config.contact.kind
    if kind == "line":
        return Mesh(grid.nodes, 1, grid.x, (0.0, 0.0))
    if kind == "wedge":
        x, edges = contact.placement(grid.nodes)
        half = 0.5 * contact.width / contact.y_scale
        return Mesh(grid.nodes, grid.nodes, x, (-half, half), edges=edges)
    return Mesh(grid.nodes, grid.nodes, grid.x, grid.y, contact.k_e)


def scheme_from(config, contact):
    """How the Reynolds equation is differenced."""
    section = config.discretization
    cavitation = section.cavitation
    if cavitation is None:
        cavitation = config.contact.kind != "wedge"
    return Scheme(
        couette=section.couette,
        face_mobility=section.face_mobility,
        couette_at_interface=section.couette_at_interface,
        motion=contact.motion,
        contact_law=CONTACT_LAWS[section.contact_model](section, contact),
        cavitation=cavitation,
    )


CONTACT_LAWS = {
    "lcic": lambda section, contact: InterfaceConditions(section.film_threshold / contact.film_scale),
    "unified": lambda section, contact: UnifiedEquations(section.unified_gap / contact.film_scale),
}
"""By discretization.contact_model."""


def settings_from(config, contact):
    """Everything the solver is told."""
    solver, relaxation = config.solver, config.relaxation
    return SolverSettings(
        method=solver.method,
        scheme=scheme_from(config, contact),
        nested=NestedSettings(
            start=solver.start, first_nodes=solver.first_nodes, inlet_cells=solver.inlet_cells
        ),
        newton=NewtonSettings(
            tolerance=solver.tolerance,
            max_steps=solver.max_steps,
            linear_tolerance=solver.linear_tolerance,
            release_budget=solver.release_budget,
            squeeze=solver.squeeze,
        ),
        cycle=CycleSettings(
            sweeps=solver.sweeps,
            omega=solver.omega,
            couette=solver.cycle_couette,
            options_prefix=OPTIONS_PREFIX,
        ),
        relaxation=RelaxationSettings(**asdict(relaxation), tolerance=solver.tolerance),
    )
