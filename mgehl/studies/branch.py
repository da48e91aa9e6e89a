"""A contact followed in speed on one grid, every point on disk before the next begins.

    down  from the fastest speed and a full film
    up    from the slowest speed and full contact

A branch ends where no state near the last one solves the equations at the next speed. Then the point is
taken from the other branch, or from the other start, and says so.
"""

import json
import time
from dataclasses import dataclass, replace

import numpy as np

from mgehl.kinds import case_of
from mgehl.output.directory import make_directory
from mgehl.output.files import on_first_rank
from mgehl.output.progress import newton_row
from mgehl.output.result import Work
from mgehl.output.solution import Fields, Solution
from mgehl.output.study_directory import POINT
from mgehl.output.summary import summarise
from mgehl.output.surroundings import versions
from mgehl.output.whole_file import write_whole
from mgehl.run import save
from mgehl.solver.continuation import Continuation
from mgehl.solver.from_config import set_up
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax

STARTS = {"down": "film", "up": "contact"}
OTHER = {"down": "up", "up": "down"}

STEPS_OF_START = 2
"""Factor by which such a point may take more steps than others: there is no nearer one to try it from (513
nodes at 7.5 mm/s: 40)."""


@dataclass
class Point:
    """One speed on one branch."""

    speed: float
    branch: str
    solution: Solution
    origin: str
    """Of "start", "continued", "other branch", "other start"; "none" if unsolved."""
    sweep: list
    """e^p, e^p lubr. and e^p solid of one sweep of the paper's relaxation from here  [Liu eq. 45]."""
    obstacle: str
    """Why the way that was tried first did not lead to it; empty where it did."""

    @property
    def result(self):
        return self.solution.result

    @property
    def fields(self):
        """On rank 0."""
        return self.solution.fields


class Branches:
    """Both branches of one configuration's contact; a context manager, which frees the grids."""

    def __init__(self, study, tables):
        case = case_of(study.config(tables))
        self._study, self._config = study, case.config
        self._parts = set_up(case)
        self.contact, self.mesh = self._parts.contact, self._parts.mesh
        self._settings = self._parts.settings
        self._hierarchy = None
        self.name = f"{self.mesh.nx} nodes, {self._parts.settings.scheme.face_mobility} mean"
        """As a title has it."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._hierarchy:
            self._hierarchy.destroy()

    def walk(self, branch, speeds, beside=()):
        """The points of a branch; `speeds` fast to slow for "down", slow to fast for "up".

        `beside` holds points of the other branch, from which this one goes on where it ends.
        """
        points = []
        for count in range(1, len(speeds) + 1):
            settled = [point for point in points if point.result.settled]
            points.append(self._point(branch, speeds[:count], settled[-1] if settled else None, beside))
        return points

    def _point(self, branch, way, last, beside):
        """The point at the last speed of the `way` along a branch, from disk or from point `last`."""
        study, speed = self._study, way[-1]
        title = f"{self.mesh.nx} nodes, {branch}, {1e3 * speed:.4g} mm/s"
        path, config = study.path_of(title, self._all(branch, way, beside)), self._at(speed)
        if not study.has(path, config):
            found, told = self._find(config, self._ways(branch, speed, last, beside))
            on_first_rank(study.comm, _keep, path, found, told)
        told = study.comm.bcast(on_first_rank(study.comm, _told, path))
        point = Point(speed, branch, study.read(path), **told)
        study.tell(title, point.result)
        return point

    def _all(self, branch, way, beside):
        """Everything on which the answer at the end of the `way` depends."""
        tables = {name: table for name, table in self._config.as_toml_tables().items() if name != "motion"}
        return [tables, branch, [float(speed) for speed in way], len(beside)]

    def _at(self, speed):
        return self._config.with_({"motion.speed": float(speed)})

    def _find(self, config, ways):
        """Solve one point by whatever of the `ways` leads to it: its `Solution`, and what else is told."""
        started, before = time.perf_counter(), self._grids.convolutions
        tried = []
        for origin, solve in ways:
            tried.append((origin, *solve()))
            if tried[-1][-1].converged:
                break
        origin, problem, outcome = tried[-1]
        if not outcome.converged:
            _, problem, outcome = tried[0]
            origin = "none"
        # Why the branch could not be followed belongs to the point.
        first = tried[0][-1]
        outcome.contradictions = first.contradictions
        obstacle = "" if first.converged else first.reason
        work = Work(self._grids.convolutions - before, len(outcome.cycles) - 1)
        result, errors = self._judged(problem, outcome, work, time.perf_counter() - started)
        solution = self._solution(config, problem, outcome, result)
        return solution, {"origin": origin, "sweep": errors, "obstacle": obstacle}

    def _solution(self, config, problem, outcome, result):
        """With whole fields on rank 0 (collective)."""
        state, nm = outcome.state, 1e9 * problem.contact.film_scale
        whole = Fields(state.P, state.H, state.status, state.p, state.filling).gathered(problem.grid)
        rows = [{"grid": self.mesh.nx} | newton_row(cycle, nm) for cycle in outcome.cycles]
        return Solution(config, problem.contact, self.mesh, whole, rows, result, state.H0)

    def _ways(self, branch, speed, last, beside):
        """(Name, function) of what may lead to a point, the best first."""
        if last:
            yield "continued", lambda: self._follow(last, speed)
        else:
            yield "start", lambda: self._continuation(STEPS_OF_START).begin(speed, STARTS[branch])
        near = [point for point in beside if point.result.settled]
        if near:
            nearest = min(near, key=lambda point: abs(np.log(point.speed / speed)))
            yield "other branch", lambda: self._follow(nearest, speed)
        yield "other start", lambda: self._continuation().begin_beyond(speed, STARTS[OTHER[branch]])

    def _follow(self, point, speed):
        if point.speed == speed:
            return self._continuation().at(speed, self._state(point))
        return self._continuation().follow(self._state(point), point.speed, speed)

    def _judged(self, problem, outcome, work, wall):
        """The point that was found, with what a sweep of the paper's relaxation would change in it."""
        newton = self._settings.newton
        result = summarise(problem, outcome, newton.tolerance, work, wall, versions())
        once = RelaxationSettings(max_sweeps=0)
        sweep = relax(problem, outcome.state.copy(), once, lambda cycle: None).cycles[-1]
        return result, (sweep.e_p, sweep.e_p_fluid, sweep.e_p_solid)

    def _state(self, point):
        """The local part of a point's state."""
        grid, fields = self._grids.grids[-1], point.fields
        whole = list(fields.named.values()) if fields else 5 * [None]
        P, H, *others = map(grid.scatter, whole)
        return State(P, point.solution.H0, H, *others)

    @property
    def _grids(self):
        if self._hierarchy is None:
            self._hierarchy = self._parts.hierarchy(self._study.comm)
        return self._hierarchy

    def _continuation(self, patience=1):
        """With `patience` times the steps that the settings allow."""
        newton = self._settings.newton
        newton = replace(newton, max_steps=patience * newton.max_steps)
        return Continuation(self._grids, self.contact, replace(self._settings, newton=newton))


def _keep(path, solution, told):
    """Leave the run directory of a point; a kill leaves none that has finished without what is `told`."""
    make_directory(path, True)
    write_whole(path / POINT, json.dumps(told) + "\n")
    save(solution, path, picture=False)


def _told(path):
    return json.loads((path / POINT).read_text())
