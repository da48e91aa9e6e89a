"""The look of all pictures: one style file, one place of colours, one way to save.

`mgehl.mplstyle` beside this module has fonts, sizes and the colours of lines. Figures are drawn and
saved under `applied`: matplotlib asks for the style of a tick only when it draws it.
"""

import io
import logging
import os
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import resources
from math import ceil
from pathlib import Path

import matplotlib
import matplotlib.style
from matplotlib.figure import Figure

from mgehl.errors import UserError
from mgehl.output.whole_file import whole_file

COLOURS = tuple(f"C{k}" for k in range(7))
"""The style's colours of lines, in order: what is compared takes them one after the other."""
MARKS = ("o", "s", "^", "v", "D", "<", ">")
PRESSURE, FILM = COLOURS[:2]
HERTZ, GUIDE, SOLID = "0.2", "0.8", "0.45"
"""Greys of the dry contact, of lines to guide the eye and of a wedge's pillar."""
CONTACT_COLOUR = "#D55E00"
"""Contact on the maps, and its outline."""
STATUS_COLOURS = ("0.85", "#56B4E9", "#F0E442", CONTACT_COLOUR, "#222222")
"""Boundary, lubricated, cavitated, contact and overlap (Okabe and Ito)."""
HIDDEN = "0.88"
"""What is beyond the scale of a map."""
HANDLE, ROW = 8, 3
"""Width of a legend's line and height of its row, in letters."""
UNDER = 3.9
"""Height of an axis with its numbers and its name, in letters."""

LARGEST_STYLE = 10**6
"""Bytes of a style file."""

_UNDATED = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}

_decided = ContextVar("_decided", default=False)
"""Whether a style is applied."""


@contextmanager
def applied(overlay=None, dpi=None):
    """Draw and save in mgehl's style, with the style file `overlay` laid over it.

    Within another `applied` nothing changes: the outermost decides. Raises UserError if the file cannot
    be read or has a line that means nothing to matplotlib.
    """
    if _decided.get():
        yield
        return
    with resources.as_file(resources.files("mgehl.output.pictures") / "mgehl.mplstyle") as own:
        layers = [_read(own)]
    if overlay is not None:
        layers.append(_read(overlay))
    if dpi is not None:
        layers.append({"figure.dpi": dpi, "savefig.dpi": dpi})
    token = _decided.set(True)
    try:
        with matplotlib.style.context(layers):
            yield
    finally:
        _decided.reset(token)


def subplots(rows=1, columns=1, *, size, **options):
    """A new figure of `size` inches and its axes, as pyplot's but without pyplot's memory."""
    figure = Figure(figsize=size, layout="constrained")
    return figure, figure.subplots(rows, columns, **options)


def legend_below(axes, handles, columns=4):
    """The legend of one panel under the name of its axis."""
    axes.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), borderaxespad=UNDER, ncols=columns
    )


def legend_under_all(figure, handles):
    """The legend of a whole figure, in as few rows as it is wide for, below everything."""
    width, height = figure.get_size_inches()
    longest = max(len(each.get_label()) for each in handles)
    columns = max(1, min(len(handles), int(width / inches(HANDLE + longest))))
    room = inches(ROW) * (ceil(len(handles) / columns) + 0.5) / height
    figure.get_layout_engine().set(rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles=handles, loc="lower center", ncols=columns)


def inches(letters):
    """About as much as a text of so many letters takes."""
    return 0.6 * letters * matplotlib.rcParams["font.size"] / 72.0


def rendered(figure, form):
    """The bytes of a figure as "png", "svg" or "pdf"; call it under `applied`."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format=form, metadata=_UNDATED[form])
    return buffer.getvalue()


def save(figure, path):
    """Write a figure in the format of the path's ending, whole or not at all; under `applied`."""
    content = rendered(figure, Path(path).suffix[1:])
    with whole_file(path) as part:
        part.write_bytes(content)


def _read(path):
    """Settings of a style file; matplotlib only warns of lines that it does not know."""
    if os.path.exists(path) and not (os.path.isfile(path) and os.path.getsize(path) <= LARGEST_STYLE):
        raise UserError(f"{path}: cannot be read: is no file of at most {LARGEST_STYLE} bytes")
    complaints = _Complaints()
    logger = logging.getLogger("matplotlib")
    logger.addHandler(complaints)
    propagate, logger.propagate = logger.propagate, False
    try:
        settings = matplotlib.rc_params_from_file(path, fail_on_error=True, use_default_template=False)
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise UserError(f"{path}: no style of matplotlib: {_line(error)}") from None
    finally:
        logger.propagate = propagate
        logger.removeHandler(complaints)
    if complaints.lines:
        raise UserError(f"{path}: no style of matplotlib: {complaints.lines[0]}")
    return settings


class _Complaints(logging.Handler):
    """Collects what a reader warns of."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.lines = []

    def emit(self, record):
        self.lines.append(_line(record.getMessage().strip().splitlines()[0]))


def _line(text):
    return " ".join(str(text).split())[:160]
