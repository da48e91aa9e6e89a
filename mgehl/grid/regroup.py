"""Lines that move between ranks, where a coarse grid has fewer of them at work than the finer one."""

import numpy as np
from mpi4py import MPI

from mgehl.discretization.mesh import HALO


class Aligned:
    """Nothing to move: each coarse line is with the rank of the same fine line."""

    def __init__(self, coarse):
        self._coarse = coarse

    def collect(self, array):
        """The coarse grid's local lines, of those with the ranks of the same fine lines."""
        return array

    def spread(self, array):
        """The way back, with the neighbours' lines around, as `Grid.halo`."""
        return self._coarse.halo(array)


class Regrouped:
    """Coarse lines between the ranks of the same fine lines and the fewer that work on the coarse grid;
    `beside` is the ownership of the coarse lines beside the fine ones. A message has no other stop."""

    def __init__(self, coarse, beside):
        comm = coarse.comm
        there = [(int(first), int(last)) for first, last in zip(beside[:-1], beside[1:], strict=True)]
        here = list(zip(coarse.starts[:-1], coarse.starts[1:], strict=True))
        around = [(first - HALO, last + HALO) if first < last else (first, last) for first, last in there]
        self._collect = Move(comm, there, here)
        self._spread = Move(comm, here, around)

    def collect(self, array):
        """The coarse grid's local lines, of those with the ranks of the same fine lines."""
        return self._collect(array)

    def spread(self, array):
        """The way back, with the neighbours' lines around; without fine lines nothing comes."""
        return self._spread(array)


class Move:
    """Lines of a grid from the ranks that hold them to those that want them (collective). `held` and
    `wanted` are (first, last) of every rank; a line is held once or, zero, by nobody."""

    def __init__(self, comm, held, wanted):
        self._comm = comm
        mine, needed = held[comm.rank], wanted[comm.rank]
        self._lines = needed[1] - needed[0]
        self._sent = _overlaps(mine, wanted)
        self._received = _overlaps(needed, held)

    def __call__(self, array):
        """The wanted lines, of the held ones; both (lines, nx), of any type."""
        array = np.ascontiguousarray(array)
        moved = np.zeros((self._lines, array.shape[1]), dtype=array.dtype)
        requests = [self._comm.Irecv(moved[part], rank) for rank, part in self._received.items()]
        requests += [self._comm.Isend(array[part], rank) for rank, part in self._sent.items()]
        MPI.Request.Waitall(requests)
        return moved


def _overlaps(mine, others):
    """{rank: slice of my lines} that the `others`' (first, last) share with `mine`."""
    first, last = mine
    shared = {rank: (max(first, begin), min(last, end)) for rank, (begin, end) in enumerate(others)}
    return {
        rank: slice(int(begin - first), int(end - first))
        for rank, (begin, end) in shared.items()
        if begin < end
    }
