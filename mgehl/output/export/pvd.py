"""Frames of a run in time for ParaView: a collection file, and a VTK file for each instant beside it."""

from dataclasses import replace
from xml.etree import ElementTree

from mgehl.errors import UserError
from mgehl.output.export.paraview import write_vts
from mgehl.output.solution import Fields
from mgehl.output.whole_file import whole_file


def write_pvd(path, solution):
    """Write PATH and a folder of the same name without its ending.

    Raises UserError where the run has no frames, OSError where a file cannot be written.
    """
    if solution.frames is None:
        raise UserError("--to pvd: this run has no frames, as runs in time have (frames.nc)")
    folder = path.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for number, (t, fields) in enumerate(solution.frames.all()):
        name = f"frame-{number:04d}.vts"
        with whole_file(folder / name) as part:
            write_vts(part, _at(solution, fields))
        ElementTree.SubElement(collection, "DataSet", timestep=repr(t), file=f"{folder.name}/{name}")
    with whole_file(path) as part:
        ElementTree.ElementTree(root).write(part, "utf-8", xml_declaration=True)


def _at(solution, fields):
    """The `Solution` as it was at an instant of these fields."""
    contact = solution.contact
    P, H = fields["pressure"] / contact.pressure_scale, fields["film"] / contact.film_scale
    return replace(solution, fields=Fields(P, H, fields["status"]))
