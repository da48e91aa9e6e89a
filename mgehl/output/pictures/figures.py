"""Every picture of a finished run, by name: for the command line, reports and notebooks.

    for picture in figures(read_run("runs/point_contact")):
        print(picture.name, picture.title)

`draw_all` saves them at once. For another look call both under `style.applied("my.mplstyle")`.
"""

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure

from mgehl.errors import UserError
from mgehl.output.pictures import style, wedge_picture
from mgehl.output.pictures.comparison import compare_histories, compare_lines
from mgehl.output.pictures.history_picture import history
from mgehl.output.pictures.labels import labels
from mgehl.output.pictures.lines import centre_lines
from mgehl.output.pictures.maps import film_map, gap_map, pressure_map, status_map
from mgehl.output.pictures.surface_picture import surface_picture
from mgehl.output.solution import Solution


class Picture(NamedTuple):
    """A figure, the `name` of its files and what it shows, in a few words."""

    name: str
    title: str
    figure: Figure


TITLES = {
    "lines": "pressure and film on the centre lines, against the dry contact",
    "film": "film thickness, with contact and cavitation outlined",
    "pressure": "pressure",
    "status": "status of the nodes",
    "history": "how the run converged",
}
"""The kinds of pictures, in order, and what they show."""

DRY_TITLES = {
    "lines": "pressure and gap on the centre lines, against the contact of smooth bodies",
    "gap": "gap, with contact outlined",
}
"""Pictures that are others without a fluid, or show something else."""

ROUGH = {"surface": "heights of the surface with the contact on them, the gap, their distribution"}
"""Pictures that bodies with a surface have besides."""

_POINT = {
    "lines": centre_lines,
    "film": film_map,
    "pressure": pressure_map,
    "status": status_map,
    "history": history,
}
_DRY = {("gap" if kind == "film" else kind): draw for kind, draw in _POINT.items()} | {"gap": gap_map}
_LINE = {"lines": centre_lines, "history": history}
_BEARING = {
    "lines": wedge_picture.centre_line,
    "pressure": wedge_picture.pressure_picture,
    "status": status_map,
    "history": history,
}
_BEARING_LINE = {name: _BEARING[name] for name in ("lines", "history")}


def drawn_by(solution):
    """The functions that draw a run, by kind of picture: a single line has no maps.

    A surface is left out where its file is not there any more: what is done can be looked at without.
    """
    found = _possible(solution)
    if "surface" in found:
        try:
            solution.contact.surface.height(0.0, 0.0)
        except UserError:
            del found["surface"]
    return found


def _possible(solution):
    """The functions that draw such a contact."""
    if not solution.contact.is_loaded:
        return dict(_BEARING_LINE if solution.mesh.is_line else _BEARING)
    if solution.mesh.is_line:
        drawn = _LINE
    else:
        drawn = _DRY if solution.is_dry else _POINT
    return drawn | ({"surface": surface_picture} if solution.contact.surface is not None else {})


def title_of(kind, solution):
    """What a kind of picture of a run shows."""
    return (TITLES | ROUGH | (DRY_TITLES if solution.is_dry else {}))[kind]


def figures(solution: Solution, kinds: Sequence[str] | None = None) -> list[Picture]:
    """A list of `Picture`s of a run with whole fields: of these kinds, or all that it has.

    Raises UserError for a kind that this contact does not have.
    """
    draw = _possible(solution) if kinds else drawn_by(solution)
    for kind in kinds or ():
        if kind not in draw:
            raise UserError(f"no picture {kind!r} of this contact: it has {', '.join(draw)}")
    with style.applied():
        return [Picture(kind, title_of(kind, solution), draw[kind](solution)) for kind in kinds or draw]


def compared(solutions: Sequence[Solution], names: Sequence[str]) -> list[Picture]:
    """A list of two `Picture`s that show several runs of one kind of contact, called by `names`.

    Raises UserError where their contacts are of different kinds.
    """
    said = labels(solutions, names)
    with style.applied():
        lines, histories = compare_lines(solutions, said), compare_histories(solutions, said)
    return [
        Picture("compare-lines", "pressure and film on the centre lines of all runs", lines),
        Picture("compare-history", "how the runs converged", histories),
    ]


def draw_all(
    solution: Solution,
    directory: str | PathLike,
    formats: Sequence[str] = ("png", "pdf"),
    kinds: Sequence[str] | None = None,
) -> list[Path]:
    """Write all pictures of a run, or these `kinds`, as directory/KIND.FORMAT; return their paths.

    Raises UserError for a kind that this contact does not have, OSError where a file cannot be written.
    """
    pictures = figures(solution, kinds)
    return write(pictures, directory, formats)


def write(
    pictures: Sequence[Picture], directory: str | PathLike, formats: Sequence[str] = ("png", "pdf")
) -> list[Path]:
    """Write `Picture`s as directory/NAME.FORMAT, pictures of the same name replaced; return the paths."""
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    paths = []
    with style.applied():
        for picture in pictures:
            for form in formats:
                paths.append(directory / f"{picture.name}.{form}")
                style.save(picture.figure, paths[-1])
    return paths
