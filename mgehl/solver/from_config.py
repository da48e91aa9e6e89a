"""From a configuration to the objects of a run."""

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Scheme
from mgehl.model.contact import PointContact
from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS, Lubricant
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.nested import NestedSettings, SolverSettings
from mgehl.solver.newton import NewtonSettings

OPTIONS_PREFIX = "mgehl_"
"""Prefix under which PETSc options reach the solvers of a run."""


def contact_from(config):
    """The contact that a `Config` describes."""
    section, moes = config.contact, config.moes
    viscosity = VISCOSITY_LAWS[config.lubricant.viscosity_law]
    lubricant = Lubricant(
        viscosity(config.lubricant.viscosity, config.lubricant.pressure_viscosity),
        DENSITY_LAWS[config.lubricant.density_law](),
    )
    body = (section.radius_x, section.radius_y, section.reduced_modulus)
    if moes.M is not None:
        return PointContact.from_moes(moes.M, moes.L, *body, lubricant)
    return PointContact(section.load, *body, config.motion.speed, lubricant)


def mesh_from(config, contact):
    """The finest mesh."""
    grid = config.grid
    return Mesh(grid.nodes, grid.nodes, grid.x, grid.y, contact.k_e)


def settings_from(config, contact):
    """Everything the solver is told."""
    solver, discretization = config.solver, config.discretization
    return SolverSettings(
        scheme=Scheme(discretization.couette),
        nested=NestedSettings(
            start=solver.start, first_nodes=solver.first_nodes, inlet_cells=solver.inlet_cells
        ),
        newton=NewtonSettings(
            tolerance=solver.tolerance,
            max_steps=solver.max_steps,
            linear_tolerance=solver.linear_tolerance,
            film_threshold=discretization.film_threshold / contact.film_scale,
            release_budget=solver.release_budget,
        ),
        cycle=CycleSettings(sweeps=solver.sweeps, omega=solver.omega, options_prefix=OPTIONS_PREFIX),
    )
