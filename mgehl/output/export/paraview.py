"""Fields of a run for ParaView: VTK structured grids; of a run in time a collection of them."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np

from mgehl.errors import UserError
from mgehl.output.fields import Fields
from mgehl.output.files import further_fields
from mgehl.output.whole_file import whole_file

HEAD = """\
<?xml version="1.0"?>
<VTKFile type="StructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <StructuredGrid WholeExtent="{extent}">
    <Piece Extent="{extent}">
      <Points>
        {places}
      </Points>
      <PointData>
        {values}
      </PointData>
    </Piece>
  </StructuredGrid>
  <AppendedData encoding="raw">
_"""
ARRAY = '<DataArray type="Float64" Name="{}" NumberOfComponents="{}" format="appended" offset="{}" />'


def write_vts(path, solution):
    """Write pressure_Pa, film_m, P, H, status and `further_fields` on x and y in metres. Raises OSError
    where the file cannot be written."""
    fields = solution.fields
    X, Y = np.meshgrid(solution.x, solution.y)
    arrays = {"Position": np.stack([X, Y, 0.0 * X], axis=-1)}
    arrays |= {"pressure_Pa": solution.pressure, "film_m": solution.film}
    arrays |= {"P": fields.P, "H": fields.H, "status": fields.status} | further_fields(solution)
    blocks, told, offset = [], [], 0
    for name, values in arrays.items():
        content = values.astype("<f8").tobytes()
        told.append(ARRAY.format(name, values.size // X.size, offset))
        blocks += [len(content).to_bytes(8, "little"), content]
        offset += 8 + len(content)
    extent = f"0 {solution.mesh.nx - 1} 0 {solution.mesh.ny - 1} 0 0"
    head = HEAD.format(extent=extent, places=told[0], values="\n        ".join(told[1:]))
    path.write_bytes(b"".join([head.encode(), *blocks, b"\n  </AppendedData>\n</VTKFile>\n"]))


def write_pvd(path, solution):
    """Write PATH, which names a VTK file for each instant, and these in a folder of its name. Raises
    UserError where the run has no frames, OSError where a file cannot be written."""
    if solution.frames is None:
        raise UserError("--to pvd: this run has no frames, as runs in time have (frames.nc)")
    folder, contact = path.with_suffix(""), solution.contact
    folder.mkdir(parents=True, exist_ok=True)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for number, (t, fields) in enumerate(solution.frames.all()):
        name = f"frame-{number:04d}.vts"
        with whole_file(folder / name) as part:
            write_vts(part, replace(solution, fields=_of_instant(fields, contact)))
        ElementTree.SubElement(collection, "DataSet", timestep=repr(t), file=f"{folder.name}/{name}")
    with whole_file(path) as part:
        ElementTree.ElementTree(root).write(part, "utf-8", xml_declaration=True)


def _of_instant(fields, contact):
    """The `Fields` of a frame."""
    P, H = fields["pressure"] / contact.pressure_scale, fields["film"] / contact.film_scale
    p = fields["fluid_pressure"] / contact.pressure_scale if "fluid_pressure" in fields else None
    return Fields(P, H, fields["status"], p, fields.get("filling"), fields.get("heights"))
