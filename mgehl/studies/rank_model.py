"""The cost of one iteration of GMRES with its cycle on a rank: messages, bytes, flops, and from these time.

Counted from the algorithm, for a film on n by n nodes; only the `Constants` are measured. With contact each
transfer has two halos instead of one. Collectives count as in textbooks: a broadcast or a sum over N ranks
takes log2(N) messages one after the other, the exchange of a transform one message to every other rank.
"""

from dataclasses import astuple, dataclass
from math import ceil, log2

import numpy as np

from mgehl.config import COARSEST_NODES
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.mesh import HALO
from mgehl.grid.ownership import ownerships

REAL, COMPLEX = 8, 16
"""Bytes of a number."""


@dataclass(frozen=True)
class Constants:
    """Of a machine, and of this code on it."""

    latency: float
    """Seconds that a short message takes."""
    exchange: float
    """Seconds that each short message of a transform's exchange takes."""
    bandwidth: float
    """Bytes per second, one rank to another."""
    transforms: float
    """Flops per second of a rank's Fourier transforms."""
    sweeps: float
    """Flops per second in all the rest."""
    direct: float
    """Seconds of the coarsest grid's direct solve, which the last rank does."""
    calls: float
    """Seconds that calls take on each grid, however few nodes it has."""


@dataclass(frozen=True)
class Cost:
    """Of the rank that has most to do."""

    halos: float = 0.0
    """Messages to the two neighbours, and of lines that move to other ranks."""
    exchanged: float = 0.0
    """Messages of the transforms' exchanges."""
    collective: float = 0.0
    """Messages of broadcasts and sums, one after the other."""
    bytes: float = 0.0
    transforms: float = 0.0
    """Flops of Fourier transforms."""
    sweeps: float = 0.0
    """Flops of all the rest."""
    direct: float = 0.0
    """Direct solves on the coarsest grid."""
    grids: float = 0.0
    """Grids on which it has lines."""

    def __add__(self, other):
        return Cost(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))

    def __rmul__(self, times):
        return Cost(*(times * each for each in astuple(self)))

    @property
    def messages(self):
        return self.halos + self.exchanged + self.collective

    def seconds(self, constants):
        """(waiting for messages, moving bytes, transforms, sweeps, the direct solve, calls)."""
        waiting = (self.halos + self.collective) * constants.latency + self.exchanged * constants.exchange
        moving = self.bytes / constants.bandwidth
        transforms, sweeps = self.transforms / constants.transforms, self.sweeps / constants.sweeps
        fixed = self.direct * constants.direct, self.grids * constants.calls
        return waiting, moving, transforms, sweeps, *fixed


@dataclass(frozen=True)
class Level:
    """A grid of n by n nodes whose lines so many ranks share."""

    nodes: int
    ranks: int

    @property
    def lines(self):
        return ceil(self.nodes / self.ranks)

    @property
    def mine(self):
        """Nodes of a rank."""
        return self.lines * self.nodes

    def halo(self):
        neighbours = min(self.ranks - 1, 2)
        return Cost(halos=neighbours, bytes=neighbours * HALO * self.nodes * REAL)

    def everyone(self):
        """A broadcast or a sum of one number over all ranks."""
        hops = log2(self.ranks)
        return Cost(collective=hops, bytes=hops * REAL)

    def convolution(self):
        """Real transforms of 2(n - 1) along x, complex ones along y, there and back; two exchanges."""
        others, doublings = self.ranks - 1, log2(2 * (self.nodes - 1))
        flops = self.mine * (2 * 5 * doublings + 2 * 10 * doublings + 4)
        sent = 2 * COMPLEX * self.mine * others / self.ranks
        return Cost(exchanged=2 * others, bytes=sent, transforms=flops)

    def stencils(self):
        """The Jacobian times a vector whose deflection is known: two stencils of six nodes."""
        return 2 * self.halo() + self.everyone() + Cost(sweeps=30 * self.mine)

    def product(self):
        """The Jacobian times a vector, as GMRES makes it: with a convolution and the load."""
        return self.stencils() + self.convolution() + self.everyone()

    def relaxation(self):
        """All lines' bands along both axes solved, and what they give distributed."""
        others = self.ranks - 1
        sent = Cost(exchanged=2 * others, bytes=2 * REAL * self.mine * others / self.ranks)
        return self.halo() + sent + Cost(sweeps=(2 * (4 * REACH + 2) + 8) * self.mine)

    def transfers(self, coarse):
        """Restriction; interpolation of a correction and of its deflection, which is convolved there.

        Lines of a coarse grid on fewer ranks move there and back: the rank that sends most keeps none of
        them.
        """
        work = coarse.convolution() + Cost(sweeps=(8 + 2 * 4) * self.mine)
        if coarse.ranks == self.ranks:
            return self.halo() + 2 * coarse.halo() + work
        between = max(coarse.lines // max(self.lines // 2, 1), 1) + 1
        moved = coarse.mine + 2 * HALO * coarse.nodes
        return self.halo() + Cost(halos=2 * between, bytes=3 * REAL * moved) + work

    def direct(self):
        """The dense factors applied to what the last rank gathers, and sends back to the others."""
        hops, others = log2(self.ranks), self.nodes**2 - self.mine
        gathered, sent_back = Cost(collective=hops), Cost(collective=hops, bytes=REAL * others)
        return gathered + sent_back + self.everyone() + Cost(direct=1, grids=1)


def levels(nodes, ranks):
    """The `Level`s of a hierarchy, coarsest first."""
    depth = int(log2((nodes - 1) // (COARSEST_NODES - 1))) + 1
    owned = ownerships(nodes, depth, ranks)
    return [Level(int(starts[-1]), int(np.count_nonzero(np.diff(starts)))) for starts in owned[::-1]]


def cycle(grids):
    """One V-cycle, a relaxation after the coarse grids: what a film takes that no coarse grid holds."""
    total = grids[0].direct()
    for coarse, fine in zip(grids[:-1], grids[1:], strict=True):
        total += fine.transfers(coarse) + fine.stencils() + fine.relaxation() + Cost(grids=1)
    return total


def iteration(nodes, ranks):
    """One iteration of GMRES: a cycle, a product on the finest grid, two sums against what it keeps."""
    grids = levels(nodes, ranks)
    finest = grids[-1]
    return cycle(grids) + finest.product() + 2 * finest.everyone() + Cost(sweeps=20 * finest.mine)
