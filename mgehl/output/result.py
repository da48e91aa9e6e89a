"""The result of a run as one record: films, verdicts, work. Its fields are result.json's."""

from dataclasses import asdict, dataclass

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.model.contact import Groups
from mgehl.output.edge_result import NOT_SEEN, EdgeResult, edge_result
from mgehl.output.film_error import NOT_ASKED, FilmError
from mgehl.output.friction_result import FrictionResult
from mgehl.output.mixed_result import MixedResult, mixed_result
from mgehl.output.passages import TimeResult
from mgehl.output.resolution import Resolution, resolution
from mgehl.output.words import dry_words, loaded_words, undecided_words
from mgehl.solver.inequality import Power, check_interface, check_pressure_inequality, check_under_contact
from mgehl.solver.mass import CLOSED, Mass, mass_account
from mgehl.solver.verification import complementarity_error, flux_imbalance

COMPLEMENTARITY_TOLERANCE = 1e-6
"""Breach of P >= 0, H >= 0 and no inflow (units of P and H) that a converged answer may have,
however loose the tolerance of the residual."""


@dataclass(frozen=True)
class ContactResult:
    """The solid contact; node numbers count from 1, None without contact on that line."""

    nodes: int
    area_fraction: float
    load_fraction: float
    """Part of the load that the contact carries; the fluid carries the rest."""
    x_nodes: tuple | None
    y_nodes: tuple | None
    largest_gap_nm: float
    """Largest |H| of a contact node: what the zero-gap equation has left, or the boundary film's."""
    kept_gap_nm: float = 0.0
    """Gap that adsorbed layers keep between bodies in contact (contact.boundary_film)."""


@dataclass(frozen=True)
class Overlap:
    """Nodes outside of contact whose gap is negative: the unified equations leave some."""

    nodes: int
    largest_nm: float


@dataclass(frozen=True)
class InequalityResult:
    """Check of [Liu eq. 2]: interface nodes checked, number and size (p_h) of violations."""

    checked: int
    violations: int
    worst: float
    largest_ratio: float
    """Largest fluid pressure over the contact pressure beside it; only of nodes compared."""
    nodes: list
    compared: str = "at the nodes"
    """Where: "at the nodes" on both sides of the interface, "at the interface" between them, or at each
    node "under contact"."""
    power: Power = Power()
    """How many faces the check at the interface could decide."""


@dataclass(frozen=True)
class MoesFilm:
    """Central and minimum film as (h/R_x)(2U)^(-1/2)."""

    central: float
    minimum: float


@dataclass(frozen=True)
class Work:
    """Convolutions in equivalents of one on the finest grid; Newton steps or sweeps on all grids."""

    convolutions: float
    steps: int


@dataclass(frozen=True)
class HertzResult:
    """What Hertz' formulas say of smooth half-spaces under the same load."""

    max_pressure_GPa: float
    approach_um: float
    """Of a line contact with the constant of a deflection that counts -ln|x/a|, as the computed one."""


