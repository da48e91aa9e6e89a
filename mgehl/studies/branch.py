"""A contact followed in speed on one grid, every point on disk before the next begins.

    down  from the fastest speed and a full film
    up    from the slowest speed and full contact

A branch ends where no state near the last one solves the equations at the next speed. Then the point is
taken from the other branch, or from the other start, and says so.
"""

import time
from dataclasses import dataclass, fields, replace

import numpy as np

from mgehl.kinds import case_of
from mgehl.output.files import plain_result
from mgehl.output.result import Work
from mgehl.output.solution import Fields
from mgehl.output.stored import arrays_of, fields_from, result_from
from mgehl.output.summary import summarise
from mgehl.output.surroundings import versions
from mgehl.solver.continuation import Continuation
from mgehl.solver.from_config import set_up
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax
from mgehl.studies.cache import key_of

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
    origin: str
    """Of "start", "continued", "other branch", "other start"; "none" if unsolved."""
    result: object
    fields: Fields | None
    """On rank 0."""
    H0: float
    sweep: tuple
    """e^p, e^p lubr. and e^p solid of one sweep of the paper's relaxation from here  [Liu eq. 45]."""
    obstacle: str
    """Why the way that was tried first did not lead to it; empty where it did."""

    def shared(self):
        """What every rank knows."""
        return replace(self, fields=None)

    def record(self):
        """(Plain data, arrays) of it; on the rank that has the fields."""
        values = {each.name: getattr(self, each.name) for each in fields(self) if each.name != "fields"}
        return values | {"result": plain_result(self.result)}, arrays_of(self.fields)


class Branches:
    """Both branches of one configuration's contact; a context manager, which frees the grids."""

    def __init__(self, study, tables):
        self._config = config = study.config(tables)
        self._study, self._tables = study, config.as_toml_tables()
        self._parts = set_up(case_of(config))
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
        key = self._key(branch, way, beside)
        point = self._study.cache.load(key, self._point_from)
        if point is None:
            point = self._find(branch, way[-1], self._ways(branch, way[-1], last, beside))
            self._study.cache.store(key, point.record)
        self._study.tell(f"{self.mesh.nx} nodes, {branch}, {1e3 * way[-1]:.4g} mm/s", point.result)
        return point

    def _point_from(self, plain, arrays):
        """The `Point` of which `record` made these."""
        found = fields_from(arrays)
        if found.P.shape != (self.mesh.ny, self.mesh.nx):
            raise ValueError("its fields are not of this grid")
        result = result_from(plain["result"])
        return Point(**plain | {"result": result, "sweep": tuple(plain["sweep"]), "fields": found})

    def _key(self, branch, way, beside):
        """Everything on which the answer at the end of the `way` depends."""
        tables = {name: table for name, table in self._tables.items() if name != "motion"}
        return key_of([tables, branch, [float(speed) for speed in way], len(beside)])

    def _find(self, branch, speed, ways):
        """Solve one point by whatever of the `ways` leads to it."""
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
        state = outcome.state
        fields = Fields(state.P, state.H, state.status, state.p, state.filling).gathered(problem.grid)
        return Point(speed, branch, origin, result, fields, outcome.state.H0, errors, obstacle)

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
        return State(P, point.H0, H, *others)

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
