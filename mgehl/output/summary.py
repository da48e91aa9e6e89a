"""The `Result` of a lubricated contact: verified anew, nothing that an iteration said of it is trusted."""

from dataclasses import replace

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.discretization.storage import content
from mgehl.output.film_error import OF_AN_INSTANT
from mgehl.output.mixed_result import mixed_result
from mgehl.output.resolution import resolution
from mgehl.output.result import ContactResult, MoesFilm, Overlap, Result
from mgehl.output.series import time_result
from mgehl.output.words import undecided_words
from mgehl.solver.gaps import loads
from mgehl.solver.inequality import check_interface, check_pressure_inequality, check_under_contact
from mgehl.solver.judge import allowed
from mgehl.solver.mass import CLOSED, flow_unit, mass_account
from mgehl.solver.verification import LOADED, check_edge, complementarity_error, flux_imbalance

COMPLEMENTARITY_TOLERANCE = 1e-6
"""Breach of P >= 0, H >= 0 and no inflow (units of P and H) that a converged answer may have,
however loose the tolerance of the residual."""

CLOSED_IN_TIME = 1e-8
"""Part of the stored oil by which the account of a step may be off."""


def summarise(problem, outcome, tolerance, making, scene=None):
    """The `Result` of a loaded contact with a film (collective), its grid judged by a `Scene` if there is
    one; gap, residual and load are evaluated anew from P, H0 and the partition. The `Making` is taken as it
    is."""
    contact, own = problem.contact, problem.contact.unheated
    state = outcome.state = problem.with_own_gap(outcome.state)
    evaluation = problem.evaluate(state)
    nm, moes = 1e9 * contact.film_scale, contact.film_scale * own.moes_scale
    central, minimum = problem.films(state)
    result = Result(
        **of_every_load(problem, state, making, LOADED),
        pressure_crest=loads(problem, state).crest_share,
        central_film_nm=central * nm,
        minimum_film_nm=minimum * nm,
        residual=problem.rms(problem.residual(evaluation, state.status)),
        complementarity_error=complementarity_error(problem, state, evaluation),
        flux_imbalance=flux_imbalance(problem, evaluation),
        pressure_inequality=_eq_2(problem, state),
        other_inequality=check_pressure_inequality(problem, state),
        contradictions=[_contradiction(each, nm) for each in outcome.contradictions],
        cavitated_nodes=problem.counts(state.status)[1],
        resolution=resolution(contact, problem.grid.mesh, scene, central * contact.film_scale),
        groups=own.groups,
        moes_film=MoesFilm(central * moes, minimum * moes),
        formulas={f"{name}_nm": 1e9 * film for name, film in own.compared.items()},
        mixed=mixed_result(problem, state),
        mass=mass_account(problem, state, evaluation),
        thermal_reduction=contact.thermal_reduction,
        is_thermally_reduced=bool(contact.lubricant.thinned < 1.0),
    )
    largest = allowed(tolerance, minimum, problem.rounding(evaluation, state.status))
    broken = first_broken(_equations(result, outcome, tolerance, largest))
    conserves = _conserves(problem, result.mass, tolerance)
    holds = result.pressure_inequality.violations == 0 and conserves and not result.edge.wrong[0]
    reason = broken or first_broken(_more(result, conserves))
    return replace(
        result, converged=not broken and holds, settled=not broken, residual_limit=largest,
        reason=reason or "residual, load, sets, complementarity and the pressure inequality hold",
    )  # fmt: skip


def summarise_in_time(problem, outcome, rows, scene, tolerance, making):
    """The `Result` of a run of a `Scene` in time, its last state verified (collective)."""
    result = summarise(problem, outcome, tolerance, making, scene)
    if not rows:
        failed = replace(result, converged=False, settled=False, reason=outcome.reason, mass=None)
        return replace(failed, error=OF_AN_INSTANT)
    largest_node = _largest_node(problem, outcome.state)
    end = scene.instant(problem.surfaced, rows[-1]["time_s"])
    time = time_result(rows, scene, making.work, largest_node)
    off = max(time.largest_closure, largest_node)
    settled, reason = result.settled and off <= CLOSED_IN_TIME, outcome.reason
    if not result.settled:
        reason = result.reason
    elif not settled:
        reason = f"the account of the oil is off by {off:.1e} of it in a step"
    cut, why = result.edge.wrong
    moes = end.unheated.moes_scale / problem.contact.unheated.moes_scale if end.speed else None
    film = result.moes_film
    return replace(
        result, converged=settled and not cut, settled=settled, reason=(settled and why) or reason,
        moes_film=moes and MoesFilm(moes * film.central, moes * film.minimum),
        mass=None, flux_imbalance=None, error=OF_AN_INSTANT, time=time,
        groups=None if scene.stands else result.groups,
        formulas={} if scene.stands else result.formulas,
        thermal_reduction=end.thermal_reduction,
        mixed=result.mixed and replace(result.mixed, lambda_ratio=end.lambda_ratio),
    )  # fmt: skip


