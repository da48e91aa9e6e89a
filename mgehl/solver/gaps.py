"""Mean gaps of rough bodies, film and contact alike, and what carries the load: different grids compared.

Which nodes are in contact changes from grid to grid where gaps hardly differ. The mean of all gaps does not
care what a gap is called, and converges as a film does.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.solver.inequality import bend_of_a_cell
from mgehl.solver.shear import coefficient, friction_difference, rolling_of_bodies

NARROW = 0.025
"""What the largest pressure may be larger between nodes, over itself, from which on it is a spike of three
nodes. Spikes that a grid does not hold have 0.04 and more, others 0.0034 and less."""

SPIKES_GROW = 3.0
"""Times what a parabola says by which the top of such a spike may lie above its node: what is lower by no
more may be the largest pressure on a finer grid. A ball's had .64 GPa beside a middle of .80 on 129 nodes,
.93 on 513."""


@dataclass(frozen=True)
class Loads:
    """How hard the bodies press, and what carries the load."""

    largest: float
    """Largest pressure, in p_h."""
    contact: float
    """Part of the load on contact nodes."""
    solids: float
    """Part of the load that solids carry: P - p of contact nodes."""
    crest: float = 0.0
    """By how much the pressure between the nodes may exceed that of nodes, by parabolas through three: at
    the largest one, and at spikes that may be the largest."""

    @property
    def crest_share(self):
        """`crest` over the largest pressure at a node."""
        return self.crest / self.largest if self.largest > 0.0 else 0.0


@dataclass(frozen=True)
class GridGap:
    """Mean gaps of a grid in nm, and what carries its load."""

    nodes: int
    mean_nm: float
    loaded_nm: float
    contact_load_share: float
    settled: bool
    mean_apart_nm: float = 0.0
    """Mean size of the differences from the finer grid, node by node: of all nodes within the ellipse."""
    loaded_apart_nm: float = 0.0
    """The same by their pressure."""
    max_pressure_GPa: float | None = None
    """None in older results."""
    solid_load_fraction: float | None = None
    pressure_apart_GPa: float = 0.0
    """Mean size of the pressure's differences from the finer grid, by pressure."""
    contact_load_apart: float = 0.0
    """Sum of the sizes of the same differences of what contact carries, in parts of the load."""
    solid_load_apart: float = 0.0
    pressure_crest_GPa: float = 0.0
    """By how much the pressure may be larger between the nodes."""
    friction: float | None = None
    """Shear of film and solids over the load; None of bodies that do not slide, and in older results."""
    friction_apart: float = 0.0
    """Sum of the sizes of the shear's differences from the finer grid, over the load."""
    rolling: float | None = None
    """What drags a body against the motion, mean of both, over the load; None in older results."""


def within_hertz(mesh, reach=1.0):
    """Nodes of the whole grid within the Hertz ellipse, or a line contact's width: (ny, nx). `reach` are
    its semi-axes in units of X and Y: of a load in time not 1."""
    across = np.zeros(1) if mesh.is_line else mesh.Y
    return mesh.X[None, :] ** 2 + across[:, None] ** 2 <= reach**2


def gaps_of(mesh, P, H, reach=1.0):
    """Mean of the gap H `within_hertz`, and by the pressure P there; both (ny, nx). Over all nodes the
    latter would have no limit: far out p h falls as 1/x."""
    there = within_hertz(mesh, reach)
    P, H = P[there], H[there]
    load = P.sum()
    loaded = float(np.vdot(P, H) / load) if load > 0.0 else float("nan")
    return float(np.mean(H)), loaded


def gaps(problem, P, H):
    """The same of a rank's lines (collective): rank 0 tells the others, so ranks do not matter."""
    mesh, reach = problem.grid.mesh, problem.hertz.reach
    return problem.grid.on_first(lambda P, H: gaps_of(mesh, P, H, reach), P, H)


def loads(problem, state):
    """`Loads` of a state (collective)."""
    grid, contact, share = problem.grid, state.status == CONTACT, problem.share_of_load
    P, largest = grid.halo(state.P), grid.max(state.P, initial=0.0)
    bend = sum(bend_of_a_cell(axis, P) for axis in problem.axes)
    tops = [state.P >= axis.beside(P, shift) for axis in problem.axes for shift in (-1, 1)]
    may_be_largest = np.logical_and.reduce(tops) & (state.P + SPIKES_GROW * bend >= largest)
    crest = grid.max(bend[may_be_largest], initial=0.0)
    return Loads(largest, share(state.P, contact), share(state.P - state.p, contact), crest)


def load_differences(problem, state, P, p, status):
    """By how much a state differs from a finer grid's P, p and status at its nodes, each (lines, nx):
    `Loads` of their sizes, that of the largest pressure their mean by pressure (collective)."""
    grid, here, there = problem.grid, state.status == CONTACT, status == CONTACT
    everywhere, weight = np.ones_like(here), grid.sum(state.P.sum())
    of_contact = np.where(here, state.P, 0.0) - np.where(there, P, 0.0)
    of_solids = np.where(here, state.P - state.p, 0.0) - np.where(there, P - p, 0.0)
    mean = grid.sum((state.P * np.abs(state.P - P)).sum()) / weight if weight > 0.0 else float("nan")
    return Loads(
        mean, *(problem.share_of_load(np.abs(each), everywhere) for each in (of_contact, of_solids))
    )


def grid_gap(problem, state, settled, finer=None):
    """The `GridGap` of a state; of a coarser grid `finer` is the finer one's at its nodes (collective)."""
    nm, GPa, apart = 1e9 * problem.contact.film_scale, 1e-9 * problem.contact.hertz.p_h, {}
    mean, loaded = gaps(problem, state.P, state.H)
    carried = loads(problem, state)
    if finer:
        mean_apart, loaded_apart = gaps(problem, state.P, np.abs(state.H - finer.H))
        of_loads = load_differences(problem, state, finer.P, finer.p, finer.status)
        apart = {
            "mean_apart_nm": nm * mean_apart, "loaded_apart_nm": nm * loaded_apart,
            "pressure_apart_GPa": GPa * of_loads.largest, "contact_load_apart": of_loads.contact,
            "solid_load_apart": of_loads.solids,
            "friction_apart": friction_difference(problem, state, finer),
        }  # fmt: skip
    return GridGap(
        problem.grid.mesh.nx, nm * mean, nm * loaded, carried.contact, settled,
        max_pressure_GPa=GPa * carried.largest, pressure_crest_GPa=GPa * carried.crest,
        solid_load_fraction=carried.solids, friction=coefficient(problem, state),
        rolling=0.5 * sum(rolling_of_bodies(problem, state)) / problem.contact.load, **apart,
    )  # fmt: skip
