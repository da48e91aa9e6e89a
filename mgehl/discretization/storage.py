"""What a control volume stores: the squeeze flow of an implicit time step, of oil above the layers."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import own


@dataclass(frozen=True)
class Storage:
    """The term -rate (content - before) of the rows of flow; arrays (lines, nx). The smaller the time step
    1/rate, the less the gap of a film can change in it."""

    rate: float | np.ndarray
    """1/time step, in units in which the Couette flow of a full film is 1."""
    before: np.ndarray
    """The content that the step begins with, carried to where the surfaces are at its end."""
    weights: tuple | None = None
    """What the Poiseuille flow counts of faces, (lines, nx - 1), (lines + 1, nx); None: all of it."""

    @classmethod
    def begun(cls, fluid, rate):
        """A time step that begins with this ghosted `fluid`; None where there is no rate at all."""
        return cls(rate, content(fluid)) if np.any(rate) else None

    def outflow(self, fluid):
        """What is stored instead of flowing on."""
        return self.rate * (content(fluid) - self.before)

    def of_full(self, fluid):
        """What a cavity stores by a filling of 1, per time: (lines, nx)."""
        return self.rate * own(fluid.rho) * own(fluid.carried)

    def by_P(self, fluid):
        """Derivative of `outflow` by what answers to the node's flow: its P, its H held, or its filling."""
        by_P = own(fluid.drho_dP) * own(fluid.carried)
        if fluid.torn is not None:
            by_P = np.where(own(fluid.torn), own(fluid.rho) * own(fluid.carried), by_P)
        return self.rate * by_P

    def by_H(self, fluid):
        """Derivative of `outflow` by the node's own H."""
        by_H = own(fluid.rho)
        for part in (fluid.follows, fluid.filling):
            by_H = by_H if part is None else by_H * own(part)
        return self.rate * by_H


def content(fluid):
    """rho H of the fluid that there is, (lines, nx), of what lies above the layers."""
    full = own(fluid.rho) * own(fluid.carried)
    return full if fluid.filling is None else full * own(fluid.filling)
