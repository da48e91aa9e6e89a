"""One run from a configuration to its directory."""

from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path

import numpy as np
from mpi4py import MPI

from mgehl.grid.hierarchy import Hierarchy
from mgehl.kinds import Case, case_of, checked_case
from mgehl.kinds.bodies import arms
from mgehl.kinds.domain_in_time import with_room_for
from mgehl.kinds.own import naming_keys
from mgehl.kinds.time import of_formulas
from mgehl.output import files, progress, terminal
from mgehl.output.checkpoint import Checkpoint, begin_run
from mgehl.output.diary import Comparison, Diary
from mgehl.output.directory import make_directory, prepare_directory
from mgehl.output.film_error import film_error
from mgehl.output.finish import finish_run
from mgehl.output.forecast import check_memory
from mgehl.output.friction_result import (
    banded,
    banded_in_time,
    friction_result,
    with_moments,
    with_unthinned,
)  # fmt: skip
from mgehl.output.gap_error import gap_error, of_films
from mgehl.output.laws import law_files
from mgehl.output.lock import locked
from mgehl.output.result import Making, Work
from mgehl.output.solution import Solution, on_every_rank
from mgehl.output.summary import summarise, summarise_in_time
from mgehl.output.surroundings import versions
from mgehl.output.time_error import from_a_start, time_error, with_bands
from mgehl.output.users_axes import solution_of
from mgehl.run_bearing import solve_bearing
from mgehl.run_dry import DrySolve
from mgehl.solver.beginning import begin
from mgehl.solver.beside import Beside
from mgehl.solver.closing import close_account
from mgehl.solver.from_config import SetUp, set_up
from mgehl.solver.in_time import march, march_beside
from mgehl.solver.journal import Asked
from mgehl.solver.nested import single_loop
from mgehl.solver.recipe import recipe_in_time
from mgehl.solver.recipe_words import plain
from mgehl.solver.restart import solve_from
from mgehl.solver.task import Task


@dataclass(frozen=True)
class Watch:
    """What accompanies a solve: who speaks of it, where it is kept, what may stop it."""

    speaker: object = terminal.SILENT
    """Told of every cycle, on rank 0."""
    directory: Path | None = None
    """Whose checkpoint is kept; None for none."""
    save_every: float = 60.0
    """Seconds from one save to the next."""
    stop: object = lambda: None
    """Asked before every step; returns None or the `Stopped` to raise when all is saved."""
    picture: bool = True
    """Whether one is drawn: it takes a second, as long as many a case of a study."""


def enter(config, comm, start=None):
    """The `Case` of a `Config`, made once for all that is done with it, and good to be solved on `comm`.

    An "auto" domain of a run in time holds that of the `Solution` that is its `start`, if any. Raises
    ConfigError where values do not fit each other, UserError where a rank may not take the memory.
    """
    case = checked_case(config)
    if start is not None and config.is_in_time:
        case = checked_case(with_room_for(start, case, config))
    check_memory(case, comm.size)
    return case


def run(case, directory, comm, watch=Watch(), start=None, start_directory=None):
    """Solve a `Case`, or a `Config`, on `comm`, write `directory` (from rank 0), return the result.

    The caller holds the directory (`output.lock`), which exists. What was reached is kept in its checkpoint
    until the results are there; a run that finds one goes on from it. `start` is a `Solution` to start
    from, with fields on rank 0, and `start_directory` where it was read.
    """
    case, directory = _entered(case, comm), Path(directory)
    files.on_first_rank(comm, begin_run, directory, case.config, start_directory)
    solution = solve(case, comm, replace(watch, directory=directory), start)
    if comm.rank == 0:
        watch.speaker.writing()
    finish_run(comm, directory, solution, watch.picture)
    if comm.rank == 0:
        watch.speaker.end(solution, directory)
    return solution.result


def save(solution, directory, picture=True):
    """Write the directory of a `Solution` whose fields are here, as `run` leaves it."""
    make_directory(directory, force=True)
    with locked(MPI.COMM_SELF, directory):
        prepare_directory(directory, law_files(solution.config).values())
        begin_run(directory, solution.config)
        finish_run(MPI.COMM_SELF, directory, solution, picture)


