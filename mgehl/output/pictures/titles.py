"""What a picture is of and what its axes show, in a line each."""

from mgehl.model.wedge import WedgeBearing


def title(solution):
    """Speed, load, nodes and verdict; of a wedge what stands in its film."""
    return f"{', '.join(_parts(solution))}: {verdict(solution.result)}"


def common_title(solutions):
    """What the titles of several runs have in common, and how many they are."""
    parts = [_parts(solution) for solution in solutions]
    common = [part for part in parts[0] if all(part in other for other in parts)]
    return ", ".join([*common, f"{len(solutions)} runs"])


def speed(u):
    """A speed in mm/s."""
    return f"{1e3 * u:.4g} mm/s"


def verdict(result):
    """Whether a run converged, in a word or two."""
    if result.converged:
        said = "converged"
    elif getattr(result, "settled", False):
        said = "settled, but Eq. 2 is broken"
    else:
        said = "NOT converged"
    overlap = getattr(result, "overlap", None)
    return said + (", THE BODIES OVERLAP" if overlap and overlap.nodes else "")


def position_labels(solution):
    """What the axes along and across the motion show, with its unit."""
    if isinstance(solution.contact, WedgeBearing):
        return "X, mm", "Y, mm"
    a, b = 1e3 * solution.contact.x_scale, 1e3 * solution.contact.y_scale
    return f"X = x/a, a = {a:.4g} mm", f"Y = y/b, b = {b:.4g} mm"


def common_labels(solutions):
    """As `position_labels`, of loaded contacts: without the semi-axes where they differ."""
    found = {position_labels(solution) for solution in solutions}
    return found.pop() if len(found) == 1 else ("X = x/a", "Y = y/b")


def _parts(solution):
    if isinstance(solution.contact, WedgeBearing):
        return _wedge(solution)
    contact, mesh = solution.contact, solution.mesh
    load = f"{1e-3 * contact.load:.4g} N/mm" if mesh.is_line else f"{contact.load:.4g} N"
    nodes = f"{mesh.nx} nodes" if mesh.is_line else f"{mesh.nx} x {mesh.ny} nodes"
    return [speed(contact.speed), load, nodes]


def _wedge(solution):
    bearing, mesh = solution.contact, solution.mesh
    what = "no pillar" if bearing.pillar == "none" else f"{bearing.pillar} pillar"
    exit = "blocked" if bearing.blocked_exit else "open"
    torn = ["film cavitates"] if solution.result.cavitated_nodes else []
    return [f"wedge with {what}", f"exit {exit}", *torn, f"{mesh.nx} x {mesh.ny} nodes"]
