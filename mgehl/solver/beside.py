"""What is solved beside a run's answer, from it: the same contact on coarser grids, and with other oil.

The error of the films follows from the coarser grids' films at the wanted speed. The finer answer is so
near that a few steps do: 15 % of the finest grid's work for two, 5 to 30 % for that of rough gaps.
"""

from dataclasses import replace

import numpy as np

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

SPREADING_STEPS = 3
"""Steps in which contact may spread there: of 500 solves none settled in which it spread so often."""


class Beside:
    """What is solved beside the answer to a `Task`, the `state` of its `problem`.

    Whoever wants both asks for the `gaps` first: `films` takes over what was solved for them.
    """

    def __init__(self, task, problem, state):
        self.problem, self.settings = problem, task.settings
        self._task, self._hierarchy, self._state = task, task.hierarchy, state
        self._of_gaps = None
        """Problem and `Outcome` by which `gaps` were told."""

    def films(self, scheme):
        """A tuple of `GridFilm`, of the finest grid and of the next coarser ones (collective).

        Those are solved by a `Scheme` that may be another. It ends with the first grid that has
        contact, or no answer.
        """
        problem, state, grids = self.problem, self._state, self._hierarchy.grids
        films = films_between_nodes(problem, state)
        found, last = [_grid_film(problem, state, films, True)], len(grids) - 1
        for level in range(last - 1, max(last - 1 - COARSER, -1), -1):
            H = self._hierarchy.transfers[level].inject(state.H)
            seen = self.problem.contact.seen_by(grids[level].mesh, grids[-1].mesh)
            problem, outcome = self._film(level, seen, state, scheme)
            state, films = outcome.state, films_beside(problem, outcome.state, films, H)
            found.append(_grid_film(problem, state, films, outcome.converged))
            if not found[-1].is_film:
                break
        return tuple(found)

    def gaps(self):
        """A tuple of `GridGap`, of the finest grid and of the next coarser one, if any (collective)."""
        finest, level = grid_gap(self.problem, self._state, True), len(self._hierarchy.grids) - 2
        if level < 0:
            return (finest,)
        there = _at_nodes(self._hierarchy.transfers[level], self._state)
        self._of_gaps = problem, outcome = self._whole(level)
        return finest, grid_gap(problem, outcome.state, outcome.converged, there)

    def unthinned(self):
        """`ContactProblem` and `Outcome` on the finest grid without thinning by shear (collective)."""
        thinned, friction = self.problem, self.problem.contact.friction
        contact = replace(thinned.contact, friction=replace(friction, thins=False))
        problem = ContactProblem(thinned.grid, thinned.deflection, contact, thinned.scheme)
        return problem, solve_near(self._task, problem, problem.with_own_gap(self._state))

    def _whole(self, level):
        """Problem and `Outcome` of the contact with all of its surface, by the scheme of the run."""
        contact, scheme = self.problem.contact, self.problem.scheme
        return self._solve(level, contact, self._state, scheme, max_steps=MAX_STEPS_OF_ROUGH)

    def _film(self, level, contact, state, scheme):
        """Problem and `Outcome` of a film; those that have told the gaps, where they are the same."""
        if self._of_gaps and _is_of(self._of_gaps[0], self._hierarchy.grids[level], contact, scheme):
            return self._of_gaps
        limits = {"max_steps": MAX_STEPS, "spreading_steps": SPREADING_STEPS}
        return self._solve(level, contact, state, scheme, **limits)

    def _solve(self, level, contact, state, scheme, **limits):
        """Problem and `Outcome` of a contact on a coarser grid, from the finer `state` at its nodes.

        With these limits of Newton's; Eq. 2 lets nothing go.
        """
        hierarchy, newton = self._hierarchy, self.settings.newton
        limits |= {"tolerance": max(TOLERANCE, newton.tolerance), "release_budget": 0}
        task = self._task.but(newton=replace(newton, **limits))
        problem = ContactProblem(hierarchy.grids[level], hierarchy.deflections[level], contact, scheme)
        there = _at_nodes(hierarchy.transfers[level], state)
        return problem, solve_near(task, problem, problem.with_own_gap(there))


def _is_of(problem, grid, contact, scheme):
    """Whether it is the problem of this very contact, on this grid, by this `Scheme`."""
    return problem.grid is grid and problem.contact is contact and problem.scheme == scheme


def _grid_film(problem, state, films, settled):
    """The `GridFilm` of a state that has these `Films`."""
    nm, (contact_nodes, _) = 1e9 * problem.contact.film_scale, problem.counts(state.status)
    return GridFilm(
        problem.grid.mesh.nx, nm * films.central, nm * films.minimum, contact_nodes, settled,
        nm * films.around, nm * films.spread,
    )  # fmt: skip


def _at_nodes(transfer, state):
    """A finer state at the nodes of the coarser grid of a transfer."""
    P, H, status, p, filling = (
        transfer.inject(each.astype(float))
        for each in (state.P, state.H, state.status, state.p, state.filling)
    )
    return State(P, state.H0, H, status.astype(np.int8), p, filling)