def solve(case, comm, watch=Watch(), start=None):
    """Solve a `Case`, or a `Config`, on `comm`; return the `Solution`.

    A single line of nodes, as of a line contact, rank 0 solves and tells the others.
    """
    case = _entered(case, comm)
    watch = watch if comm.rank == 0 else replace(watch, speaker=terminal.SILENT)
    if not case.mesh.is_line:
        return _find(case, comm, watch, start)
    return on_every_rank(comm, files.from_first_rank(comm, _find, case, MPI.COMM_SELF, watch, start))


def _entered(case, comm):
    """A `Case`; that of a `Config` is made now, without a look at whether its values fit each other."""
    if isinstance(case, Case):
        return case
    case = case_of(case)
    check_memory(case, comm.size)
    return case


def _find(case, comm, watch, start):
    """The `Solution` of a `Case` (collective)."""
    with naming_keys(case.contact), np.errstate(all="ignore"):  # what diverges says so itself
        parts = set_up(case)
        if not case.contact.is_loaded:
            return solve_bearing(case, parts, comm, watch)
        hierarchy = parts.hierarchy(comm)
        try:
            return _find_on(hierarchy, case, parts, watch, start)
        finally:
            hierarchy.destroy()


def _find_on(hierarchy, case, parts, watch, start):
    """The `Solution` of a loaded contact on these grids (collective)."""
    kind, tolerance = progress.newton_row, parts.settings.newton.tolerance
    if case.config.is_dry:
        kind = progress.dry_row
    elif not parts.settings.by_newton:
        kind, tolerance = progress.sweep_row, parts.settings.relaxation.tolerance
    monitor = progress.Progress(kind, parts.contact.film_scale, hierarchy, tolerance, watch.speaker)
    solve = _LoadedSolve(case, parts, hierarchy, monitor, watch, start)
    if case.config.is_dry:
        return solve.without_a_fluid()
    return solve.in_time() if case.config.is_in_time else solve.in_a_steady_state()


