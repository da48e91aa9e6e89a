"""What a picture is of, in a line."""

from mgehl.model.wedge import WedgeBearing


def title(solution):
    """Speed, load, nodes and verdict; of a wedge what stands in its film."""
    if isinstance(solution.contact, WedgeBearing):
        return _wedge(solution)
    contact, mesh = solution.contact, solution.mesh
    load = f"{contact.load:.4g} N" + ("/m" if mesh.is_line else "")
    nodes = f"{mesh.nx} nodes" if mesh.is_line else f"{mesh.nx} x {mesh.ny} nodes"
    return f"{speed(contact.speed)}, {load}, {nodes}: {_verdict(solution.result)}"


def speed(u):
    """A speed in mm/s."""
    return f"{1e3 * u:.4g} mm/s"


def _verdict(result):
    if result.converged:
        verdict = "converged"
    elif result.settled:
        verdict = "settled, but Eq. 2 is broken"
    else:
        verdict = "NOT converged"
    return verdict + (", THE BODIES OVERLAP" if result.overlap.nodes else "")


def _wedge(solution):
    bearing, mesh = solution.contact, solution.mesh
    what = "no pillar" if bearing.pillar == "none" else f"{bearing.pillar} pillar"
    exit = "blocked" if bearing.blocked_exit else "open"
    verdict = "converged" if solution.result.converged else "NOT converged"
    torn = ", film cavitates" if solution.result.cavitated_nodes else ""
    return f"wedge with {what}, exit {exit}{torn}, {mesh.nx} x {mesh.ny} nodes: {verdict}"
