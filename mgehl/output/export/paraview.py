"""Fields of a run for ParaView: VTK structured grids by PETSc's own viewer; of a run in time many."""

import os
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
from petsc4py import PETSc

from mgehl.errors import UserError
from mgehl.output.files import further_fields
from mgehl.output.solution import Fields
from mgehl.output.whole_file import whole_file

_COORDINATES = 3
"""Numbers per node that VTK takes for its position."""

_SHORT_OFFSETS_UNTIL = (3, 19)
"""PETSc counts the bytes of the file in 64 bits from this version on."""

_SHORT_LIMIT = 2**31

_END = b"</VTKFile>\n"


def write_vts(path, solution):
    """Write pressure_Pa, film_m, P, H, status and `further_fields` on x and y in metres.

    Serial; `path` must end in .vts. Raises OSError where the file cannot be written, or is too large for
    this PETSc.
    """
    fields = solution.fields
    values = {
        "pressure_Pa": solution.pressure,
        "film_m": solution.film,
        "P": fields.P,
        "H": fields.H,
        "status": fields.status,
    } | further_fields(solution)
    _check_size(solution.mesh.nodes * (_COORDINATES + len(values)))
    path.touch()  # a place that cannot be written shows here
    plane = _plane(solution)
    viewer = PETSc.Viewer().createVTK(os.fsencode(path), mode="w", comm=PETSc.COMM_SELF)
    for name, array in values.items():
        _add(viewer, plane, name, array)
    _write(viewer, path)
    plane.destroy()


def _plane(solution):
    """A DMDA of the nodes, one line of them for a line contact, at their places in metres."""
    mesh = solution.mesh
    plane = PETSc.DMDA().create(sizes=(mesh.nx, mesh.ny), dof=1, stencil_width=0, comm=PETSc.COMM_SELF)
    plane.setUniformCoordinates()
    places = plane.getCoordinates()
    X, Y = np.meshgrid(solution.x, solution.y)
    places.setArray(np.stack([X, Y], axis=-1).ravel())
    return plane


def _add(viewer, plane, name, array):
    """Hand a copy of a field, (ny, nx), to the viewer."""
    vec = plane.createGlobalVec()
    vec.setName(name)
    vec.setArray(np.asarray(array, dtype=float).ravel())
    vec.view(viewer)
    vec.destroy()


def _write(viewer, path):
    """Let the viewer write its file, header and all fields at once, which it does when destroyed."""
    try:
        viewer.destroy()
    except PETSc.Error as error:
        # PETSc would try again when it ends, and complain at length: let it, into nothing.
        path.unlink()
        path.symlink_to(os.devnull)
        viewer.destroy()
        raise OSError(f"PETSc's viewer failed with error {error.ierr}: is the disk full?") from None
    _check_end(path)


def _check_end(path):
    """What fails when the viewer closes the file, it does not say."""
    with path.open("rb") as file:
        file.seek(-min(len(_END), path.stat().st_size), os.SEEK_END)
        if file.read() != _END:
            raise OSError("PETSc's viewer wrote a part of it only: is the disk full?")


def _check_size(numbers):
    if PETSc.Sys.getVersion() < _SHORT_OFFSETS_UNTIL and 8 * numbers >= _SHORT_LIMIT:
        raise OSError("over 2 GB, too large for the viewer of PETSc before 3.19; nc has no such limit")


def write_pvd(path, solution):
    """Write PATH, which names a VTK file for each instant, and these in a folder of its name.

    Raises UserError where the run has no frames, OSError where a file cannot be written.
    """
    if solution.frames is None:
        raise UserError("--to pvd: this run has no frames, as runs in time have (frames.nc)")
    folder, contact = path.with_suffix(""), solution.contact
    folder.mkdir(parents=True, exist_ok=True)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for number, (t, fields) in enumerate(solution.frames.all()):
        name = f"frame-{number:04d}.vts"
        P, H = fields["pressure"] / contact.pressure_scale, fields["film"] / contact.film_scale
        with whole_file(folder / name) as part:
            write_vts(part, replace(solution, fields=Fields(P, H, fields["status"])))
        ElementTree.SubElement(collection, "DataSet", timestep=repr(t), file=f"{folder.name}/{name}")
    with whole_file(path) as part:
        ElementTree.ElementTree(root).write(part, "utf-8", xml_declaration=True)
