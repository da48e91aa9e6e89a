"""A run of a dry contact, and its bands by the next coarser grid."""

from dataclasses import dataclass, replace
from functools import partial

from mgehl.output.dry_error import dry_error, no_band, why_no_band
from mgehl.output.dry_summary import summarise_dry
from mgehl.output.progress import Progress
from mgehl.output.result import Making, Work
from mgehl.output.surroundings import versions
from mgehl.solver.dry import guess_on_finest, on_coarser, solve_dry
from mgehl.solver.on_grid import LevelSolve
from mgehl.solver.restart import interpolated
from mgehl.solver.task import Task


@dataclass(frozen=True)
class DrySolve:
    """The solve of a `Task` without a fluid; `progress` is told of it (all methods collective)."""

    task: Task
    progress: Progress

    def found(self, start=None, frame=None):
        """Problem, `Outcome` and `Result`, maybe from a `start`, a `Solution` in the axes of a `Frame`."""
        task, progress = self.task, self.progress
        problem = task.problem()
        if start:
            guess = interpolated(problem, start, frame).P
        else:
            guess = guess_on_finest(task.hierarchy, task.contact, task.settings.scheme)
        outcome = self._outcome(problem, guess, progress)
        making = Making(Work(progress.convolutions, progress.steps), progress.seconds, versions())
        result = summarise_dry(problem, outcome, task.settings.newton.tolerance, making)
        result = self._with_bands(result, problem, outcome.state)
        return problem, outcome, replace(result, wall_s=progress.seconds)

    def _outcome(self, problem, guess, monitor):
        """The `Outcome` of a problem on its grid, from a guess of P; a `monitor` is told of every step."""
        limits, nodes = self.task.settings.newton, problem.grid.mesh.nx
        tell = partial(monitor, LevelSolve(nodes, None, nodes == self.task.mesh.nx))
        return solve_dry(problem, guess, limits.tolerance, limits.max_steps, tell, self.task.journal)

    def _with_bands(self, result, problem, state):
        """The same `Result` with its bands."""
        progress = self.progress
        if why_not := why_no_band(result, self.task.settings.error):
            return replace(result, dry_error=no_band(why_not))
        before, solve = progress.convolutions, partial(self._outcome, monitor=progress.beside)
        error = dry_error(result, problem, state, on_coarser(self.task.hierarchy, problem, state.P, solve))
        error = replace(error, convolutions=progress.convolutions - before)
        return replace(result, dry_error=error, max_pressure_band_GPa=error.max_pressure_GPa)
