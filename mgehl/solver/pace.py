"""How long the next step in time is: by the cells that surfaces go in it, and by its error."""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, inf, sqrt

import numpy as np

from mgehl.model.course import ROUNDED

MOST_CELLS, MOST_CELLS_ROUGH = 4.0, 1.0
"""Cells that the surfaces go in a step at the most: smooth ones, and those whose heights move."""

FIRST_STEPS = 200
"""Steps that a run is expected to take where nothing moves."""

COUNTED = 1000
"""Steps that are counted before a run; after these the run is taken to need as many a second."""

FIRST_CHANGE = 0.1
"""Part by which a gap may change in the first step between surfaces that stand still."""

AIM = 2e-3
"""Rms of what a step's pressures differ from a straight line in time, over their own rms."""

GROWTH, LEAST_GROWTH = 1.5, 0.3
"""Of a step over the one before: more is unstable by the second backward formula (2.4), or seldom right."""

STRAIGHT = 0.05
"""Part of its range by which speed, load or angle may leave a straight line within a step: a wave has seven
steps."""

MOST_CHANGE = 0.25
"""Part of its range by which speed, load or angle may change in a step, however straight: where heights
move, pressures tell no error."""

SHORTEST, SHORTEST_PART = 1e-3, 1e-4
"""The shortest step by which a kink or a jump is met, the smaller of two: in cells that the fastest
surfaces go, and as a part of the run."""

HALVINGS = 10
"""Times that a step is halved before a run is given up."""

JUST = 1e-9
"""Part of a step by which times may be off."""


@dataclass
class Pace:
    """Chooses steps in s; `fixed` is the one that was asked for, None where none was."""

    scene: object
    mesh: object
    fixed: float | None

    @property
    def _most_cells(self):
        if self.fixed:
            return self.scene.most_asked
        return MOST_CELLS_ROUGH if self.scene.moves else MOST_CELLS

    @property
    def first_change(self):
        """Part by which a gap may change in the first step: where nothing moves, no cell bounds it. None
        elsewhere."""
        return FIRST_CHANGE if self.scene.stands and not self.fixed else None

    @property
    def _shortest(self):
        return min(SHORTEST * self.scene.unit * self.mesh.dX, SHORTEST_PART * self.scene.end)

    def first(self):
        """The first step in s."""
        return self.fixed or min(self.scene.end / FIRST_STEPS, self.scene.unit * self.mesh.dX)

    def next(self, _t, before, error, halved):
        """The step after one of `before` s that had an `error`, and was `halved` or not."""
        if self.fixed:
            return min(2.0 * before, self.fixed)
        if self.scene.moves:
            return GROWTH * before
        wanted = sqrt(AIM / error) if error > 0.0 else inf
        growth = 1.0 if halved else GROWTH
        return min(max(before * max(LEAST_GROWTH, wanted), self._shortest), growth * before)

    def fitted(self, t, step):
        """As much of a step as time is left, as surfaces may go cells, and as speed, load and angle go
        straight on and change little: what happens within a step is not seen. It ends at a kink if there is
        one."""
        left, step = self.scene.end - t, self._in_cells(t, step)
        nearest = self._end(t, left, step)
        while (step := min(step, nearest)) > self._shortest and self._is_long(t, t + step):
            step = max(0.5 * step, self._shortest)
        if step >= nearest * (1.0 - JUST):
            return nearest
        # No crumb is left over.
        return 0.5 * nearest if step > 0.6 * nearest else step

    def _is_long(self, begin, end):
        """Whether speed, load or angle bend or change too much between two times."""
        scene = self.scene
        return scene.bend(begin, end) > STRAIGHT or scene.change(begin, end) > MOST_CHANGE

    def _end(self, t, left, step):
        """The kink, or the end of the run, that a step may end at: of those within it the last up to which
        all goes straight on, else the next one."""
        end, kinks = self.scene.end, self._kinks - t
        # The end of a table may be that of the run but for rounding.
        within = (kinks > max(self._shortest, JUST * end)) & (kinks < left - ROUNDED * end)
        ends = [*kinks[within].tolist(), left]
        reached = ends[: bisect_right(ends, step)]
        straight = bisect_right(reached, STRAIGHT, key=lambda each: self.scene.bend(t, t + each))
        return ends[max(straight - 1, 0)]

    @cached_property
    def _kinks(self):
        return np.unique(self.scene.kinks())

    def _in_cells(self, t, step):
        """A step in which the surfaces go no more cells than they may, a whole number where they go more
        than one."""
        for _ in range(3):
            way, then = self.scene.way(t, t + step), min(t + step, self.scene.end)
            share = self.scene.fastest(way, self.mesh) / self._most_cells
            share = max(share, self._mean(way) / self.scene.most_in_inlet(then, self.mesh))
            if share <= 1.0 + JUST:
                break
            step /= share
        if self.fixed:
            return step
        cells = self._mean(self.scene.way(t, t + step))
        return step * int(cells + JUST) / cells if cells > 1.0 else step

    def _mean(self, way):
        """Cells that the mean surface goes by a way."""
        return self.scene.most_cells(way, self.mesh)


class Retraced:
    """The steps of a march that has ended, two at a time, but for kinks: those of a comparison."""

    first_change = None

    def __init__(self, times, scene):
        """`times` are the ends of its steps in s. A kink that was the end of one is met where speed, load
        or angle bend much: others are rows of something smooth."""
        self._crumb, kinks = JUST * times[-1], np.array(scene.kinks())
        ends = {*times[1::2], times[-1]}
        for begin, middle, end in zip([0.0, *times[1::2]], times[::2], times[1::2], strict=False):
            is_kink = kinks.size and np.abs(kinks - middle).min() <= self._crumb
            if is_kink and scene.bend(begin, end) > STRAIGHT:
                ends.add(middle)
        self._times = sorted(ends)

    def first(self):
        """The first step in s."""
        return self.next(0.0)

    def next(self, t, *_):
        """The step at a time `t`."""
        return next((each - t for each in self._times if each > t + self._crumb), 0.0)

    def fitted(self, _t, step):
        """That step."""
        return step


def expected_steps(scene, mesh, fixed=None):
    """Steps that a `Scene` will take on a mesh, if none is halved. What smooth bodies' pressures ask for is
    not known before: a cell each is a guess."""
    pace, t, taken = Pace(scene, mesh, fixed), 0.0, 0
    step = pace.first()
    while t < scene.end * (1.0 - JUST) and taken < COUNTED:
        fitted = pace.fitted(t, step)
        t, taken = t + fitted, taken + 1
        step = pace.next(t, fitted, 0.0, False)
    steps = ceil(taken * scene.end / t)
    if fixed or scene.moves:
        return steps
    times = [scene.end * part / FIRST_STEPS for part in range(FIRST_STEPS + 1)]
    cells = sum(scene.most_cells(scene.way(*ends), mesh) for ends in pairwise(times))
    return max(steps, int(cells), FIRST_STEPS // 4)
