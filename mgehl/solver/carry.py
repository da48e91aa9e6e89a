"""Steps in time: contents are carried along with the surfaces, and what is pressed is solved for.

    m - m* = what enters by G       m* = what the surfaces have brought to a node, [derived]

m is the content rho (H - h_b) theta of a node, G what the pressure drives through a face in a step. Along
the motion nothing is differenced: m* is cut out of the contents before (`discretization.transport`), so
film waves go with the surfaces' mean velocity without error where that is a whole number of cells. G
follows the second backward formula, written for each face:

    G = w c S(G before) + (w b + 1 - w) dT Q        c = r^2/(1 + 2 r), b = (1 + r)/(1 + 2 r)

r is this step over the one before, Q the Poiseuille flow; S moves along. w is 1 where the film is, and 0
beside cavities and contact, where the first backward formula keeps contents positive. Whatever w is, what
leaves a node enters another.

Where no heights move, the steady state at the beginning solves each step (`Reference`): the flows by which
it is steady are differenced otherwise, and what that makes is a flow, too, which is added.

The content that is carried on is the one of the balance, not rho H of the solved state: what the residual
leaves over is carried into the next step, and oil is neither made nor lost in any number of steps.
"""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.discretization.axes import HALO, own
from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.discretization.storage import Storage, content
from mgehl.discretization.transport import least_on_the_way, moved
from mgehl.solver.debts import paid
from mgehl.solver.record import Kept

LEAST_LEFT = 0.5
"""Part of what the surfaces bring to a node that the flow of the step before may take away again: a node
that it would empty further has the first backward formula."""

ROUNDING = 1e-13
"""Content of less than nothing that is no debt."""

ROUNDS = 20
"""Rounds in which nodes that would be emptied are found; after them no node looks back."""


@dataclass
class Carried(Kept):
    """What a step in time hands on to the next: all that the oil remembers; arrays (lines, nx)."""

    m: np.ndarray
    """Content of every node."""
    G_x: np.ndarray | None = None
    """What the pressure drove through the face behind each node, along X, in the last step; None before the
    first."""
    G_y: np.ndarray | None = None
    """The same through the face before each node, along Y."""
    dT: float = 0.0
    """That step, in units of a/u."""

    def afresh(self):
        """The same without the last step: the first backward formula follows."""
        return Carried(self.m)


@dataclass
class Reference(Kept):
    """A steady state, and the flows that keep it; arrays (lines, nx).

    Flows are in units of the Couette flow at its own speed, through the face behind each node along X and
    before each node along Y.
    """

    m: np.ndarray
    Q_x: np.ndarray
    """All that flows."""
    F_x: np.ndarray
    """What the pressure drives."""
    Q_y: np.ndarray | None = None
    F_y: np.ndarray | None = None
    G_x: np.ndarray | None = None
    """As `Carried` has it, of this state."""
    G_y: np.ndarray | None = None

    @classmethod
    def of(cls, problem, state):
        """That of a steady state of a problem."""
        whole = problem.evaluate(state)
        still = whole.by(replace(problem.scheme, motion=(0.0, 0.0)))
        found = {}
        for name, evaluation in (("Q", whole), ("F", still)):
            for axis, (leaving, _) in zip("xy", evaluation.flows, strict=False):
                found[f"{name}_{axis}"] = _of_nodes(axis, leaving.value)
        return cls(content(whole.fluid), **found)


def _of_nodes(axis, faces):
    """What all faces of an axis have, (lines, nx): those behind the nodes, or before them."""
    return np.pad(faces, ((0, 0), (0, 1))) if axis == "x" else faces[:-1].copy()


