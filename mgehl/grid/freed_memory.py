"""The memory of a large grid's arrays, given back to the system when they are freed.

A library that PETSc may bring along (SuperLU_DIST) tells the C library to keep all that a process ever had.
What is freed then lies in pieces between what is not, and a run holds half as much again as it uses.
"""

import ctypes

M_MMAP_THRESHOLD, M_MMAP_MAX = -3, -4
"""Of glibc's `mallopt`."""

LARGE_GRID = 10_000_000
"""Nodes from which on memory is saved at the cost of time: 2049 nodes a side would take a fifth longer."""

LARGE_ARRAY = 32 * 2**20
"""Bytes from which on an array has pages of its own: the most that glibc takes."""

MOST = 65_536
"""Arrays with pages of their own at a time: what glibc begins with."""


def is_large(mesh):
    """Whether memory is short on a grid."""
    return mesh.nodes > LARGE_GRID


def give_back_large_arrays():
    """From now on; without glibc nothing is done."""
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt:
        mallopt(M_MMAP_MAX, MOST)
        mallopt(M_MMAP_THRESHOLD, LARGE_ARRAY)
