"""Grids on PETSc DMDAs: x-lines stay whole on a rank, so line solves are local."""