class Transport:
    """Carries the contents of a problem's grid along (collective)."""

    def __init__(self, problem):
        self._problem, self._grid = problem, problem.grid

    def begin(self, state):
        """What a state carries on that was not reached by steps in time."""
        return Carried(content(self._problem.evaluate(state).fluid))

    def leg(self, carried, status, dT, shift, reference=None, way=0.0):
        """The `Leg` of a step `dT` in which contents go along by a `Shift`, from nodes of a `status`.

        A `Reference` would stay as it is in such a step of a `way` in units of a.
        """
        leg = self._leg(carried, status, dT, shift)
        if reference is None:
            return leg, None
        lacking, after = self._lacking(reference, leg, shift, way)
        # Where a node holds less than the reference, that much less is lacking.
        held = np.clip(carried.m / np.maximum(reference.m, 1e-300), 0.0, 1.0)
        held = np.where(reference.m > 0.0, held, 1.0)
        _, before = self._kept(lacking, leg.before, held, least_left=0.0)
        ends = self._grid.sum((before - leg.before)[~self._problem.boundary].sum())
        return replace(leg, before=before, through_ends=leg.through_ends + ends), after

    def _lacking(self, reference, leg, shift, way):
        """What must pass the faces of each axis besides for a reference to stay; the reference after it."""
        passed = self._passing(reference.m, shift)
        flows, pressed = (
            [way * each for each in self._faces(*both)]
            for both in ((reference.Q_x, reference.Q_y), (reference.F_x, reference.F_y))
        )
        if leg.G is None:
            G = pressed
        else:
            before = self._moved(Carried(reference.m, reference.G_x, reference.G_y), shift)
            G = [
                share * leg.c * old + weight * leg.b * new
                for share, old, weight, new in zip(leg.w, before, leg.weights, pressed, strict=True)
            ]
        lacking = [flow - brought - drawn for flow, brought, drawn in zip(flows, passed, G, strict=True)]
        along, *across = (_of_nodes(axis, each) for axis, each in zip("xy", G, strict=False))
        return lacking, replace(reference, G_x=along, G_y=across[0] if across else None)

    def _passing(self, m, shift):
        """What passes the faces of each axis when contents m go along, as flows are counted."""
        mesh, (along, across, _) = self._grid.mesh, self._carried(m, shift)
        found = [mesh.dX * along[:, 1:-1]]
        if mesh.is_line:
            return found
        behind = np.zeros(m.shape)
        if shift.along_y:
            behind = self._grid.scatter(None if across is None else across[:-1])
        return [*found, mesh.dY * self._faces(along, behind)[1]]

    def ended(self, leg, evaluation):
        """The `Carried` after a `Leg`, by the `Evaluation` of its answer; no node owes anything."""
        carried = leg.ended(evaluation)
        return replace(carried, m=paid(self._problem, carried.m))

    def _leg(self, carried, status, dT, shift):
        """The same without a reference."""
        brought, through = self._brought(carried.m, shift)
        if carried.G_x is None:
            return Leg(brought, through, None, None, dT, 1.0)
        ratio = dT / carried.dT
        c, b = ratio**2 / (1.0 + 2.0 * ratio), (1.0 + ratio) / (1.0 + 2.0 * ratio)
        G = [c * each for each in self._moved(carried, shift)]
        w, before = self._kept(G, brought, self._from_film(status, shift), LEAST_LEFT)
        known = [share * each for share, each in zip(w, G, strict=True)]
        weights = tuple((share * b + 1.0 - share) / b for share in w)
        return Leg(before, through, known, weights, dT, b, c, w)

    def _kept(self, G, held, counts, least_left):
        """What counts of `G` at the faces, from 0 to 1, and the contents by it.

        What `counts` of either node, (lines, nx): nothing of a node that would be left with less than
        `least_left` times what it `held`.
        """
        counts = counts.astype(float)
        for _ in range(ROUNDS):
            w = self._between(counts)
            after = held + self.into([share * each for share, each in zip(w, G, strict=True)])
            emptied = (counts > 0.0) & (after < least_left * held - ROUNDING)
            if not self._grid.count(emptied):
                return w, after
            counts[emptied] = 0.0
        return [np.zeros(each.shape) for each in G], held

    def _brought(self, m, shift):
        """Contents after they went along, and what passed the domain's ends inwards, a number."""
        along, across, after = self._carried(m, shift)
        inner = slice(None) if self._grid.mesh.is_line else self._inner_lines
        ends = self._grid.sum((along[inner, 1] - along[inner, -2]).sum())
        if not shift.along_y:
            return after, ends
        passed = 0.0 if across is None else float((across[1] - across[-2])[1:-1].sum())
        whole = None if across is None else after + across[:-1] - across[1:]
        return self._grid.scatter(whole), ends + self._grid.comm.bcast(passed)

    def _carried(self, m, shift):
        """What passes when contents m go along X and then along Y: the faces of own lines, (lines, nx + 1);
        on rank 0 those across all lines, (ny + 1, nx), else None; the contents between both, which rank 0
        has of all lines if they go on along Y."""
        along = shift.passing_x(m)
        between = m + along[:, :-1] - along[:, 1:]
        if not shift.along_y:
            return along, None, between
        whole = self._grid.gather(between)
        return along, None if whole is None else shift.passing_y(whole), whole

    @property
    def _inner_lines(self):
        """Own lines that are no end of the domain along Y."""
        lines = np.arange(self._grid.first, self._grid.last)
        return (lines > 0) & (lines < self._grid.mesh.ny - 1)

    def _moved(self, carried, shift):
        """What passed the faces of each axis in the last step, moved along."""
        G_x = _of_nodes("x", moved(carried.G_x[:, :-1], shift.along_x))
        G_y = None if carried.G_y is None else moved(carried.G_y, shift.along_x)
        if shift.along_y:
            G_x, G_y = self._moved_across(G_x, shift, 0), self._moved_across(G_y, shift, 1)
        return self._faces(G_x, G_y)

    def _moved_across(self, G, shift, first):
        """An array of the nodes' faces moved along Y, but for lines before the `first`."""
        whole = self._grid.gather(G)
        if self._grid.comm.rank == 0:
            whole[first:] = moved(whole[first:].T, shift.along_y).T
        return self._grid.scatter(whole)

    def _faces(self, G_x, G_y):
        """Of arrays of the nodes' faces those of all faces of each axis."""
        found = [G_x[:, :-1]]
        if G_y is not None:
            found.append(self._grid.halo(G_y)[HALO : HALO + len(G_y) + 1])
        return found

    def _from_film(self, status, shift):
        """Nodes that are film, and so are those that their content comes from, (lines, nx)."""
        film = ((status == LUBRICATED) | (status == BOUNDARY)).astype(float)
        if not shift.along_y:
            return least_on_the_way(film, shift.along_x) > 0.5
        whole = self._grid.gather(least_on_the_way(film, shift.along_x) if shift.along_x else film)
        return (
            self._grid.scatter(None if whole is None else least_on_the_way(whole.T, shift.along_y).T) > 0.5
        )

    def _between(self, values):
        """The lesser of both nodes' values (lines, nx) at the faces of each axis."""
        ghosted = self._grid.halo(values)
        return [np.minimum(axis.at(ghosted, 0), axis.at(ghosted, 1)) for axis in self._problem.axes]

    def into(self, G):
        """What enters the nodes through the faces of each axis less what leaves them, (lines, nx)."""
        total = np.zeros(self._grid.shape)
        for axis, each in zip(self._problem.axes, G, strict=True):
            axis.add_entering(each, total)
            axis.subtract_leaving(each, total)
        return total


