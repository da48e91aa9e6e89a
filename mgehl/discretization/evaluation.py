"""One state on one grid, evaluated: each quantity once, when it is first asked for."""

from dataclasses import InitVar, dataclass, replace
from functools import cached_property

import numpy as np

from mgehl.discretization.axes import HALO, axes_of, own
from mgehl.discretization.face_gap import flows_past_edges
from mgehl.discretization.faces import carried, conductances, flows, mobility_of_faces
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.kernels import flow_sources
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.discretization.storage import Storage


@dataclass(frozen=True, eq=False)
class Evaluation:
    """What the pressure, gap and status of a state, all ghosted, mean for the flow, each part computed
    once. It holds what the state was when it was made: one that has changed is evaluated anew, or its
    evaluation is told of the new pressure."""

    P: np.ndarray
    H: np.ndarray
    status: np.ndarray
    mesh: Mesh
    contact: object
    scheme: Scheme
    filling: np.ndarray | None = None
    storage: Storage | None = None
    """That of a time step, which the balance of every node has; None of what is steady."""
    gaps: list | None = None
    """The `FaceGap` along each axis, H being 1; None where the gap is that of nodes."""
    known: InitVar[dict | None] = None
    """Parts that need not be computed, by their names."""

    def __post_init__(self, known):
        vars(self).update(known or {})
        _ = self.fluid  # of the state as it is now

    def by(self, scheme):
        """The same state and fluid, differenced by another scheme of the same contact law."""
        if scheme == self.scheme:
            return self
        known = {"mobilities": self.mobilities} if scheme.mean == self.scheme.mean else {}
        return replace(self, scheme=scheme, known=known | {"fluid": self.fluid})

    def filled(self, filling):
        """The same with other contents of the cavities; full ones where `filling` is None."""
        torn = None if filling is None else self.status == CAVITATED
        contents = (torn, np.where(torn, filling, 1.0)) if torn is not None and torn.any() else (None, None)
        fluid = replace(self.fluid, torn=contents[0], filling=contents[1])
        return replace(self, filling=filling, known={"fluid": fluid, "mobilities": self.mobilities})

    def of_lines(self, lines):
        """The same of some of its own `lines` alone (a slice): views."""
        ghosted = slice(lines.start, lines.stop + 2 * HALO)
        state = (array[ghosted] for array in (self.P, self.H, self.status))
        gaps, mobilities = (
            parts and [part.of_lines(axis, lines) for axis, part in zip(self.axes, parts, strict=True)]
            for parts in (self.gaps, self.mobilities)
        )
        known = {"fluid": self.fluid.of(ghosted), "mobilities": mobilities}
        return Evaluation(*state, self.mesh, self.contact, self.scheme, gaps=gaps, known=known)

    def with_mobility(self, eps):
        """The same state with another ghosted mobility, which neither pressure nor gap moves."""
        return replace(self, known={"fluid": self.fluid.with_mobility(eps)})

    def forget(self):
        """Drop what was found of the faces; it is found again when it is asked for."""
        for name in ("mobilities", "flows", "conductances", "source"):
            self.__dict__.pop(name, None)

    def forget_fluid(self):
        """Drop the fluid, too. Not for an evaluation `with_mobility`: the laws know nothing of that."""
        self.forget()
        self.__dict__.pop("fluid", None)

    @cached_property
    def axes(self):
        """Those along which faces pass fluid."""
        return axes_of(self.mesh, self.scheme.motion)

    @cached_property
    def fluid(self):
        """The `Fluid` at the nodes."""
        touching, torn = self.status == CONTACT, self.status == CAVITATED
        cavities = (torn, self.filling) if self.filling is not None and torn.any() else (None, None)
        where, tears = (touching, *cavities), self.scheme.cavitation
        return fluid_state(self.P, self.H, self.contact, self.scheme.contact_law, *where, tears)

    @cached_property
    def mobilities(self):
        """`FaceMobility` of the faces along each axis, as much as counts in a time step."""
        found = [mobility_of_faces(self.fluid, axis, self.scheme) for axis in self.axes]
        if self.gaps is not None:
            found = [each.times(gap.cubed) for each, gap in zip(found, self.gaps, strict=True)]
        if self.storage is None or self.storage.weights is None:
            return found
        return [each.times(weight) for each, weight in zip(found, self.storage.weights, strict=False)]

    @cached_property
    def flows(self):
        """(leaving W, entering E) along each axis."""
        return self._flows()

    def linearised_flows(self):
        """The same with their derivatives by P and H."""
        return self._flows(linearised=True)

    def _flows(self, linearised=False):
        state, of_axes = (self.fluid, self.status), list(self._along())
        if self.gaps is None:
            return [flows(*state, axis, self.scheme, mobility, linearised) for axis, mobility in of_axes]
        each = zip(of_axes, self.gaps, strict=True)
        return [
            flows_past_edges(*state, axis, self.scheme, mobility, linearised, gap)
            for (axis, mobility), gap in each
        ]

    def _along(self):
        """Each axis with the `FaceMobility` along it."""
        return zip(self.axes, self.mobilities, strict=True)

    def carried_by_full_gaps(self):
        """What the surfaces carry through the faces along X and Y where all cavities are full, per cell. As
        `conductances`: (lines, nx - 1), and (lines + 1, nx), which is zero on a single line."""
        lines, nx = own(self.P).shape
        found = np.zeros((lines, nx - 1)), np.zeros((lines + 1, nx))
        for rate, axis, gap in zip(found, self.axes, self.gaps or (None, None), strict=False):
            rate[:] = carried(self.fluid, self.status, axis, self.scheme, gap) / axis.cell
        return found

    @cached_property
    def inflow(self):
        """Net inflow/(dX dY) of every node, whatever its status, less what is stored in a time step.
        (lines, nx); zero on the ends of lines."""
        inflow = np.zeros(own(self.P).shape)
        for axis, (leaving, entering) in zip(self.axes, self.flows, strict=True):
            axis.add_entering(entering.value, inflow)
            axis.subtract_leaving(leaving.value, inflow)
        if self.storage is not None:
            inflow -= self.storage.outflow(self.fluid)
        inflow[:, [0, -1]] = 0.0
        return inflow

    @cached_property
    def conductances(self):
        """Of the faces along X, (lines, nx - 1), and Y, (lines + 1, nx); these zero on a single line."""
        found = [conductances(self.status, axis, self.scheme, mobility) for axis, mobility in self._along()]
        if self.mesh.is_line:
            lines, nx = own(self.P).shape
            found.append(np.zeros((lines + 1, nx)))
        return found

    @cached_property
    def source(self):
        """What the surfaces carry into a node: its inflow without the Poiseuille flow, (lines, nx)."""
        source = np.zeros(self.inflow.shape)
        flow_sources(self.inflow, self.P, *self.conductances, source)
        return source
