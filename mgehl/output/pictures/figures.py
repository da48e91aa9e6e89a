"""Every picture of a finished run, by name: for the command line, reports and notebooks.

`figures(read_run(directory))` yields them, `write` saves them; for another look call both under
`style.applied`. `run_picture` is the one that a run leaves.
"""

from collections.abc import Sequence
from functools import partial
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from mgehl.errors import UserError
from mgehl.output.pictures import lines, maps, style, wedge_picture
from mgehl.output.pictures.comparison import compare_histories, compare_lines
from mgehl.output.pictures.history import history
from mgehl.output.pictures.over_time import over_time
from mgehl.output.pictures.surface import surface_picture
from mgehl.output.pictures.titles import gap_words, labels, title_with_films
from mgehl.output.solution import Solution


class Picture(NamedTuple):
    """A figure, the `name` of its files and what it shows, in a few words."""

    name: str
    title: str
    figure: Figure


_POINT = {
    "lines": ("pressure and film on the centre lines, against the dry contact", lines.centre_lines),
    "film": ("film thickness, with contact, and cavities by how full they are", maps.film_map),
    "pressure": ("pressure, with contact outlined", maps.pressure_map),
    "status": ("status of the nodes", maps.status_map),
    "history": ("how the run converged", history),
}
"""Pictures of a point contact, in order: the kind, what it shows, the function that draws it."""
_GAP = "pressure and gap on the centre lines, against the contact of smooth bodies"
_DRY = {"lines": (_GAP, lines.centre_lines), "gap": ("gap, with contact", maps.film_map)}
_OF_FRICTION = {
    "shear": ("shear stress by sliding, with contact outlined", maps.shear_map),
    "flash_1": ("flash temperature of body 1", partial(maps.flash_map, 1)),
    "flash_2": ("flash temperature of body 2", partial(maps.flash_map, 2)),
}
"""Pictures of fields that a run may have, by the field."""
_ROUGH = {"surface": ("heights of the surface with contact, the gap, their distribution", surface_picture)}
_IN_TIME = {"time": ("films, pressure and shares of the load over time", over_time)}
_BEARING = {
    "lines": ("pressure on the centre line", wedge_picture.centre_line),
    "pressure": ("pressure, the solid in grey", wedge_picture.pressure_picture),
    "status": _POINT["status"],
    "history": _POINT["history"],
}
_FLAT = {"film", "gap", "pressure", "status", *_OF_FRICTION}
"""Maps, which a single line has not."""


def drawn_by(solution):
    """Title and function of each picture of a run, by kind: a single line has no maps."""
    drawn = _POINT | (_ROUGH if solution.contact.is_loaded and solution.contact.surface is not None else {})
    if not solution.contact.is_loaded:
        drawn = _BEARING
    elif solution.is_dry:
        drawn = _DRY | {kind: drawn[kind] for kind in drawn if kind not in ("lines", "film")}
    if solution.config.is_in_time:
        steps = _IN_TIME if solution.rows else {}
        drawn = steps | {kind: each for kind, each in drawn.items() if kind != "history"}
    drawn = drawn | {kind: each for kind, each in _OF_FRICTION.items() if kind in solution.fields.named}
    return {kind: each for kind, each in drawn.items() if not (solution.mesh.is_line and kind in _FLAT)}


def figures(solution: Solution, kinds: Sequence[str] | None = None) -> list[Picture]:
    """A list of `Picture`s of a run with whole fields: of these kinds, or all that it has. Raises UserError
    for a kind that this contact does not have."""
    known = drawn_by(solution)
    for kind in kinds or ():
        if kind not in known:
            raise UserError(f"no picture {kind!r} of this contact: it has {', '.join(known)}")
    with style.applied():
        drawn = ((kind, *known[kind]) for kind in kinds or known)
        return [Picture(kind, title, draw(solution)) for kind, title, draw in drawn]


def compared(solutions: Sequence[Solution], names: Sequence[str]) -> list[Picture]:
    """A list of two `Picture`s that show several runs of one kind of contact, called by `names`. Raises
    UserError where their contacts are of different kinds."""
    said = labels(solutions, names)
    with style.applied():
        centre, histories = compare_lines(solutions, said), compare_histories(solutions, said)
    return [
        Picture("compare-lines", "pressure and film on the centre lines of all runs", centre),
        Picture("compare-history", "how the runs converged", histories),
    ]


def write(
    pictures: Sequence[Picture], directory: str | PathLike, formats: Sequence[str] = ("png", "pdf")
) -> list[Path]:
    """Write `Picture`s as directory/NAME.FORMAT, pictures of the same name replaced; return the paths."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    paths = [(each, directory / f"{each.name}.{form}") for each in pictures for form in formats]
    with style.applied():
        for picture, path in paths:
            style.save(picture.figure, path)
    return [path for _, path in paths]


def run_picture(solution):
    """The picture of a `Solution`'s whole-grid fields, as the bytes of a PNG file."""
    with style.applied():
        figure = _loaded(solution) if solution.contact.is_loaded else wedge_picture.picture(solution)
        return style.rendered(figure, "png")


def _loaded(solution):
    panels = 1 if solution.mesh.is_line else 3
    figure = Figure(figsize=(1.5 + 4.1 * panels, 5.2), layout="constrained")
    above, below = ["p along", "p across"], ["h along", "h across"]
    axes = figure.subplot_mosaic([[*above, "map"][:panels], [*below, "map"][:panels]])
    rows = np.array([[axes[name] for name in row if name in axes] for row in (above, below)])
    handles = lines.draw_lines(rows, solution)
    if "map" in axes:
        handles += maps.draw_film(axes["map"], solution, style.SMALL)
        axes["map"].set_title(gap_words(solution.contact)[0])
    style.legend_under_all(figure, handles)
    figure.suptitle(title_with_films(solution))
    return figure
