"""A run in time as a movie: the film on the whole plane, pressure and film along the motion."""

from pathlib import Path

import numpy as np
from matplotlib import animation
from matplotlib.colors import LogNorm
from matplotlib.ticker import LogLocator

from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.errors import UserError
from mgehl.kinds.kind import pressure_unit
from mgehl.output.pictures import style
from mgehl.output.pictures.style import FILM, PRESSURE, STATUS_MAP, STATUS_NORM
from mgehl.solver.verification import LOADED

SECOND = 10
"""Frames in a second."""

DOTS = 100
"""To the inch."""

THINNEST, WIDEST = 1.0, 3.0
"""Film in nm at which the colours begin at the least; the largest on the axis over the largest inside."""

SHOWN = 1.7
"""What is shown over the farthest from the centre that carries load in some frame, or Hertz's semi-axis."""


def write_movie(solution, folder):
    """Draw `movie.mp4` into a folder, or `movie.gif` where ffmpeg is not there; return its path. Raises
    UserError where the run has no frames."""
    if solution.frames is None:
        raise UserError("no movie of this run: it has no frames, as runs in time have (frames.nc)")
    folder.mkdir(parents=True, exist_ok=True)
    by_ffmpeg = animation.FFMpegWriter.isAvailable()
    writer = animation.FFMpegWriter(SECOND) if by_ffmpeg else animation.PillowWriter(SECOND)
    path = Path(folder) / f"movie.{'mp4' if by_ffmpeg else 'gif'}"
    with style.applied():
        frames = list(solution.frames.all())
        figure, show = _stage(solution, frames)
        with writer.saving(figure, str(path), DOTS):
            for frame in frames:
                show(*frame)
                writer.grab_frame()
    return path


def _stage(solution, frames):
    """The figure, and a function that makes it that of a frame."""
    plane, middle = not solution.mesh.is_line, solution.mesh.centre[1]
    largest = 1e-9 * max(fields["pressure"].max() for _, fields in frames)
    factor, unit = pressure_unit(largest)
    figure, axes = style.subplots(1, 1 + plane, size=(6.0 + 5.0 * plane, 4.6), squeeze=False)
    figure.get_layout_engine().set(w_pad=0.2, h_pad=0.1)
    films = _least_and_most(frames)
    images = _map(axes[0, 0], solution, frames, films) if plane else ()
    times, speeds = zip(*((row["time_s"], row["speed_mm_s"]) for row in solution.rows), strict=True)
    angles = [row["angle_deg"] for row in solution.rows if "angle_deg" in row]
    p, h = _centre_lines(axes[0, -1], solution, films)
    axes[0, -1].set(ylabel=f"pressure, {unit}", ylim=(0.0, 1.05 * factor * largest))
    axes[0, -1].set_xlim(*(side * next(halves(solution, frames)) for side in (-1.0, 1.0)))

    def show(t, fields):
        for image, data in zip(images, (1e9 * fields["film"], _no_film(fields)), strict=False):
            image.set_data(data)
        p.set_ydata(factor * 1e-9 * fields["pressure"][middle])
        h.set_ydata(1e9 * fields["film"][middle])
        towards = f" at {np.interp(t, times, angles):.3g}°" if angles else ""
        figure.suptitle(f"{1e3 * t:.4g} ms, {np.interp(t, times, speeds):.4g} mm/s{towards}")

    return figure, show


def _no_film(fields):
    """The status where it is cavity or contact, masked elsewhere."""
    return np.ma.masked_less(fields["status"], CAVITATED)


def _carries(fields):
    """The nodes that carry load."""
    return (fields["pressure"] > LOADED * fields["pressure"].max()) | (fields["status"] == CONTACT)


def halves(solution, frames):
    """Half of what is shown along x and y in mm."""
    loaded = np.any([_carries(fields) for _, fields in frames], axis=0)
    for axis, (line, hertz) in enumerate(
        ((solution.x, solution.contact.x_scale), (solution.y, solution.contact.y_scale))
    ):
        yield 1e3 * SHOWN * np.abs(line[loaded.any(axis=axis)]).max(initial=hertz)


def _least_and_most(frames):
    """Of all films that carry load, in nm."""
    films = [1e9 * fields["film"][_carries(fields)] for _, fields in frames]
    return max(min(film.min() for film in films), THINNEST), max(film.max() for film in films)


def _map(axes, solution, frames, films):
    """Images of the film, and of cavities and contact over it."""
    ends = [1e3 * line[k] for line in (solution.x, solution.y) for k in (0, -1)]
    place, first = {"extent": ends, "origin": "lower"}, frames[0][1]
    image = axes.imshow(1e9 * first["film"], norm=LogNorm(*films), **place)
    status = {"cmap": STATUS_MAP, "norm": STATUS_NORM, "interpolation": "nearest"}
    cover = axes.imshow(_no_film(first), **status, **place)
    steps = {"ticks": LogLocator(subs=(1.0, 2.0, 5.0)), "format": "%g", "extend": "max"}
    axes.figure.colorbar(image, ax=axes, label="film, nm", **steps).minorticks_off()
    x, y = halves(solution, frames)
    axes.set(xlabel="x, mm (pink: cavity, orange: contact)", ylabel="y, mm", xlim=(-x, x), ylim=(-y, y))
    return image, cover


def _centre_lines(axes, solution, films):
    beside, x = axes.twinx(), 1e3 * solution.x
    (p,) = axes.plot(x, np.zeros(x.size), color=PRESSURE)
    (h,) = beside.plot(x, np.ones(x.size), color=FILM)
    axes.set_xlabel("x, mm")
    beside.set(ylabel="film, nm", yscale="log", ylim=(0.7 * films[0], WIDEST * films[1]))
    beside.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    beside.yaxis.set_major_formatter("{x:g}")
    beside.yaxis.set_minor_formatter("")
    axes.yaxis.label.set_color(PRESSURE)
    beside.yaxis.label.set_color(FILM)
    return p, h
