"""A run in time as a movie: the film on the whole plane, pressure and film along the motion."""

from pathlib import Path

import numpy as np
from matplotlib import animation
from matplotlib.colors import LogNorm
from matplotlib.ticker import LogLocator

from mgehl.errors import UserError
from mgehl.output.pictures import style
from mgehl.output.pictures.style import FILM, PRESSURE

SECOND = 10
"""Frames in a second."""

DOTS = 100
"""To the inch."""

THINNEST, WIDEST = 1.0, 3.0
"""Film in nm at which the colours begin at the least; the largest on the axis over the largest inside."""

SHOWN = 1.7
"""Semi-axes from the centre that are shown."""


def write_movie(solution, folder):
    """Draw `movie.mp4` into a folder, or `movie.gif` where ffmpeg is not there; return its path.

    Raises UserError where the run has no frames.
    """
    if solution.frames is None:
        raise UserError("no movie of this run: it has no frames, as runs in time have (frames.nc)")
    folder.mkdir(parents=True, exist_ok=True)
    by_ffmpeg = animation.FFMpegWriter.isAvailable()
    writer = animation.FFMpegWriter(SECOND) if by_ffmpeg else animation.PillowWriter(SECOND)
    path = Path(folder) / f"movie.{'mp4' if by_ffmpeg else 'gif'}"
    with style.applied():
        stage = _Stage(solution, list(solution.frames.all()))
        with writer.saving(stage.figure, str(path), DOTS):
            for frame in stage.frames:
                stage.show(*frame)
                writer.grab_frame()
    return path


class _Stage:
    """The figure, and what in it changes from frame to frame."""

    def __init__(self, solution, frames):
        self._solution, self._contact, self.frames = solution, solution.contact, frames
        self._films = self._least_and_most()
        plane = not solution.mesh.is_line
        self.figure, axes = style.subplots(1, 1 + plane, size=(6.0 + 5.0 * plane, 4.6), squeeze=False)
        self.figure.get_layout_engine().set(w_pad=0.2, h_pad=0.1)
        self._x, self._y = 1e3 * solution.x, 1e3 * solution.y
        self._image = self._map(axes[0, 0]) if plane else None
        self._lines = self._centre_lines(axes[0, -1])

    def _least_and_most(self):
        """Of all films within the Hertz contact, in nm."""
        solution, contact = self._solution, self._contact
        across = 0.0 if solution.mesh.is_line else solution.y[:, None] / contact.y_scale
        inside = np.hypot(solution.x / contact.x_scale, across) <= 1.0
        films = [
            1e9 * fields["film"][np.broadcast_to(inside, fields["film"].shape)] for _, fields in self.frames
        ]
        return max(min(film.min() for film in films), THINNEST), max(film.max() for film in films)

    def _map(self, axes):
        ends = self._x[0], self._x[-1], self._y[0], self._y[-1]
        norm = LogNorm(*self._films)
        image = axes.imshow(1e9 * self.frames[0][1]["film"], extent=ends, origin="lower", norm=norm)
        steps = LogLocator(subs=(1.0, 2.0, 5.0))
        bar = self.figure.colorbar(image, ax=axes, label="film, nm", format="%g", ticks=steps, extend="max")
        bar.minorticks_off()
        half = [SHOWN * 1e3 * scale for scale in (self._contact.x_scale, self._contact.y_scale)]
        axes.set(xlabel="x, mm", ylabel="y, mm")
        axes.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]))
        return image

    def _centre_lines(self, axes):
        beside = axes.twinx()
        (p,) = axes.plot(self._x, np.zeros(self._x.size), color=PRESSURE)
        (h,) = beside.plot(self._x, np.ones(self._x.size), color=FILM)
        largest = max(fields["pressure"].max() for _, fields in self.frames)
        least, most = self._films
        half = SHOWN * 1e3 * self._contact.x_scale
        axes.set(xlabel="x, mm", ylabel="pressure, GPa")
        axes.set(xlim=(-half, half), ylim=(0.0, 1.05e-9 * largest))
        beside.set(ylabel="film, nm", yscale="log", ylim=(0.7 * least, WIDEST * most))
        beside.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        beside.yaxis.set_major_formatter("{x:g}")
        beside.yaxis.set_minor_formatter("")
        axes.yaxis.label.set_color(PRESSURE)
        beside.yaxis.label.set_color(FILM)
        return p, h

    def show(self, t, fields):
        """Let the figure be that of an instant."""
        middle = self._solution.mesh.nearest(0.0, 0.0)[1]
        if self._image is not None:
            self._image.set_data(1e9 * fields["film"])
        for line, values in zip(
            self._lines, (1e-9 * fields["pressure"], 1e9 * fields["film"]), strict=True
        ):
            line.set_ydata(values[middle])
        self.figure.suptitle(f"{1e3 * t:.4g} ms")
