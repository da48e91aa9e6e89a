"""The look of all pictures: one style file, one place of colours, one way to save.

`mgehl.mplstyle` beside this module has fonts, sizes and the colours of lines. Figures are drawn and
saved under `applied`: matplotlib asks for the style of a tick only when it draws it.
"""

import io
import os
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import resources
from pathlib import Path

import matplotlib
import matplotlib.style
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure

from mgehl.errors import UserError
from mgehl.output.whole_file import whole_file

COLOURS = tuple(f"C{k}" for k in range(7))
"""The style's colours of lines, in order: what is compared takes them one after the other."""
MARKS = ("o", "s", "^", "v", "D", "<", ">")
PRESSURE, FILM, FLUID = "C0", "C2", "C5"
"""Of lines: pressure, film or gap, and the fluid's own pressure under contact."""
HERTZ, GUIDE, SOLID = "0.2", "0.8", "0.45"
"""Greys of the dry contact, of lines to guide the eye and of a wedge's pillar."""
CONTACT_COLOUR, CAVITY_COLOUR = "#D55E00", "#CC79A7"
"""Contact and full cavities in every picture (Okabe and Ito)."""
STATUS_COLOURS = ("0.85", "#56B4E9", CAVITY_COLOUR, CONTACT_COLOUR, "#222222")
"""Boundary, lubricated, cavitated, contact and overlap."""
STATUS_MAP = ListedColormap(STATUS_COLOURS)
STATUS_NORM = BoundaryNorm([k - 0.5 for k in range(STATUS_MAP.N + 1)], STATUS_MAP.N)
FILLING_MAP = LinearSegmentedColormap.from_list("filling", ["white", CAVITY_COLOUR])
"""Cavities from empty to full."""
HIDDEN = "0.88"
"""What is beyond the scale of a map."""
SMALL = 350
"""Blocks of nodes along a side of a small map, about as many as it has dots."""
HANDLE, UNDER = 8, 3.9
"""Width of a legend's line, and height of an axis with its numbers and its name, in letters."""

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


def subplots(rows=1, columns=1, *, size, layout="constrained", **options):
    """A new figure of `size` inches and its axes, as pyplot's but without pyplot's memory."""
    figure = Figure(figsize=size, layout=layout)
    return figure, figure.subplots(rows, columns, **options)


def legend_below(axes, handles, columns=4):
    """The legend of one panel under the name of its axis."""
    axes.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), borderaxespad=UNDER, ncols=columns
    )


def legend_under_all(figure, handles):
    """The legend of a whole figure below it, each label once: what is saved is cut to what there is."""
    handles = list({each.get_label(): each for each in handles}.values())
    letters = max(len(each.get_label()) for each in handles) + HANDLE
    columns = max(1, int(120.0 * figure.get_figwidth() / matplotlib.rcParams["font.size"] / letters))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=columns)


def rendered(figure, form):
    """The bytes of a figure as "png", "svg" or "pdf", cut to what it shows; call it under `applied`."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format=form, metadata=_UNDATED[form], bbox_inches="tight")
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
    try:
        for line in map(str.strip, Path(path).read_text("utf-8").splitlines()):
            key, colon, _ = line.partition(":")
            if line and not line.startswith("#") and not (colon and key.strip() in matplotlib.rcParams):
                raise ValueError(f"it has no {line}")
        return matplotlib.rc_params_from_file(path, fail_on_error=True, use_default_template=False)
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise UserError(f"{path}: no style of matplotlib: {' '.join(str(error).split())[:160]}") from None
