"""A contact followed in speed on one grid, down from the fastest and a full film, up from the slowest and
full contact: each point is a run that starts from the one before. Where a branch ends, the point is taken
from the other branch, or from the other start, and says so."""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.output.result import Work
from mgehl.output.solution import Solution
from mgehl.solver.recipe import OTHER_SIDE

STARTS = {"down": "film", "up": "contact"}

STEPS_OF_START = 2
"""Factor by which such a point may take more steps: there is no nearer one to try it from."""

BEYOND = 8.0
"""Factor between the wanted speed and one at which the other start is far from the end of its branch."""

ONE_SWEEP = {"solver.method": "relaxation", "relaxation.max_sweeps": 1}


@dataclass
class Point:
    """One speed on one branch."""

    speed: float
    branch: str
    solution: Solution
    """With the work of all that was tried."""
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


class Branch:
    """A branch of the contact of nested tables: "down" or "up". `beside` holds points of the other branch,
    from which this one goes on where it ends."""

    def __init__(self, study, tables, name, beside=()):
        self._study, self._config, self._name = study, study.config(tables), name
        self._beside = [point for point in beside if point.result.settled]
        self._way = []

    def walk(self, speeds):
        """Its points; `speeds` fast to slow for "down", slow to fast for "up"."""
        points = []
        for speed in map(float, speeds):
            self._way.append(speed)
            settled = [point for point in points if point.result.settled]
            points.append(self._point(speed, settled[-1] if settled else None))
        return points

    def _point(self, speed, last):
        """The point at a speed, from point `last` if there is one, or by whatever way leads to it."""
        runs, first = {}, None
        for origin, solve in self._ways(speed, last):
            runs[origin] = solve()
            found, first = runs[origin][-1], first or runs[origin][-1]
            if _settled_there(found):
                break
        else:
            origin, found = "other start" if first.result.settled else "none", first
        row = self._run("sweep", speed, found, ONE_SWEEP).rows[0]
        solved = [each.result for way in runs.values() for each in way]
        work = Work(sum(each.work.convolutions for each in solved), found.rows[-1]["step"])
        # Why the branch could not be followed belongs to the point.
        result = replace(
            found.result, work=work, wall_s=sum(each.wall_s for each in solved),
            contradictions=first.result.contradictions,
        )  # fmt: skip
        self._study.tell(self._title(speed), result)
        sweep = [row[name] for name in ("e_p", "e_p_lubr", "e_p_solid")]
        obstacle = "" if _settled_there(first) else first.result.reason
        return Point(speed, self._name, replace(found, result=result), origin, sweep, obstacle)

    def _ways(self, speed, last):
        """(Name, function that returns runs, the last of this speed) of the ways to a point, best first."""
        if last:
            yield "continued", lambda: [self._run("continued", speed, last.solution)]
        else:
            steps = STEPS_OF_START * self._config.solver.max_steps
            keys = {"solver.start": STARTS[self._name], "solver.max_steps": steps}
            yield "start", lambda: [self._run("start", speed, keys=keys)]
        if self._beside:
            nearest = min(self._beside, key=lambda point: abs(np.log(point.speed / speed)))
            yield "other branch", lambda: [self._run("other branch", speed, nearest.solution)]
        yield "other start", lambda: self._from_beyond(speed)

    def _from_beyond(self, speed):
        """Runs from the other start: at a speed where that settles, and from there."""
        beyond, start = (speed / BEYOND, "contact") if self._name == "down" else (speed * BEYOND, "film")
        first = self._run("beyond", beyond, keys={"solver.start": start})
        return [first, self._run("other start", speed, first)] if _settled_there(first) else [first]

    def _run(self, how, speed, before=None, keys=()):
        """The `Solution` at a speed, from the one `before` if there is one, with some keys set anew."""
        config = self._config.with_({"motion.speed": speed} | dict(keys))
        depends = [config.as_toml_tables(), self._name, self._way, len(self._beside), how]
        return self._study.run(self._study.path_of(f"{self._title(speed)}, {how}", depends), config, before)

    def _title(self, speed):
        return f"{self._config.grid.nodes} nodes, {self._name}, {1e3 * speed:.4g} mm/s"


def _settled_there(solution):
    """Whether a run settled from the start that was asked for; else it is on the other branch."""
    result, start = solution.result, solution.config.solver.start
    return result.settled and result.recipe["begins"] != OTHER_SIDE[start]
