"""Nested iteration: from a coarse grid to the finest, at speeds that each grid can resolve."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.dry import dry_pressure, guess_on_finest
from mgehl.solver.fluid_guess import guess_fluid
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.newton import Newton
from mgehl.solver.problem import DIVERGED, ContactProblem
from mgehl.solver.relaxation import relax
from mgehl.solver.rigid_gap import RigidGapFluid

FLAT = 0.1
"""Largest gap, and largest overlap, that the dry guess may leave, over the formula's film that is laid on
it. A larger overlap would make contact where there is none (a ball of 188 nm rms at 0.04 mm/s: 2234
nodes)."""


BESIDE_LAYERS = 1.0
"""The formula's film over the layers below which a start takes the dry contact as it is. A ball of 100 nm
rms with layers of 2 nm at 0.1 mm/s (half a layer): 209 convolutions for 425 from a thin film on 129 nodes.
Below 0.1 um/s it is found from the dry contact alone. At 0.6 mm/s (1.7 layers) the dry contact saves a
quarter on 129 nodes, and leads nowhere on 257."""


@dataclass(frozen=True)
class LevelSolve:
    """What is being solved: the grid's nodes along X and the speed in m/s."""

    nodes: int
    speed: float | None
    """None where there is no fluid."""
    finest: bool
    news: str = ""
    """What its user should know of the way here; empty where all goes as planned."""


