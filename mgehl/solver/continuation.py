"""Continuation: a solution is followed in speed, or from one mean of the mobility to another."""

from dataclasses import replace

from mgehl.solver.nested import nested_iteration
from mgehl.solver.on_grid import solve_near
from mgehl.solver.problem import ContactProblem
from mgehl.solver.recipe import FULL_FILM, recipe_of

SMALLEST_STEP = 0.25
"""A step that failed is halved, down to this part of the first step; 0.05 to 1 do the same."""

SPEED_RATIO = 2.0
"""Ratio of speeds that one step may try where nothing says less; 1.3 takes a third more work."""


class Continuation:
    """The contact of a `Task` at any speed, each solution from another, film and contact coupled. Where one
    on the way is not found, the problem that is returned is the one that was asked for."""

    def __init__(self, task):
        self._task = replace(task, settings=task.settings.squeezed())

    def begin(self):
        """Solve without a solution to begin with, by a mean whose flow has a fold: from the logarithmic
        mean's at a speed at which the grid resolves the inlet. Those on the way need not be exact."""
        task, settings = self._task, self._task.settings
        speed = task.contact.matched_speed(task.mesh, settings.inlet_cells)
        first = replace(settings, scheme=replace(settings.scheme, face_mobility="logarithmic")).roughly()
        faster = replace(task.at_speed(speed), settings=first)
        # By rounding the matched speed may miss the match: the grid sees that film none the less.
        problem, outcome = nested_iteration(faster, recipe_of(first, faster.contact, FULL_FILM))
        if outcome.converged:
            walk = self._walk(speed == task.contact.speed)
            problem, outcome = in_steps(lambda t, state: walk.at(speed, state, t), outcome.state)
        return self.slow_down(problem, outcome, exactly=False)

    def at(self, speed, state, share=1.0, **limits):
        """Solve at `speed` from `state`, maybe with own limits of Newton's; return problem and
        `Outcome`."""
        scheme = replace(self._task.settings.scheme, mobility_share=share)
        problem = self._task.at_speed(speed).but(scheme=scheme).problem()
        return problem, solve_near(self._task, problem, problem.with_own_gap(state), **limits)

    def follow(self, state, first_speed, last_speed):
        """Carry the `state` at one speed to another, in steps of equal ratio."""
        return self._asked(last_speed, *self._follow(state, first_speed, last_speed))

    def slow_down(self, problem, outcome, exactly=True):
        """From the solution of a faster contact to that of its own speed, as far as there is one. On the
        way `exactly`, or with a coarse grid's tolerance."""
        speed, goal = problem.contact.speed, self._task.contact.speed
        while outcome.converged and speed != goal:
            slower = max(goal, speed / SPEED_RATIO)
            problem, outcome = self._walk(exactly or slower == goal)._follow(outcome.state, speed, slower)
            speed = slower
        return self._asked(goal, problem, outcome)

    def _follow(self, state, first_speed, last_speed):
        def solve(t, state):
            return self.at(first_speed ** (1.0 - t) * last_speed**t, state)

        return in_steps(solve, state)

    def _walk(self, exactly):
        """The same, or with a coarse grid's tolerance, for what only leads to another solution."""
        task = self._task
        return Continuation(task if exactly else replace(task, settings=task.settings.roughly()))

    def _asked(self, speed, problem, outcome):
        """The problem that was asked for, where that of the `outcome` is a stage on the way to it. Its
        state is no solution of these equations, and is judged by them."""
        if outcome.converged:
            return problem, outcome
        scheme, contact = self._task.settings.scheme, self._task.contact.at_speed(speed)
        stage = problem.scheme, problem.contact.speed
        if stage == (scheme, speed):
            return problem, outcome
        reason = f"{_stage(*stage)} was not found: {outcome.reason}"
        asked = ContactProblem(problem.grid, problem.deflection, contact, scheme)
        return asked, replace(outcome, reason=reason)


def _stage(scheme, speed):
    """A stage on the way, in words."""
    share = f", {100 * scheme.mobility_share:.3g} % of it" if scheme.mobility_share < 1.0 else ""
    return f"a stage on the way ({scheme.face_mobility} mean{share}, {1e3 * speed:.4g} mm/s)"


def in_steps(solve, state):
    """Lead `state` from t = 0 to 1 with `solve(t, state)`, which returns a problem and an `Outcome`; return
    the last: at t = 1, or of the smallest step that failed. One that does not converge is halved."""
    reached, step = 0.0, 1.0
    while True:
        t = min(1.0, reached + step)
        problem, outcome = solve(t, state)
        if outcome.converged:
            reached, state, step = t, outcome.state, 2.0 * step
        else:
            step = 0.5 * (t - reached)
        if reached == 1.0 or step < SMALLEST_STEP:
            return problem, outcome
