"""A contact followed in speed on one grid, every point on disk before the next begins.

    down  from the fastest speed and a full film
    up    from the slowest speed and full contact

A branch ends where no state near the last one solves the equations at the next speed. Then the point is
taken from the other branch, or from the other start, and says so. A full film by another mean of the
mobility begins with the arithmetic mean's film at that speed, where that is known. On fine grids these two
are closer than films of neighbouring speeds.
"""

import time
from dataclasses import asdict, dataclass, fields, replace

import numpy as np

from mgehl.config import config_from_tables
from mgehl.output.result import Work, summarise
from mgehl.output.solution import Fields
from mgehl.output.solution_record import arrays_of, fields_from
from mgehl.output.stored import result_from
from mgehl.output.surroundings import versions
from mgehl.solver.continuation import Continuation
from mgehl.solver.from_config import set_up
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax
from mgehl.studies.cache import key_of
from mgehl.studies.study import PAPER, merged

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
    """Of "start", "continued", "arithmetic mean", "other branch", "other start"; "none" if unsolved."""
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
        plain = {each.name: getattr(self, each.name) for each in fields(self) if each.name != "fields"}
        return plain | {"result": asdict(self.result)}, arrays_of(self.fields)


class Branches:
    """Both branches of one configuration's contact; a context manager, which frees the grids."""

    def __init__(self, study, tables):
        self._config = config = config_from_tables(merged(PAPER, tables))
        self._study, self._tables = study, config.as_toml_tables()
        self._parts = set_up(config)
        self.contact, self.mesh = self._parts.contact, self._parts.mesh
        self._settings = self._parts.settings
        self._hierarchy = None
        self.name = f"{self.mesh.nx} nodes, {config.discretization.face_mobility} mean"
        """As a title has it."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._hierarchy:
            self._hierarchy.destroy()

    def walk(self, branch, speeds, beside=(), arithmetic=()):
        """The points of a branch; `speeds` fast to slow for "down", slow to fast for "up".

        `beside` holds points of the other branch, from which this one goes on where it ends. `arithmetic`
        holds those of the arithmetic mean, from which this mean's films begin.
        """
        points = []
        for count in range(1, len(speeds) + 1):
            settled = [point for point in points if point.result.settled]
            last = settled[-1] if settled else None
            other = film_at(speeds[count - 1], arithmetic)
            points.append(self.point(branch, speeds[:count], last, beside, jump=True, arithmetic=other))
        return points

    def bracket(self, branch, speeds, has_turned, precision):
        """The speeds between which `has_turned(point)` becomes true along a branch.

        (last without, first with), their ratio within 1 + `precision`; None for one that is not
        among `speeds`.
        """
        way, last, turned = [], None, None
        for speed in speeds:
            point = self.point(branch, [*way, speed], last)
            if has_turned(point):
                turned = point
                break
            last, way = point, [*way, speed]
        while last and turned and abs(np.log(last.speed / turned.speed)) > np.log1p(precision):
            middle = float(np.sqrt(last.speed * turned.speed))
            point = self.point(branch, [*way, middle], last)
            if has_turned(point):
                turned = point
            else:
                last, way = point, [*way, middle]
        return last, turned

    def point(self, branch, way, last, beside=(), jump=False, arithmetic=None):
        """The point at the last speed of the `way` along a branch, from disk or from point `last`."""
        key = self._key(branch, way, jump, beside, arithmetic)
        point = self._study.cache.load(key, self._point_from)
        if point is None:
            ways = self._ways(branch, way[-1], last, beside, jump, arithmetic)
            point = self._find(branch, way[-1], ways)
            self._study.cache.store(key, point.record)
        self._study.tell(f"{self.mesh.nx} nodes, {branch}, {1e3 * way[-1]:.4g} mm/s", point.result)
        return point

    def _point_from(self, plain, arrays):
        """The `Point` of which `record` made these."""
        found = fields_from(arrays)
        if found.P.shape != (self.mesh.ny, self.mesh.nx):
            raise ValueError("its fields are not of this grid")
        result = result_from(plain["result"], self._config)
        return Point(**plain | {"result": result, "sweep": tuple(plain["sweep"]), "fields": found})

    def _key(self, branch, way, jump, beside, arithmetic):
        """Everything on which the answer at the end of the `way` depends."""
        tables = {name: table for name, table in self._tables.items() if name != "motion"}
        turned = ["arithmetic mean"] if arithmetic else []
        return key_of([tables, branch, [float(speed) for speed in way], jump, len(beside), *turned])

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

    def _ways(self, branch, speed, last, beside, jump, arithmetic):
        """(Name, function) of what may lead to a point, the best first."""
        if arithmetic:
            yield "arithmetic mean", lambda: self._continuation.turn(speed, self._state(arithmetic))
        if not last:
            yield "start", lambda: self._continuation_of(STEPS_OF_START).begin(speed, STARTS[branch])
        else:
            yield "continued", lambda: self._follow(last, speed)
        near = [point for point in beside if point.result.settled]
        if near:
            nearest = min(near, key=lambda point: abs(np.log(point.speed / speed)))
            yield "other branch", lambda: self._follow(nearest, speed)
        if jump:
            yield "other start", lambda: self._continuation.begin_beyond(speed, STARTS[OTHER[branch]])

    def _follow(self, point, speed):
        if point.speed == speed:
            return self._continuation.at(speed, self._state(point))
        return self._continuation.follow(self._state(point), point.speed, speed)

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
        whole = fields.arrays if fields else 5 * [None]
        P, H, *others = map(grid.scatter, whole)
        return State(P, point.H0, H, *others)

    @property
    def _grids(self):
        if self._hierarchy is None:
            self._hierarchy = self._parts.hierarchy(self._study.comm)
        return self._hierarchy

    @property
    def _continuation(self):
        return self._continuation_of(1)

    def _continuation_of(self, patience):
        """With `patience` times the steps that the settings allow."""
        newton = self._settings.newton
        newton = replace(newton, max_steps=patience * newton.max_steps)
        return Continuation(self._grids, self.contact, replace(self._settings, newton=newton))


def film_at(speed, points):
    """The one of `points` at a speed that settled without contact; None if there is none."""
    for point in points:
        if point.speed == speed and point.result.settled and point.result.contact.area_fraction == 0.0:
            return point
    return None