@dataclass
class Leg:
    """A step in time before its pressures are known."""

    before: np.ndarray
    """What a node holds before anything more is pressed, (lines, nx)."""
    through_ends: float
    """Content that the surfaces brought into the domain, less what they took out of it."""
    G: list | None
    """What is already known of what the pressure drives through the faces; None: nothing."""
    weights: tuple | None
    """What the new flow counts, over `b`; None: the same everywhere."""
    dT: float
    b: float
    """Of the new flow, what a backward formula counts."""
    c: float = 0.0
    """Of the last step's flow, what it counts."""
    w: list | None = None
    """Part of that which counts at the faces of each axis."""

    @property
    def storage(self):
        """The `Storage` that the equations of the step have."""
        return Storage(1.0 / (self.b * self.dT), self.before, self.weights)

    def pressed(self, evaluation):
        """What the pressure drove through the faces of each axis, by the `Evaluation` of the answer."""
        new = [self.b * self.dT * leaving.value for leaving, _ in evaluation.flows]
        return new if self.G is None else [known + each for known, each in zip(self.G, new, strict=True)]

    def ended(self, evaluation):
        """The `Carried` after the step."""
        G, m = self.pressed(evaluation), content(evaluation.fluid)
        inner = own(evaluation.status) != BOUNDARY
        m = np.where(inner, m + self.b * self.dT * evaluation.inflow, m)
        G_x, G_y = _of_nodes("x", G[0]), _of_nodes("y", G[1]) if len(G) > 1 else None
        return Carried(m, G_x, G_y, self.dT)
