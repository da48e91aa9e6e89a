"""A solution found in a `Frame`, in the user's own axes, scales and nodes."""

from dataclasses import replace

from mgehl.model.frame import Frame
from mgehl.output.fields import Fields
from mgehl.output.solution import Solution


def solution_of(case, parts, problem, state, rows, result, maps=None):
    """The `Solution` of a final state (collective)."""
    fields = state.P, state.H, state.status, state.p, state.full_part, problem.heights
    whole = Fields(*fields, **(maps or {})).gathered(problem.grid)
    found = Solution(case.config, parts.contact, problem.grid.mesh, whole, rows, result, state.H0)
    return in_users_axes(found, parts.frame, case)


def in_users_axes(solution, frame, case):
    """A `Solution` found in a frame, in the user's axes, those of its `Case`."""
    if frame == Frame():
        return solution
    scale = solution.contact.film_scale / case.contact.film_scale
    fields = None
    if solution.fields is not None:
        fields = Fields(**{name: frame.users_array(each) for name, each in solution.fields.named.items()})
        fields.H = scale * fields.H
    return replace(
        solution,
        contact=case.contact,
        mesh=case.mesh,
        fields=fields,
        result=_result(solution.result, frame, solution.mesh),
        H0=scale * solution.H0,
    )


def _result(result, frame, mesh):
    """The `Result` with the numbers of nodes that the user counts."""

    def at(node):
        i, j = node["i"], node["j"]
        x, y = frame.users_node(i, j, mesh.nx, mesh.ny)
        sides = node.get("neighbours")
        return node | {"i": x, "j": y} | ({"neighbours": list(frame.users_sides(*sides))} if sides else {})

    def in_users_nodes(inequality):
        return replace(inequality, nodes=[at(node) for node in inequality.nodes])

    x_nodes, y_nodes = frame.users_ranges(result.contact.x_nodes, result.contact.y_nodes, mesh.nx, mesh.ny)
    edge, across = result.edge, frame.pair(result.edge.nodes_along_x, result.edge.nodes_along_y)
    return replace(
        result,
        edge=replace(edge, nodes_along_x=across[0], nodes_along_y=across[1]),
        contact=replace(result.contact, x_nodes=x_nodes, y_nodes=y_nodes),
        pressure_inequality=in_users_nodes(result.pressure_inequality),
        other_inequality=in_users_nodes(result.other_inequality),
        contradictions=[at(node) for node in result.contradictions],
    )
