"""Nested iteration: from a coarse grid to the finest, at speeds that each grid can resolve."""

from dataclasses import replace
from functools import partial
from math import ceil, log

import numpy as np

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.dry import dry_pressure, guess_on_finest
from mgehl.solver.on_grid import LevelSolve, solve_on
from mgehl.solver.problem import DIVERGED, ContactProblem
from mgehl.solver.recipe import (
    DRY,
    FULL_FILM,
    IN_CONTACT,
    UNDER_FILM,
    UNDER_THIN_FILM,
    UNSEEN_FILM,
    recipe_of,
)
from mgehl.solver.relaxation import relax

FLAT = 0.1
"""Largest gap, and largest overlap, that the dry guess may leave, over the formula's film that is laid on
it: a larger overlap would make contact where there is none."""

ROUNDING = 1e-9
"""So that a ratio that is the most allowed counts as that."""

THICKER = 3.0
"""Film over that of the formula from which a grid begins that hardly sees it: too few cells in the inlet
make films up to three times as thick. From the formula's own it takes up to six times the work."""


def nested_iteration(task, recipe=None):
    """Solve the contact of a `Task` by its `Recipe`, or by another one, coarse grids first; return its
    `ContactProblem` and its `Outcome`."""
    hierarchy, contact, settings = task.hierarchy, task.contact, task.settings
    recipe, reached, outcome = recipe or task.recipe, None, None
    meshes = [grid.mesh for grid in hierarchy.grids]
    for level, solve, own in planned_solves(meshes, contact, settings, recipe):
        grid, deflection = hierarchy.grids[level], hierarchy.deflections[level]
        seen = contact.at_speed(solve.speed).seen_by(grid.mesh, task.mesh)
        problem = ContactProblem(grid, deflection, seen, settings.scheme)
        here = recipe_of(own, seen, recipe.begins)
        if outcome is None:
            P = guess_on_finest(hierarchy, contact, settings.scheme) if solve.finest else None
            state = first_guess(problem, here.begins, P)
        elif level == reached:
            state = problem.with_own_gap(outcome.state)
        else:
            state = interpolate(hierarchy.transfers[level - 1], problem, outcome.state)
        reached, outcome = level, _solve(task, problem, state, here, solve)
        if not outcome.cycles[-1].residual < DIVERGED:
            break  # nothing to start the next grid from; the outcome says why
    return problem, outcome


def _solve(task, problem, state, recipe, solve):
    """Solve from a state by its own `Recipe`; where that leads nowhere, anew by time steps."""
    if recipe.newton.squeeze > 0.0:
        return solve_on(task, problem, state, recipe, solve)
    outcome = solve_on(task, problem, state.copy(), recipe, solve)
    if outcome.converged or not task.may_go_on:
        return outcome
    news = f"not found: {outcome.reason}; now by time steps"
    return solve_on(task, problem, state, replace(recipe, newton=recipe.patient), replace(solve, news=news))


def single_loop(task, state=None):
    """Solve by the paper's relaxation, on the finest grid alone; else as `nested_iteration`."""
    problem = task.problem()
    if state is None:
        state = first_guess(problem, task.recipe.begins)
    tell = partial(task.monitor, LevelSolve(task.mesh.nx, task.contact.speed, True))
    return problem, relax(problem, state, task.settings.relaxation, tell, task.journal)


def first_guess(problem, begins, P=None):
    """The state that a solve begins with, as a `Recipe` names it. `P` (lines, nx) is a pressure to begin
    with, unless that of smooth bodies."""
    grid, contact = problem.grid, problem.contact
    P = contact.guessed_pressure(grid.X, grid.Y) if P is None else P
    film = contact.expected_film / contact.film_scale
    if begins == UNSEEN_FILM:
        film *= THICKER
    if begins in (UNDER_FILM, UNDER_THIN_FILM, DRY):
        return _first_guess_of_peaks(problem, begins, dry_pressure(problem, P, FLAT * film), film)
    pressed = grid.X**2 + grid.Y**2 <= contact.widening**2
    if contact.deformation is not None or (begins == IN_CONTACT and not contact.is_hertzian):
        P = dry_pressure(problem, P)
        pressed = P > 0.0
    H0 = problem.touching(P)
    if begins in (FULL_FILM, UNSEEN_FILM):
        return problem.state(P, film + H0, np.full(grid.shape, LUBRICATED))
    if begins != IN_CONTACT:
        raise ValueError(f"{begins!r} is no first guess")
    pressed = pressed & problem.scheme.contact_law.has_contact
    return problem.state(P, H0, np.where(pressed, CONTACT, LUBRICATED))


def _first_guess_of_peaks(problem, begins, P, film):
    """The dry pressure `P` of the rough bodies, with a `film` between them, nearly none, or none. It lies
    on the layers that contact keeps: a film thinner than they are would close nearly everywhere."""
    layers, pressed = problem.scheme.contact_law.contact_gap, P > 0.0
    above = {UNDER_FILM: film, UNDER_THIN_FILM: FLAT * film, DRY: 0.0}[begins]
    H0 = layers + above - problem.mean(problem.gap(P, 0.0), pressed)
    if begins == DRY:
        nothing = np.zeros(problem.grid.shape)
        return problem.state(P, H0, np.where(pressed, CONTACT, CAVITATED), nothing, nothing)
    return problem.state(P, H0, np.full(problem.grid.shape, LUBRICATED))


def interpolate(transfer, problem, coarse):
    """The coarse state on the fine grid: P cubic, a node in contact where most of it would be. The first
    steps on every grid would smooth the kinks of a bilinear P."""
    P = transfer.cubic(coarse.P)
    status = problem.status_of(P, transfer.bilinear((coarse.status == CONTACT).astype(float)))
    return problem.state(P, coarse.H0, status, transfer.bilinear(coarse.p))


def planned_solves(meshes, contact, settings, recipe):
    """(Level, `LevelSolve`, its `SolverSettings`) of what is solved on which of the `meshes` by a `Recipe`,
    coarsest first, at speeds that coarse grids resolve and that do not lift the bodies off each other."""
    before = None
    for level, speed in _speeds_on_levels(meshes, contact, settings, recipe.on_coarse_grids):
        finest = level == len(meshes) - 1
        for each in _on_the_way(before or speed, speed, recipe.most_slower):
            yield level, LevelSolve(meshes[level].nx, each, finest), settings.in_passing()
        yield level, LevelSolve(meshes[level].nx, speed, finest), settings if finest else settings.roughly()
        before = speed


def _speeds_on_levels(meshes, contact, settings, on_coarse_grids):
    """(Level, speed) to be solved on each level that is."""
    for level, mesh in enumerate(meshes[:-1] if on_coarse_grids else []):
        speed = contact.matched_speed(mesh, settings.inlet_cells)
        if mesh.nx >= settings.first_nodes and not contact.at_speed(speed).hardly_yields:
            yield level, speed
    yield len(meshes) - 1, contact.speed


def _on_the_way(first, last, most_slower):
    """Speeds between two, in equal ratios of at most `most_slower`."""
    steps = ceil(log(first / last) / log(most_slower) - ROUNDING) if first > last else 1
    return [first * (last / first) ** (step / steps) for step in range(1, steps)]