@dataclass(frozen=True)
class Result:
    """Everything result.json holds. What a contact has not, as a dry one has no film, is None here and left
    out there.
    """

    converged: bool
    """`settled`, the pressure inequality [Liu eq. 2] holds all along the interface within the error of the
    pressures there, and the contact lies within its domain, on enough nodes."""
    settled: bool
    """Sets, residual, load and complementarity hold: a solution of the discrete equations. Of a dry contact
    as `converged`: there is no inequality besides."""
    reason: str
    max_pressure_GPa: float
    load_error: float
    complementarity_error: float
    """Of a dry contact the largest |gap| in contact, overlap elsewhere (units of H), or pull (p_h)."""
    contact: ContactResult
    overlap: Overlap
    work: Work
    """Of a dry contact the steps are sets of pressed nodes."""
    wall_s: float
    ranks: int
    versions: dict
    error: FilmError = NOT_ASKED
    edge: EdgeResult = NOT_SEEN

    # With a fluid. (None, and no Optional: in result.json null is a number that is not finite.)
    central_film_nm: float = None
    minimum_film_nm: float = None
    residual: float = None
    flux_imbalance: float = None
    pressure_inequality: InequalityResult | None = None
    """Compared at the interface, as the paper states it: `converged` asks for this."""
    other_inequality: InequalityResult | None = None
    """Compared between nodes on both sides of it, a cell apart: `converged` does not ask for this."""
    contradictions: list | None = None
    """Nodes that can be neither film nor contact, of an iteration whose sets cycle."""
    cavitated_nodes: int = None
    resolution: Resolution | None = None
    groups: Groups | None = None
    moes_film: MoesFilm | None = None
    formulas: dict | None = None
    """Films that formulas predict, by name in nm: those made for such bodies, of oil with this density."""
    mixed: MixedResult | None = None
    """Film and contact of rough bodies; None of smooth ones."""
    mass: Mass | None = None
    """The account of the oil; None in older results."""
    friction: FrictionResult | None = None
    """None in older results."""
    thermal_reduction: float = None
    """Part of the film that the heat of shear in the inlet leaves, by Gupta's formula; None where the
    lubricant has no conductivity or no thermoviscosity."""
    is_thermally_reduced: bool = False
    """Whether the film has been solved with so much less viscosity."""

    time: TimeResult | None = None
    """Of a run in time; all else is of the state at its end."""

    # Without a fluid.
    approach_um: float = None
    """Of the bodies, from where their smooth shapes would touch."""
    boundary_nodes: int = None
    """Nodes in contact beside the domain's boundary: there must be none."""
    hertz: HertzResult | None = None
    Sq_nm: float = None
    """Rms of the heights within the Hertz semi-axes, about their mean; 0 of smooth bodies."""

    @property
    def doubt(self):
        """Of a state that settled and has not converged: what is wrong with it, in a few words."""
        if self.pressure_inequality.violations:
            return "Eq. 2 is broken"
        if self.mass and self.mass.made_share > CLOSED:
            return "oil is made"
        return self.edge.wrong[0] or "Eq. 2 is broken"

    def words(self, verbose=True):
        """The answer and whether it can be trusted: everything, or only what most want to know."""
        return dry_words(self) if self.hertz else loaded_words(self, verbose)

    def __str__(self):
        return self.words()


def summarise(problem, outcome, tolerance, work, wall_s, versions):
    """Verify the final state and put the `Result` together (collective).

    Gap, residual and load are evaluated anew from P, H0 and the partition; nothing that the
    iteration said of them is trusted.
    """
    grid, contact = problem.grid, problem.contact
    found = outcome.state
    state = outcome.state = problem.state(found.P, found.H0, found.status, found.p, found.filling)
    evaluation = problem.evaluate(state)
    residual = problem.rms(problem.residual(evaluation, state.status))
    load_error = problem.load_deficit(state.P)
    nm = 1e9 * contact.film_scale
    central, minimum = problem.films(state)
    asked = _eq_2(problem, state)
    other = _inequality_result(check_pressure_inequality(problem, state), "at the nodes")
    complementarity = complementarity_error(problem, state, evaluation)
    settled, reason = _verdict(outcome, tolerance, residual, load_error, complementarity)
    overlap, edge = overlap_of(grid, state, nm), edge_result(problem, state, nm)
    mass = mass_account(problem, state, evaluation)
    conserves = _conserves(problem, mass, tolerance)
    if settled:
        made = None if conserves else mass
        reason = _whether_more_holds(asked, made, edge, overlap) or reason
    moes = contact.film_scale * contact.moes_scale
    return Result(
        converged=settled and asked.violations == 0 and conserves and not edge.wrong[0],
        settled=settled,
        reason=reason,
        central_film_nm=central * nm,
        minimum_film_nm=minimum * nm,
        max_pressure_GPa=1e-9 * contact.hertz.p_h * grid.max(state.P),
        residual=residual,
        load_error=load_error,
        complementarity_error=complementarity,
        flux_imbalance=flux_imbalance(problem, evaluation),
        contact=contact_result(problem, state, nm),
        overlap=overlap,
        pressure_inequality=asked,
        other_inequality=other,
        contradictions=[_contradiction(each, nm) for each in outcome.contradictions],
        cavitated_nodes=problem.counts(state.status)[1],
        resolution=resolution(contact, grid.mesh),
        groups=contact.groups,
        moes_film=MoesFilm(central * moes, minimum * moes),
        formulas={f"{name}_nm": 1e9 * film for name, film in contact.compared.items()},
        work=work,
        wall_s=wall_s,
        ranks=grid.comm.size,
        versions=versions,
        edge=edge,
        mixed=mixed_result(problem, state),
        mass=mass,
        thermal_reduction=contact.thermal_reduction,
        is_thermally_reduced=contact.lubricant.thinned < 1.0,
    )


