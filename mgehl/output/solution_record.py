"""A `Solution` as plain data and arrays, and back again: what a study keeps of its points."""

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.files import plain_result
from mgehl.output.solution import Fields, Solution
from mgehl.output.stored import result_from


def record_of(solution):
    """(plain data, {name: array}) of a `Solution` with whole fields, or without any."""
    plain = {
        "configuration": solution.config.as_toml_tables(),
        "rows": solution.rows,
        "result": plain_result(solution.result),
        "H0": float(solution.H0),
    }
    return plain, arrays_of(solution.fields)


def solution_from(plain, arrays):
    """The `Solution` of which `record_of` made these; its fields, if it had any, are whole, and here."""
    config = config_from_tables(plain["configuration"])
    contact = contact_from(config)
    fields = fields_from(arrays) if arrays else None
    result, mesh = result_from(plain["result"]), mesh_from(config, contact)
    if fields and fields.P.shape != (mesh.ny, mesh.nx):
        raise ValueError("its fields are not of its grid")
    return Solution(config, contact, mesh, fields, plain["rows"], result, plain["H0"], local=fields)


def arrays_of(fields):
    """{name: array} of `Fields`; empty of none."""
    return fields.named if fields else {}


def fields_from(arrays):
    """The `Fields` of which `arrays_of` made these."""
    if not arrays["P"].shape == arrays["H"].shape == arrays["status"].shape:
        raise ValueError("its fields are not of one grid")
    return Fields(**arrays)