def of_every_load(problem, state, making, part):
    """What a `Result` has of every loaded contact, not judged yet; the loaded zone has at least this `part`
    of the largest pressure (collective)."""
    grid, contact = problem.grid, problem.contact
    nm = 1e9 * contact.film_scale
    return {
        "converged": False, "settled": False, "reason": "",
        "max_pressure_GPa": 1e-9 * contact.hertz.p_h * grid.max(state.P),
        "load_error": problem.load_deficit(state.P, state.H0),
        "contact": _contact(problem, state, nm),
        "overlap": _overlap(grid, state, nm),
        "edge": check_edge(problem, state, part),
        "work": making.work, "wall_s": making.wall_s, "ranks": grid.comm.size, "versions": making.versions,
    }  # fmt: skip


def first_broken(checks):
    """The words of the first of pairs (whether it is broken, words); empty where all hold."""
    return next((words for broken, words in checks if broken), "")


def _equations(result, outcome, tolerance, largest):
    """What a solution of the discrete equations must hold; its residual may be the `largest`."""
    residual, broken = result.residual, result.complementarity_error
    found = f"the residual of the final state is {residual:.1e}, above {largest:.1e}"
    yield not outcome.converged, outcome.reason
    yield not residual <= largest, found
    yield not abs(result.load_error) <= tolerance, load_off(result.load_error, tolerance)
    yield not broken <= COMPLEMENTARITY_TOLERANCE, f"complementarity is broken by {broken:.1e}"


def load_off(load_error, tolerance):
    """That the load is not balanced, in words."""
    return f"the load is off by {load_error:.1e}, more than {tolerance:.1e}"


def _more(result, conserves):
    """What a settled state may break or leave open all the same."""
    inequality, overlap = result.pressure_inequality, result.overlap
    below = f"at {inequality.violations} of {inequality.checked} interface nodes"
    worst = f"contact pressure is below the fluid pressure beside it {below}, by up to"
    yield inequality.violations, f"{worst} {inequality.worst:.1e} p_h"
    yield result.edge.wrong
    made = f"{result.mass.made_share:.1e} of the oil that flows through"
    yield not conserves, f"a node, or nodes of one kind, make {made}"
    large = f"at {overlap.nodes} nodes by up to {overlap.largest_nm:.3g} nm"
    yield overlap.nodes, f"the unified equations hold, but the bodies overlap {large}"
    others = "residual, load, sets and complementarity hold; the pressure inequality is"
    yield not inequality.power.decides, f"{others} {undecided_words(inequality.power)}"


def _conserves(problem, mass, tolerance):
    """Whether no oil is made; the unified equations do not say. Where contact closes its faces hardly
    anything may flow through: there what a residual of the `tolerance` makes is nothing."""
    law, mesh, contact = problem.scheme.contact_law, problem.grid.mesh, problem.contact
    if mass.made_share <= CLOSED or not law.has_contact:
        return True
    area = (mesh.x[1] - mesh.x[0]) * (1.0 if mesh.is_line else mesh.y[1] - mesh.y[0])
    return law.closes_faces and mass.made <= tolerance * flow_unit(contact, mesh) * area


def _eq_2(problem, state):
    """What the verdict asks of Eq. 2: p <= P under contact where the fluid has a pressure there."""
    if problem.scheme.contact_law.closes_faces:
        return check_interface(problem, state)
    return check_under_contact(problem, state)


def _contradiction(node, nm):
    """What result.json says of a node that can be neither."""
    return {
        "i": node.i, "j": node.j, "film_gap_nm": nm * node.gap, "contact_pressure": node.pressure,
        "neighbours": list(node.neighbours),
    }  # fmt: skip


def _contact(problem, state, nm):
    """The `ContactResult` of a state; `nm` is nanometres in a unit of H (collective)."""
    grid, hertz_area = problem.grid, problem.hertz.area
    contact = state.status == CONTACT
    carried = problem.share_of_load(state.P, contact)
    largest_gap = nm * grid.max(np.abs(state.H[contact]), initial=0.0)
    cell = grid.mesh.dX * grid.mesh.dY
    nodes = grid.count(contact)
    i, j = grid.mesh.centre
    along_x = contact[j - grid.first] if grid.first <= j < grid.last else np.zeros(grid.mesh.nx, bool)
    x_nodes = np.flatnonzero(np.logical_or.reduce(grid.comm.allgather(along_x))) + 1
    y_nodes = np.flatnonzero(np.concatenate(grid.comm.allgather(contact[:, i]))) + 1
    across = None if grid.mesh.is_line else _ends(y_nodes)
    ends = _ends(x_nodes), across
    kept = nm * problem.scheme.contact_law.contact_gap
    return ContactResult(nodes, nodes * cell / hertz_area, carried, *ends, largest_gap, kept)


def _overlap(grid, state, nm):
    """The `Overlap` of a state, as `_contact` (collective)."""
    below = np.where(state.status == CONTACT, 0.0, -state.H)
    return Overlap(grid.count(below > 0.0), nm * grid.max(below, initial=0.0))


def _ends(nodes):
    return (int(nodes[0]), int(nodes[-1])) if len(nodes) else None


def _largest_node(problem, state):
    """What the balance of a node is off in the last step at the most, over the oil that is stored."""
    if problem.storage is None:
        return 0.0
    evaluation, inner = problem.evaluate(state), ~problem.boundary
    made = np.abs(np.where(inner, evaluation.inflow / problem.storage.rate, 0.0))
    return problem.grid.max(made) / problem.grid.sum(content(evaluation.fluid)[inner].sum())
