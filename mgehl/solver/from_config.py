"""From a configuration to the objects of a solve."""

from dataclasses import asdict, dataclass

from mgehl.config import COARSEST_NODES
from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.grid.hierarchy import Hierarchy
from mgehl.model.contact import LoadedContact
from mgehl.model.frame import Frame
from mgehl.model.wedge import WedgeBearing
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.settings import NestedSettings, NewtonSettings, SolverSettings


@dataclass(frozen=True)
class SetUp:
    """All that a configuration says of a solve, in the axes in which it is solved."""

    contact: LoadedContact | WedgeBearing
    mesh: Mesh
    settings: SolverSettings
    frame: Frame
    """Those axes, beside the user's."""

    def hierarchy(self, comm):
        """The grids of a loaded contact on `comm` (collective); the caller destroys them."""
        return Hierarchy(self.mesh, COARSEST_NODES, self.contact.kernel, comm)


def set_up(case):
    """The `SetUp` of a `mgehl.kinds.Case`."""
    frame = case.contact.frame
    contact = case.contact.in_frame(frame)
    return SetUp(contact, case.mesh.in_frame(frame), settings_from(case.config, contact), frame)


OF_SMOOTH, OF_ROUGH = "3B", "3L"
"""The Couette flow's schemes of smooth and of rough bodies where the configuration names none. Behind a
peak the film falls to nothing from one node to the next; without limits it might be less than none. By 1B
it stays a film, too, but on a usual grid one that is 6 to 15 % too thick, and of a
short wave twice as thick (`tests/solver/test_rough.py`)."""


def scheme_from(config, contact):
    """How the Reynolds equation is differenced; of a dry contact, which has none, nothing is said."""
    if config.is_dry:
        return Scheme()
    section = config.discretization
    cavitation = config.kind.cavitates if section.cavitation is None else section.cavitation
    return Scheme(
        couette=section.couette or (OF_ROUGH if contact.roughness > 0.0 else OF_SMOOTH),
        face_mobility=section.face_mobility,
        couette_at_interface=section.couette_at_interface,
        motion=contact.motion,
        contact_law=CONTACT_LAWS[section.contact_model](config, contact),
        cavitation=cavitation,
    )


def _interface_conditions(config, contact):
    """Faces that contact closes; where it closes continuously, those that a vanishing mobility closes.

    It closes continuously where bodies have layers or may touch on the way to a film, as rough and soft
    ones do. Faces that were shut would keep that contact (a smooth ellipse of polymer at 0.1 m/s on 257
    nodes: 2600 nodes, and no end; so it has a film after 117 convolutions).
    """
    section, boundary_film = config.discretization, config.contact.boundary_film
    may_touch = contact.roughness > 0.0 or _has_soft_film(config, contact)
    if boundary_film > 0.0 or may_touch or config.is_in_time:
        return BoundaryFilm(max(boundary_film, section.film_threshold) / contact.film_scale)
    return InterfaceConditions(section.film_threshold / contact.film_scale)


def _has_soft_film(config, contact):
    """Whether a solve leads to a film of soft bodies: nearly at rest all count as soft, and touch."""
    if not contact.is_soft or config.solver.start != "film":
        return False
    return contact.expected_film > config.discretization.film_threshold


def _unified_equations(config, contact):
    return UnifiedEquations(config.discretization.unified_gap / contact.film_scale)


CONTACT_LAWS = {"lcic": _interface_conditions, "unified": _unified_equations}
"""By discretization.contact_model."""


LEAST_SHARE = 1e-2
"""Least part of the tolerance that a thin film asks for: less comes near to rounding."""


def _share_of_the_flow(contact, scheme):
    """What flows through thin films over the flow in which residuals count: so much smaller must they be
    where the balance of every node decides what is film and what is contact."""
    if not contact.is_loaded or scheme.contact_law.closes_faces:
        return 1.0
    return min(max(contact.expected_film / contact.film_scale, LEAST_SHARE), 1.0)


def settings_from(config, contact):
    """Everything the solver is told."""
    solver, relaxation, scheme = config.solver, config.relaxation, scheme_from(config, contact)
    return SolverSettings(
        method=solver.method,
        scheme=scheme,
        nested=NestedSettings(solver.start, solver.first_nodes, solver.inlet_cells),
        newton=NewtonSettings(
            tolerance=_share_of_the_flow(contact, scheme) * solver.tolerance,
            max_steps=solver.max_steps,
            idle_steps=solver.idle_steps,
            max_work=solver.max_work,
            linear_tolerance=solver.linear_tolerance,
            release_budget=solver.release_budget,
            squeeze=solver.squeeze,
        ),
        cycle=CycleSettings(sweeps=solver.sweeps, omega=solver.omega, couette=solver.cycle_couette),
        relaxation=RelaxationSettings(**asdict(relaxation), tolerance=solver.tolerance),
        error=solver.error,
    )
