"""What is written down while a run in time goes on: its rows, its series on disk, its frames."""

import time

from mgehl.errors import one_line
from mgehl.output.files import CHECKPOINT, SERIES, on_first_rank
from mgehl.output.frames import Frames
from mgehl.output.series import have_settled, row_of, title_of, write_series
from mgehl.saying import complain
from mgehl.solver.pace import JUST

UNSETTLED = "all steps in time settled, mean gap and load on solids have not: give a later time.end"
"""What is said of a run that time.end cut short."""

FRAMES_OF_A_RUN = 50
"""Frames where time.save_every is not given."""


class Diary:
    """Told of each step by a `March` (collective)."""

    def __init__(self, case, frame, grid, progress, watch):
        self._config, self._frame, self._grid = case.config, frame, grid
        self._progress, self._watch, self._written = progress, watch, time.monotonic()
        self._scene = case.scene
        self._units = case.contact.pressure_scale, case.contact.in_frame(frame).film_scale
        keys, folder = case.config.time, watch.directory and watch.directory / CHECKPOINT
        self.frames = Frames(keys.save_every or keys.end / FRAMES_OF_A_RUN, folder)
        """Of the instants that are kept, in the user's axes."""

    def __call__(self, instant, standing, problem):
        """Write a step down; return why the run ends with it, in words, or "" """
        progress, keys = self._progress, self._config.time
        row = row_of(instant, standing, problem, self._scene, progress.convolutions, progress.seconds)
        progress.take(row, progress.seconds * (keys.end - instant.t) / instant.t)
        if self.frames.is_due(instant.t, instant.step):
            self._take_frame(instant.t, standing.state, problem.heights)
        self._write_series()
        if keys.until != "settled":
            return ""
        if have_settled(progress.rows, self._scene):
            return "mean gap and load on solids over passages have settled"
        return UNSETTLED if instant.t >= keys.end * (1.0 - JUST) else ""

    def _take_frame(self, t, state, heights):
        """Keep the fields of an instant in the user's axes and units; `heights` in m, or None."""
        Pa, m = self._units
        fields = {"pressure": Pa * state.P, "film": m * state.H, "fluid_pressure": Pa * state.p,
                  "filling": state.full_part, "heights": heights, "status": state.status}  # fmt: skip
        whole = {name: self._grid.gather(each) for name, each in fields.items() if each is not None}
        if whole["film"] is not None:
            kinds = {"status": "i1"}
            self.frames.take(t, {
                name: self._frame.users_array(each).astype(kinds.get(name, "f4"))
                for name, each in whole.items()
            })  # fmt: skip

    def _write_series(self):
        """series.nc as far as it goes, now and then."""
        watch, grid = self._watch, self._grid
        due = grid.max([time.monotonic() - self._written]) >= watch.save_every
        if watch.directory and due:
            path, rows = watch.directory / SERIES, self._progress.rows
            on_first_rank(grid.comm, _written, path, rows, title_of(self._config))
            self._written = time.monotonic()


class Comparison:
    """Told of each step of a march beside the run's, until the end of that: its `rows` are not written."""

    def __init__(self, scene, end, progress):
        self._scene, self._end, self._progress = scene, end, progress
        self._begun = progress.seconds
        self.rows = []

    def __call__(self, instant, standing, problem):
        """Note a step; return why the march ends with it, in words, or "" """
        progress = self._progress
        row = row_of(instant, standing, problem, self._scene, progress.convolutions, progress.seconds)
        self.rows.append(row)
        progress.tell(row, (progress.seconds - self._begun) * (self._end - instant.t) / instant.t)
        return "as far as the run" if instant.t >= self._end * (1.0 - JUST) else ""


def _written(path, rows, title):
    """Write the series; where that fails a message says so, and the run goes on."""
    try:
        write_series(path, rows, title)
    except OSError as error:
        complain(f"{path}: cannot be written: {one_line(error)}; the run goes on")