@dataclass(frozen=True)
class _LoadedSolve:
    """A solve of a loaded contact, from a `start` if there is one; each of its ways is collective."""

    case: Case
    parts: SetUp
    hierarchy: Hierarchy
    monitor: progress.Progress
    watch: Watch
    start: Solution | None

    def in_a_steady_state(self):
        """Its `Solution` by either method."""
        problem, outcome, steps = self._solved()
        result = summarise(problem, outcome, self._tolerance, self._making(steps))
        beside = Beside(replace(self._task, monitor=self.monitor.beside), problem, outcome.state)
        result, loads = self._with_bands(result, beside)
        friction, maps = self._friction(problem, outcome, self.case.contact.angle)
        friction = self._compared(friction, result, loads, beside)
        recipe, seconds = self._recipe(outcome), self.monitor.seconds
        result = replace(result, friction=friction, recipe=recipe, wall_s=seconds)
        return self._solution(problem, outcome, result, maps)

    def _solved(self):
        """Problem, `Outcome` and number of steps."""
        task, by_newton = self._task, self.parts.settings.by_newton
        method = begin if by_newton else single_loop
        if self.start:
            method = partial(solve_from, start=self.start, frame=self.parts.frame)
        problem, outcome = method(task)
        if not by_newton:
            return problem, outcome, outcome.cycles[-1].step
        outcome = close_account(task, problem, outcome)
        return problem, outcome, self.monitor.steps

    def _with_bands(self, result, beside):
        """The `Result` with its bands, and the `GapError` of what carries its load."""
        mixed = result.mixed and replace(result.mixed, error=gap_error(result, beside, self.monitor))
        error = film_error(result, beside, self.monitor)
        loads = (mixed and mixed.error) or of_films(error, beside)
        pressure = loads.max_pressure_GPa
        return replace(result, mixed=mixed, error=error, max_pressure_band_GPa=pressure), loads

    def _friction(self, problem, outcome, angle, steady=True):
        """The `FrictionResult` of surfaces that go at an `angle`, and its maps."""
        friction, maps = friction_result(problem, outcome.state, steady)
        is_asked = self.case.config.motion.slide_to_roll is not None
        return with_moments(replace(friction, is_asked=is_asked), arms(self.case.config, angle)), maps

    def _compared(self, friction, result, loads, beside):
        """A `FrictionResult` with its band, and with the films that shear would not thin."""
        settings, of_contact = self._task.settings, self._task.contact.friction
        friction = banded(friction, loads, of_contact.boundary_coefficient, settings.error)
        if friction and of_contact.thins and settings.error:
            return with_unthinned(friction, result, beside.unthinned)
        return friction

    def in_time(self):
        """Its `Solution` at the end of a run in time."""
        case, parts, monitor, start = self.case, self.parts, self.monitor, self.start
        diary = Diary(case, parts.frame, self.hierarchy.grids[-1], monitor, self.watch)
        task = replace(self._task, contact=case.scene.framed, monitor=monitor.beside)
        problem, outcome = march(case.scene, task, diary, start and (start, parts.frame))
        making = self._making(len(monitor.rows))
        result = summarise_in_time(problem, outcome, monitor.rows, case.scene, self._tolerance, making)
        result, maps = self._with_friction_and_bands(result, problem, outcome, task)
        formulas_of = of_formulas(case.config).removeprefix(", ")
        recipe = self._recipe(outcome)
        result = replace(result, recipe=recipe, formulas_of=formulas_of, wall_s=monitor.seconds)
        return replace(self._solution(problem, outcome, result, maps), frames=diary.frames)

    def _with_friction_and_bands(self, result, problem, outcome, task):
        """The `Result` of a run in time with the friction of its end and bands, and maps of friction; of a
        run that found no beginning as it is."""
        rows, scene = self.monitor.rows, self.case.scene
        if not rows:
            return result, None
        t = rows[-1]["time_s"]
        now = problem.moving(scene.speed.value(t))
        friction, maps = self._friction(now, outcome, scene.angle.value(t), steady=False)
        error = self._time_error(result, problem, task)
        friction = banded_in_time(friction, error.at_the_end.get("friction"))
        return with_bands(replace(result, friction=friction), problem.contact, error), maps

    def _time_error(self, result, problem, task):
        """The `TimeError` of a run in time by its `Task`."""
        beside = partial(self._marched_beside, task)
        asked = self.parts.settings.error
        error = time_error(result, problem, self.case.scene, asked, self.monitor, beside)
        return from_a_start(error, self.start and self.start.result, result.time.passages)

    def _marched_beside(self, task):
        """Rows of the same run on the next coarser grid; and why there are none to compare with, or ""."""
        monitor, scene, grids = self.monitor, self.case.scene, self.hierarchy.grids
        if len(grids) == 1:
            return [], "there is no coarser grid"
        times, nodes = [row["time_s"] for row in monitor.rows], grids[-2].mesh.nx
        monitor.news(f"for its bands, the same on {nodes} nodes in steps of two")
        told, task = Comparison(scene, times[-1], monitor), replace(task, journal=Asked(self.watch.stop))
        outcome = march_beside(scene, task, times, told, self.start and (self.start, self.parts.frame))
        why_not = "" if outcome.converged else f"on {nodes} nodes, the next coarser grid: {outcome.reason}"
        return told.rows, why_not

    def without_a_fluid(self):
        """Its `Solution` as a dry contact."""
        solve = DrySolve(self._task, self.monitor)
        return self._solution(*solve.found(self.start, self.parts.frame))

    @cached_property
    def _task(self):
        return Task(self.hierarchy, self.parts.contact, self.parts.settings, self.monitor, self._journal)

    @property
    def _tolerance(self):
        """That of the verdict: the user's."""
        return self.case.config.solver.tolerance

    @cached_property
    def _journal(self):
        """What is told of the way: the checkpoint of a directory, if there is one."""
        watch = self.watch
        if not watch.directory:
            return Asked(watch.stop)
        return Checkpoint(watch.directory, self.case.config, self.monitor, watch.save_every, watch.stop)

    def _making(self, steps):
        """The `Making` of an answer in so many steps."""
        work = Work(self.monitor.convolutions, steps)
        return Making(work, self.monitor.seconds, versions())

    def _recipe(self, outcome):
        """What was chosen on the way to an `Outcome`, as result.json has it; in time that of the beginning,
        and what is otherwise in steps."""
        beginning, settings = plain(self.parts.recipe(self.start, outcome.begins)), self.parts.settings
        if not self.case.config.is_in_time:
            return beginning
        steps = plain(recipe_in_time(settings, self.parts.contact))
        return beginning | {"steps": {key: each for key, each in steps.items() if each != beginning[key]}}

    def _solution(self, problem, outcome, result, maps=None):
        return solution_of(self.case, self.parts, problem, outcome.state, self.monitor.rows, result, maps)
