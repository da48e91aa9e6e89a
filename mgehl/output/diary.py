"""What is written down while a run in time goes on: its rows, its series on disk, its frames."""

import time
from functools import partial

import numpy as np

from mgehl.errors import one_line
from mgehl.output.files import CHECKPOINT, SERIES, on_first_rank
from mgehl.output.frames import Frames
from mgehl.output.passages import have_settled
from mgehl.output.series import row_of, title_of, write_series
from mgehl.saying import complain

FRAMES_OF_A_RUN = 50
"""Frames where time.save_every is not given."""


class Diary:
    """Told of each step by a `March` (collective)."""

    def __init__(self, case, frame, grid, progress, watch):
        self._config, self._contact, self._frame = case.config, case.contact, frame
        self._problem_grid, self._progress, self._watch = grid, progress, watch
        self._length = 2e6 * case.scene.framed.x_scale
        self._title = title_of(case.config)
        self._written = time.monotonic()
        keys = case.config.time
        folder = watch.directory and watch.directory / CHECKPOINT
        self.frames = Frames(keys.save_every or keys.end / FRAMES_OF_A_RUN, folder)
        """Of the instants that are kept, in the user's axes."""

    def __call__(self, instant, standing, problem):
        """Write a step down; return why the run ends with it, in words, or "" """
        progress, config = self._progress, self._config
        row = row_of(instant, standing, problem, progress.convolutions, progress.seconds)
        left = progress.seconds * (config.time.end - instant.t) / instant.t
        progress.take(row, left)
        self._take_frame(instant, standing.state)
        self._write()
        if config.time.until == "settled" and have_settled(progress.rows, self._length):
            return "means over passages have settled"
        return ""

    def _take_frame(self, instant, state):
        contact = self._contact
        fields = {
            "pressure": partial(self._gathered, state.P, contact.pressure_scale, np.float32),
            "film": partial(self._gathered, state.H, self._film_scale, np.float32),
            "status": partial(self._gathered, state.status, 1, np.int8),
        }
        self.frames.take(instant.t, instant.step, fields)

    @property
    def _film_scale(self):
        return self._contact.in_frame(self._frame).film_scale

    def _gathered(self, array, scale, kind):
        """The whole array in the user's axes and units on rank 0, None elsewhere."""
        whole = self._problem_grid.gather(array)
        return None if whole is None else self._frame.users_array(scale * whole).astype(kind)

    def _write(self):
        """series.nc as far as it goes, now and then."""
        watch, grid = self._watch, self._problem_grid
        due = grid.max([time.monotonic() - self._written]) >= watch.save_every
        if watch.directory and due:
            path, rows = watch.directory / SERIES, self._progress.rows
            on_first_rank(grid.comm, _written, path, rows, self._title)
            self._written = time.monotonic()


def _written(path, rows, title):
    """Write the series; where that fails a message says so, and the run goes on."""
    try:
        write_series(path, rows, title)
    except OSError as error:
        complain(f"{path}: cannot be written: {one_line(error)}; the run goes on")
