"""Grids on the ranks: x-lines stay whole on a rank, so line solves are local."""
