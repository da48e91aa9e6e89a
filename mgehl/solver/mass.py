"""The account of the oil: what flows through the contact, and what the nodes of each kind make of it.

No node may make oil. The balance of every node is reckoned anew from P, p, H and the fillings of the final
state; what the solver calls its residual is not asked.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED

CLOSED = 1e-6
"""Part of what flows through that may be made, or lost, by a node or by all nodes of one kind."""

LEAST_THROUGH = 1e-4
"""Part of what surfaces carry in that counts as flowing through at the least: nothing flows through full
contact. With 0.01 slow balls without layers may make 3e-8 of what enters their ellipse."""


@dataclass(frozen=True)
class Mass:
    """Oil at ambient density in m^3/s, of a line contact in m^2/s."""

    enters: float
    """Into the Hertz ellipse (of a line contact its width, of a wedge the pad), carried and pressed."""
    leaves: float
    made_by_film: float
    """What the film nodes of the domain let out more than they let in."""
    made_by_cavity: float
    made_by_contact: float
    largest_node: float
    """The largest such difference of a single node, whatever its sign."""
    carried_in: float
    """What flows into the domain, from whatever side; of a bearing at the least what its plate carries."""

    @property
    def made(self):
        """The largest of what a node, or all nodes of one kind, make or lose."""
        by_kind = self.made_by_film, self.made_by_cavity, self.made_by_contact
        return max(self.largest_node, *map(abs, by_kind))

    @property
    def made_share(self):
        """The same over what flows through; 0 where nothing flows."""
        through = max(self.enters, self.leaves, LEAST_THROUGH * self.carried_in)
        return self.made / through if through > 0.0 else 0.0


def mass_account(problem, state, evaluation):
    """The `Mass` of an evaluated state of a loaded contact (collective)."""
    unit = flow_unit(problem.contact, problem.grid.mesh)
    return account(problem, state, evaluation, _hertz_ellipse(problem, evaluation), unit)


def flow_unit(contact, mesh):
    """The flow that carries one unit of H across one of Y, in m^3/s; of a line in m^2/s."""
    return contact.speed * contact.film_scale * (1.0 if mesh.is_line else contact.y_scale)


def account(problem, state, evaluation, inside, unit):
    """The `Mass` of an evaluated state, with what flows into and out of the nodes `inside` (collective).
    That is a ghosted mask; the `unit` is that of `flow_unit`."""
    grid, mesh = problem.grid, problem.grid.mesh
    cell = mesh.dX * mesh.dY
    inner = ~problem.boundary
    made = [-grid.sum((evaluation.inflow[(state.status == kind) & inner]).sum()) for kind in KINDS]
    largest = grid.max(np.abs(np.where(inner, evaluation.inflow, 0.0)), initial=0.0)
    through = _through(problem, evaluation, inside)
    carried_in, _ = _through(problem, evaluation, _in_domain(grid, evaluation.status != BOUNDARY))
    balance = *(cell * each for each in made), cell * largest, carried_in
    return Mass(*(float(unit * each) for each in (*through, *balance)))


KINDS = LUBRICATED, CAVITATED, CONTACT


def beside_open_sides(problem, evaluation, unit):
    """What the half cells between the outermost nodes and the open sides that they lie on take in, in
    m^3/s, and give off: along the side the surfaces carry oil, and what they carry more, or less, from cell
    to cell passes through the side (collective)."""
    grid, mesh = problem.grid, problem.grid.mesh
    on_a_side = np.isin(np.arange(grid.first, grid.last), (0, mesh.ny - 1))
    carried = evaluation.flows[0][0].value[on_a_side]
    ends = np.maximum(carried[:, 0], 0.0) + np.maximum(-carried[:, -1], 0.0)
    enters = ends.sum() + np.maximum(np.diff(carried), 0.0).sum()
    return 0.5 * mesh.dY * unit * grid.sum(float(enters))


def _hertz_ellipse(problem, evaluation):
    """The nodes in it, a ghosted mask; of a line contact those of its width."""
    grid, mesh = problem.grid, problem.grid.mesh
    Y = 0.0 if mesh.is_line else mesh.y[0] + mesh.dY * _lines(grid)
    inside = np.broadcast_to(mesh.X[None, :] ** 2 + Y**2 <= 1.0, evaluation.status.shape)
    return _in_domain(grid, inside)


def _in_domain(grid, nodes):
    """A ghosted mask without what lies beyond the first and the last line of the domain."""
    return nodes & (_lines(grid) >= 0) & (_lines(grid) < grid.mesh.ny)


def _lines(grid):
    """Number of each line, ghosts included, as a column."""
    return np.arange(grid.first - HALO, grid.last + HALO)[:, None]


def _through(problem, evaluation, inside):
    """What enters the nodes `inside`, a ghosted mask, and what leaves them, in units of H and Y."""
    enters = leaves = 0.0
    for width, *flows in border_flows(evaluation, inside):
        flow = np.concatenate(flows)
        enters += width * flow[flow > 0.0].sum()
        leaves -= width * flow[flow < 0.0].sum()
    return problem.grid.sum(enters), problem.grid.sum(leaves)


def border_flows(evaluation, nodes):
    """For each axis the width of a face, and what flows into `nodes`, a ghosted mask, by their borders:
    through faces where they begin along the axis, and where they end."""
    mesh = evaluation.mesh
    for axis, (leaving, entering) in zip(evaluation.axes, evaluation.flows, strict=True):
        first, last = (axis.inner(own(nodes) & ~axis.beside(nodes, side)) for side in (-1, 1))
        inward = axis.entered(entering.value)[first], -axis.left(leaving.value)[last]
        yield mesh.dX * mesh.dY / axis.cell, *inward
