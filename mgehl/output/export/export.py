"""A run's fields in the formats of other programs, each file whole or not there at all."""

from pathlib import Path

import numpy as np

from mgehl.discretization.status import NAMES
from mgehl.errors import OutputError, UserError
from mgehl.output.export.arrays import write_csv, write_npz
from mgehl.output.export.further import further_fields
from mgehl.output.export.netcdf import write_netcdf
from mgehl.output.export.paraview import write_vts
from mgehl.output.export.pvd import write_pvd
from mgehl.output.whole_file import whole_file, writing

WRITERS = {"vts": write_vts, "nc": write_netcdf, "npz": write_npz, "csv": write_csv}
"""Format, which is also the file's ending: a function of path and `Solution`."""

OF_FRAMES = {"pvd": write_pvd}
"""The same of all instants of a run in time: a function of the file's own path."""

DEFAULT_NAME = "fields"


def read_formats(text):
    """The formats of a list such as "vts,nc", each once. Raises UserError."""
    formats = [each.strip() for each in text.split(",")]
    for each in formats:
        if each not in WRITERS | OF_FRAMES:
            raise UserError(f"--to {text}: {each!r} is none of {', '.join(WRITERS | OF_FRAMES)}")
    return list(dict.fromkeys(formats))


def targets(formats, directory, out=None):
    """{format: path}: `out`, to which a format adds its ending, or `fields` in the run's directory.

    A directory as `out` gets `fields`, too. Raises UserError where `out` has the ending of another
    format than the one that is written.
    """
    base = Path(out or directory)
    if not out or base.is_dir():
        base = base / DEFAULT_NAME
    ending = base.suffix.removeprefix(".")
    if ending not in WRITERS | OF_FRAMES:
        return {each: base.with_name(f"{base.name}.{each}") for each in formats}
    if formats != [ending]:
        raise UserError(f"--out {out}: its ending does not go with --to {','.join(formats)}; leave it out")
    return {ending: base}


def export(solution, paths, force=False):
    """Write `solution` to `paths`, {format: path}, over files that exist only with `force`.

    Raises OutputError where a file exists or cannot be written, or a field makes no sense.
    """
    for path in paths.values():
        if path.exists() and not force:
            raise OutputError(f"{path} exists: add --force to replace it, or choose another with --out")
    _check_fields(solution)
    for each, path in paths.items():
        if each in OF_FRAMES:
            with writing(path):
                OF_FRAMES[each](path, solution)
        else:
            _write_whole(WRITERS[each], path, solution)


def _check_fields(solution):
    """Neither an iteration that diverged nor a damaged file may pass for an answer."""
    for name, field in {
        "pressure": solution.pressure,
        "film": solution.film,
        **further_fields(solution),
    }.items():
        bad = np.count_nonzero(~np.isfinite(field))
        if bad:
            raise OutputError(f"the {name} of this run is not finite at {bad} nodes: nothing to export")
    if not np.isin(solution.status, range(len(NAMES))).all():
        raise OutputError("the status of this run is damaged: it has nodes that are nothing known")


def _write_whole(write, path, solution):
    """Write a file; what was there before stays until the new one is whole."""
    with writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(path) as part:
            write(part, solution)