def nested_iteration(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve `contact` on the finest grid; return its `ContactProblem` and its `Outcome`.

    `monitor(level, cycle)` is called with a `LevelSolve` and the `Cycle` for every cycle.
    """
    coarse = settings.roughly().newton
    outcome = None
    for level, solve in planned_solves([grid.mesh for grid in hierarchy.grids], contact, settings):
        limits = settings.newton if solve.finest else coarse
        grid, deflection = hierarchy.grids[level], hierarchy.deflections[level]
        seen = contact.at_speed(solve.speed).seen_by(grid.mesh, hierarchy.grids[-1].mesh)
        problem = ContactProblem(grid, deflection, seen, settings.scheme)
        if outcome is None:
            P = guess_on_finest(hierarchy, contact, settings.scheme) if solve.finest else None
            state = first_guess(problem, settings.nested.start, P)
        else:
            state = interpolate(hierarchy.transfers[level - 1], problem, outcome.state)
        tell = partial(monitor, solve)
        outcome = _solve_level(hierarchy, level, problem, state, limits, settings, tell, journal)
        if not outcome.cycles[-1].residual < DIVERGED:
            break  # nothing to start the next grid from; the outcome says why
    return problem, outcome


def single_loop(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve by the paper's relaxation, on the finest grid alone; otherwise as `nested_iteration`."""
    grid = hierarchy.grids[-1]
    problem = ContactProblem(grid, hierarchy.deflections[-1], contact, settings.scheme)
    state = first_guess(problem, settings.nested.start)
    tell = partial(monitor, LevelSolve(grid.mesh.nx, contact.speed, True))
    return problem, relax(problem, state, settings.relaxation, tell, journal)


def first_guess(problem, start, P=None):
    """The dry contact's pressure with a film of the formula's thickness, or in contact where it presses.

    `P` (lines, nx) is a pressure to begin with, unless that of smooth bodies.
    """
    grid, contact = problem.grid, problem.contact
    P = contact.guessed_pressure(grid.X, grid.Y) if P is None else P
    pressed = grid.X**2 + grid.Y**2 <= contact.widening**2
    if problem.scheme.lets_peaks_touch(problem.contact):
        film = contact.expected_film / contact.film_scale
        return _first_mixed_guess(problem, start, dry_pressure(problem, P, FLAT * film), film)
    if contact.deformation is not None or (start == "contact" and not contact.is_hertzian):
        P = dry_pressure(problem, P)
        pressed = P > 0.0
    H0 = problem.touching(P)
    if start == "film":
        film = contact.expected_film / contact.film_scale
        return problem.state(P, film + H0, np.full(grid.shape, LUBRICATED))
    pressed = pressed & problem.scheme.contact_law.has_contact
    return problem.state(P, H0, np.where(pressed, CONTACT, LUBRICATED))


def _first_mixed_guess(problem, start, P, film):
    """The dry pressure `P` of the rough bodies, with a `film` between them, or nearly none.

    The film lies on the layers that contact keeps. Without them a film thinner than they are would close
    nearly everywhere (a ball of 188 nm rms at 0.04 mm/s, 2 nm: 14000 nodes, and no end).
    A start from contact takes the thinnest film and no node in contact. With contact everywhere, nodes
    would open and close for ever (a ball of 100 nm rms at 0.1 m/s: 60 steps without an end, 14 from the
    thin film). Where the film is thin beside the layers, solids carry nearly all: the dry contact lies on
    the layers, without a fluid in it.
    """
    layers = problem.scheme.contact_law.contact_gap
    if film < BESIDE_LAYERS * layers:
        nothing, H0 = np.zeros(problem.grid.shape), layers - problem.mean(problem.gap(P, 0.0), P > 0.0)
        return problem.state(P, H0, np.where(P > 0.0, CONTACT, CAVITATED), nothing, nothing)
    film = layers + (FLAT * film if start == "contact" else film)
    H0 = film - problem.mean(problem.gap(P, 0.0), P > 0.0)
    return problem.state(P, H0, np.full(problem.grid.shape, LUBRICATED))


def interpolate(transfer, problem, coarse):
    """The coarse state on the fine grid: P cubic, a node in contact where most of it would be.

    The first steps on every grid would smooth the kinks of a bilinear P (M = 200, L = 10 on 1025 nodes: 99
    convolutions for 75).
    """
    P = transfer.cubic(coarse.P)
    in_contact = transfer.bilinear((coarse.status == CONTACT).astype(float)) > 0.5
    film = (P > 0.0) | (not problem.scheme.cavitation)
    status = np.where(in_contact, CONTACT, np.where(film, LUBRICATED, CAVITATED))
    return problem.state(P, coarse.H0, status, transfer.bilinear(coarse.p))


def planned_solves(meshes, contact, settings):
    """(Level, `LevelSolve`) of what is solved on which of the `meshes`, coarsest first, at which speed.

    A film begins on the coarse grids, at speeds that they resolve and that do not lift the bodies off each
    other. A start from contact, and the relaxation, take the finest grid alone. So do rough bodies whose
    peaks touch: coarse grids do not see the surface, and the dry contact's pressure is nearer to the answer
    than that of any film. A film thicker than the roughness is found as that of smooth bodies. From the dry
    contact a film twice as thick takes twice the work, and one three times as thick is not found (random
    balls, 257 nodes).
    """
    finest, nested = len(meshes) - 1, settings.nested
    at_once = settings.method == "relaxation" or settings.scheme.lets_peaks_touch(contact)
    alone = nested.start == "contact" or at_once
    for level, mesh in enumerate(meshes):
        if level == finest:
            yield level, LevelSolve(mesh.nx, contact.speed, True)
        elif mesh.nx >= nested.first_nodes and not alone:
            speed = contact.matched_speed(mesh, nested.inlet_cells)
            if not contact.at_speed(speed).hardly_yields:
                yield level, LevelSolve(mesh.nx, speed, False)


def _solve_level(hierarchy, level, problem, state, limits, settings, tell, journal):
    def multigrid(**how):
        return MultigridSolver(hierarchy, level, problem.contact, problem.scheme, settings.cycle, **how)

    prefix, fluid = settings.cycle.options_prefix, None
    law = problem.scheme.contact_law
    from_contact = settings.nested.start == "contact" and law.has_contact
    if from_contact or problem.scheme.lets_peaks_touch(problem.contact):
        limits = limits.squeezed()
    if from_contact and law.closes_faces:
        guess_fluid(hierarchy, level, problem, state, settings)
        fluid = RigidGapFluid(problem, multigrid(rigid=True), prefix + "fluid_")
    try:
        newton = Newton(problem, multigrid(apart=fluid is not None), limits, fluid, prefix, tell)
        try:
            return newton.run(state, journal)
        finally:
            newton.free()
    finally:
        if fluid:
            fluid.free()
