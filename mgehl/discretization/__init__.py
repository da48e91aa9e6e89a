"""Finite volumes on one uniform grid: plain arrays in and out, no PETSc, no MPI.

Arrays are lines by nodes, ``[j, i]``: j along Y, i along X (contiguous). A *ghosted* array carries `HALO`
lines more on each side in Y: the neighbouring ranks', or unused ones outside the domain.
"""
