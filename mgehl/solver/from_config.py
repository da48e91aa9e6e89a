"""From a configuration to the objects of a solve."""

from dataclasses import asdict, dataclass, fields, replace

from mgehl.config import COARSEST_NODES
from mgehl.discretization.contact_law import UnifiedEquations
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.grid.hierarchy import Hierarchy
from mgehl.model.contact import LoadedContact
from mgehl.model.frame import Frame
from mgehl.model.wedge import WedgeBearing
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.recipe import (
    A_STATE,
    couette_scheme_of,
    interface_law,
    recipe_of,
    recipe_on,
    share_of_the_flow,
)
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.settings import NewtonSettings, SolverSettings, TimeSettings


@dataclass(frozen=True)
class SetUp:
    """All that a configuration says of a solve, in the axes in which it is solved."""

    contact: LoadedContact | WedgeBearing
    mesh: Mesh
    settings: SolverSettings
    frame: Frame
    """Those axes, beside the user's."""

    def recipe(self, start=None, begins=None):
        """The `Recipe` of a loaded contact with a fluid, maybe from a `start`. It `begins` in the way that
        led to the answer, where that is another."""
        near = start and recipe_of(self.settings, self.contact, A_STATE)
        recipe = near or recipe_on(self.mesh, self.settings, self.contact)
        return replace(recipe, begins=begins or recipe.begins)

    def hierarchy(self, comm):
        """The grids of a loaded contact on `comm` (collective); the caller destroys them."""
        return Hierarchy(self.mesh, COARSEST_NODES, self.contact.kernel, comm)


def set_up(case):
    """The `SetUp` of a `mgehl.kinds.Case`."""
    frame = case.contact.frame
    contact = case.contact.in_frame(frame)
    return SetUp(contact, case.mesh.in_frame(frame), settings_from(case.config, contact), frame)


def scheme_from(config, contact):
    """How the Reynolds equation is differenced; of a dry contact, which has none, nothing is said."""
    if config.is_dry:
        return Scheme()
    section = config.discretization
    cavitation = config.kind.cavitates if section.cavitation is None else section.cavitation
    return Scheme(
        couette=section.couette or couette_scheme_of(contact),
        face_mobility=section.face_mobility,
        couette_at_interface=section.couette_at_interface,
        motion=contact.motion,
        contact_law=CONTACT_LAWS[section.contact_model](config, contact),
        cavitation=cavitation,
    )


def _interface_conditions(config, contact):
    section = config.discretization
    layers, threshold, mean = config.contact.boundary_film, section.film_threshold, section.face_mobility
    return interface_law(contact, layers, threshold, mean, config.is_in_time)


def _unified_equations(config, contact):
    return UnifiedEquations(config.discretization.unified_gap / contact.film_scale)


CONTACT_LAWS = {"lcic": _interface_conditions, "unified": _unified_equations}
"""By discretization.contact_model."""


def settings_from(config, contact):
    """Everything the solver is told."""
    solver, scheme = config.solver, scheme_from(config, contact)
    tolerance = share_of_the_flow(contact, scheme) * solver.tolerance
    time = TimeSettings(config.time.step, config.time.tolerance, solver.tolerance)
    return SolverSettings(
        **_keys_of(SolverSettings, solver),
        scheme=scheme,
        newton=NewtonSettings(**_keys_of(NewtonSettings, solver) | {"tolerance": tolerance}),
        cycle=CycleSettings(**_keys_of(CycleSettings, solver)),
        relaxation=RelaxationSettings(**asdict(config.relaxation), tolerance=solver.tolerance),
        time=time if config.is_in_time else None,
    )


def _keys_of(settings, section):
    """Those fields of a class of settings that a section has, too, with its values."""
    names = (each.name for each in fields(settings) if hasattr(section, each.name))
    return {name: getattr(section, name) for name in names}
