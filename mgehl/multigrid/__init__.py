"""Multigrid for the bordered Jacobian: an F-cycle with a distributive line smoother, for flexible GMRES."""