def _conserves(problem, mass, tolerance):
    """Whether no oil is made.

    The unified equations know no contents and do not say. Where contact closes its faces hardly anything
    may flow through; there what a residual of the `tolerance` makes is nothing.
    """
    law, mesh, contact = problem.scheme.contact_law, problem.grid.mesh, problem.contact
    if mass.made_share <= CLOSED or not law.has_contact:
        return True
    area = (mesh.x[1] - mesh.x[0]) * (1.0 if mesh.is_line else mesh.y[1] - mesh.y[0])
    unit = contact.speed * contact.film_scale * (1.0 if mesh.is_line else contact.y_scale)
    return law.closes_faces and mass.made <= tolerance * unit * area


def _eq_2(problem, state):
    """What the verdict asks of Eq. 2: p <= P under contact where the fluid has a pressure there."""
    if problem.scheme.contact_law.closes_faces:
        return _inequality_result(check_interface(problem, state), "at the interface")
    return _inequality_result(check_under_contact(problem, state), "under contact")


def _verdict(outcome, tolerance, residual, load_error, complementarity):
    """Settled only if residual, load, sets and complementarity all hold; and why."""
    if not outcome.converged:
        return False, outcome.reason
    if not residual <= tolerance:
        return False, f"the residual of the final state is {residual:.1e}, above {tolerance:.1e}"
    if not abs(load_error) <= tolerance:
        return False, f"the load is off by {load_error:.1e}, more than {tolerance:.1e}"
    if not complementarity <= COMPLEMENTARITY_TOLERANCE:
        return False, f"complementarity is broken by {complementarity:.1e}"
    return True, "residual, load, sets, complementarity and the pressure inequality hold"


def _whether_more_holds(inequality, made, edge, overlap):
    """What a settled state breaks or leaves open all the same, in words; empty where all holds."""
    if inequality.violations:
        return (
            f"contact pressure is below the fluid pressure beside it at {inequality.violations} of "
            f"{inequality.checked} interface nodes, by up to {inequality.worst:.1e} p_h"
        )
    if edge.wrong[1]:
        return edge.wrong[1]
    if made:
        return f"a node, or nodes of one kind, make {made.made_share:.1e} of the oil that flows through"
    if overlap.nodes:
        return (
            f"the unified equations hold, but the bodies overlap at {overlap.nodes} nodes "
            f"by up to {overlap.largest_nm:.3g} nm"
        )
    if not inequality.power.decides:
        return (
            "residual, load, sets and complementarity hold; the pressure inequality is "
            f"{undecided_words(inequality.power)}"
        )
    return ""


def _contradiction(node, nm):
    """What result.json says of a node that can be neither."""
    return {
        "i": node.i,
        "j": node.j,
        "film_gap_nm": nm * node.gap,
        "contact_pressure": node.pressure,
        "neighbours": list(node.neighbours),
    }


def contact_result(problem, state, nm):
    """The `ContactResult` of a state; `nm` is nanometres in a unit of H (collective)."""
    grid, contact_area = problem.grid, problem.contact.contact_area
    contact = state.status == CONTACT
    carried = problem.share_of_load(state.P, contact)
    largest_gap = nm * grid.max(np.abs(state.H[contact]), initial=0.0)
    cell = grid.mesh.dX * grid.mesh.dY
    nodes = grid.count(contact)
    i, j = grid.mesh.nearest(0.0, 0.0)
    along_x = contact[j - grid.first] if grid.first <= j < grid.last else np.zeros(grid.mesh.nx, bool)
    x_nodes = np.flatnonzero(np.logical_or.reduce(grid.comm.allgather(along_x))) + 1
    y_nodes = np.flatnonzero(np.concatenate(grid.comm.allgather(contact[:, i]))) + 1
    across = None if grid.mesh.is_line else _ends(y_nodes)
    ends = _ends(x_nodes), across
    kept = nm * problem.scheme.contact_law.contact_gap
    return ContactResult(nodes, nodes * cell / contact_area, carried, *ends, largest_gap, kept)


def _inequality_result(inequality, compared):
    nodes = [asdict(violation) for violation in inequality.violations]
    found = inequality.checked, len(nodes), inequality.worst, inequality.largest_ratio
    return InequalityResult(*found, nodes, compared, inequality.power)


def overlap_of(grid, state, nm):
    """The `Overlap` of a state, as `contact_result` (collective)."""
    below = np.where(state.status == CONTACT, 0.0, -state.H)
    return Overlap(grid.count(below > 0.0), nm * grid.max(below, initial=0.0))


def _ends(nodes):
    return (int(nodes[0]), int(nodes[-1])) if len(nodes) else None
