"""What is solved beside a run's answer, from it: the same contact on coarser grids, and with other oil.

The error of the films follows from the coarser grids' films at the wanted speed. The finer answer is so
near that a few steps do: 15 % of the finest grid's work for two, 5 to 30 % for that of rough gaps, if these
do not have to begin anew.
"""

from dataclasses import replace

import numpy as np

from mgehl.solver.beginning import begin
from mgehl.solver.films import GridFilm, films_beside, films_between_nodes
from mgehl.solver.gaps import grid_gap
from mgehl.solver.on_grid import solve_near
from mgehl.solver.problem import ContactProblem, State

COARSER = 2
"""Grids besides the finest: two differences show whether the error falls as the scheme's does."""

TOLERANCE, MAX_STEPS = 1e-5, 10
"""Largest residual and most steps on the coarser grids; with 1e-4 thick films are off by 0.5 %."""

MAX_STEPS_OF_ROUGH = 40
"""Most steps on the coarser grids for rough bodies' gaps: of 17 balls 16 settled in 3 to 17."""

MAX_WORK_ANEW = 500
"""Most convolutions of the coarser grid's where the finer answer leads nowhere there."""

SPREADING_STEPS = 3
"""Steps in which contact may spread there: of 500 solves none settled in which it spread so often."""


class Beside:
    """What is solved beside the answer to a `Task`, the `state` of its `problem`: each contact once."""

    def __init__(self, task, problem, state):
        self.problem, self.settings = problem, task.settings
        self._task, self._hierarchy, self._state = task, task.hierarchy, state
        self._solved = {}
        """By level: problem and `Outcome`."""

    def films(self, scheme):
        """A tuple of `GridFilm`, of the finest grid and of the next coarser ones, those by a `Scheme` that
        may be another, down to the first that has contact, or no answer (collective)."""
        problem, state, grids = self.problem, self._state, self._hierarchy.grids
        films = films_between_nodes(problem, state)
        found, last = [_grid_film(problem, state, True, *films)], len(grids) - 1
        limits = {"max_steps": MAX_STEPS, "spreading_steps": SPREADING_STEPS}
        for level in range(last - 1, max(last - 1 - COARSER, -1), -1):
            H = self._hierarchy.transfers[level].inject(state.H)
            seen = self.problem.contact.seen_by(grids[level].mesh, grids[-1].mesh)
            problem, outcome = self._solve(level, seen, state, scheme, **limits)
            state, films = outcome.state, films_beside(problem, outcome.state, films[1], H)
            found.append(_grid_film(problem, state, outcome.converged, *films))
            if not found[-1].is_film:
                break
        return tuple(found)

    def of_films(self):
        """A tuple of `GridGap` of smooth bodies whose `films` are known: of the finest grid and the next
        coarser one, if films there are by the same scheme (collective)."""
        found, level = [grid_gap(self.problem, self._state, True)], len(self._hierarchy.grids) - 2
        problem, outcome = self._solved.get(level, (None, None))
        if problem and problem.scheme == self.problem.scheme:
            there = _at_nodes(self._hierarchy.transfers[level], self._state)
            found.append(grid_gap(problem, outcome.state, outcome.converged, there))
        return tuple(found)

    def gaps(self):
        """A tuple of `GridGap`, of the finest grid and of the next coarser one, if any (collective)."""
        problem, state, level = self.problem, self._state, len(self._hierarchy.grids) - 2
        finest = grid_gap(problem, state, True)
        if level < 0:
            return (finest,)
        there, contact = _at_nodes(self._hierarchy.transfers[level], state), problem.contact
        problem, outcome = self._solve(level, contact, state, problem.scheme, max_steps=MAX_STEPS_OF_ROUGH)
        if not outcome.converged:
            problem, outcome = self._solve_anew()
        return finest, grid_gap(problem, outcome.state, outcome.converged, there)

    def _solve_anew(self):
        """Problem and `Outcome` on the next coarser grid, from nothing."""
        tolerance = max(TOLERANCE, self.settings.newton.tolerance)
        task = self._task.limited(tolerance=tolerance, max_work=MAX_WORK_ANEW)
        return begin(replace(task, hierarchy=self._hierarchy.coarser()))

    def unthinned(self):
        """`ContactProblem` and `Outcome` on the finest grid without thinning by shear (collective)."""
        thinned, friction = self.problem, self.problem.contact.friction
        contact = replace(thinned.contact, friction=replace(friction, thins=False))
        problem = ContactProblem(thinned.grid, thinned.deflection, contact, thinned.scheme)
        outcome = solve_near(self._task, problem, problem.with_own_gap(self._state))
        # A film that is thinned severalfold is no beginning.
        return (problem, outcome) if outcome.converged else begin(replace(self._task, contact=contact))

    def _solve(self, level, contact, state, scheme, **limits):
        """Problem and `Outcome` of a contact on a coarser grid, from the finer `state` at its nodes. With
        these limits of Newton's, but where the same was solved before."""
        known, _ = self._solved.get(level, (None, None))
        if known and known.contact is contact and known.scheme == scheme:
            return self._solved[level]
        hierarchy, tolerance = self._hierarchy, max(TOLERANCE, self.settings.newton.tolerance)
        task = self._task.limited(tolerance=tolerance, **limits)
        problem = ContactProblem(hierarchy.grids[level], hierarchy.deflections[level], contact, scheme)
        there = _at_nodes(hierarchy.transfers[level], state)
        self._solved[level] = problem, solve_near(task, problem, problem.with_own_gap(there))
        return self._solved[level]


def _grid_film(problem, state, settled, *films):
    """The `GridFilm` of a state that has these films, `around` and `spread` besides, in units of H."""
    contact_nodes, _ = problem.counts(state.status)
    central, minimum, *apart = (1e9 * problem.contact.film_scale * each for each in films)
    return GridFilm(problem.grid.mesh.nx, central, minimum, contact_nodes, settled, *apart)


def _at_nodes(transfer, state):
    """A finer state at the nodes of the coarser grid of a transfer."""
    P, H, status, p, filling = (
        transfer.inject(each.astype(float))
        for each in (state.P, state.H, state.status, state.p, state.filling)
    )
    return State(P, state.H0, H, status.astype(np.int8), p, filling)
