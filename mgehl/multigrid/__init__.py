"""Multigrid for the bordered Jacobian: PETSc's PCMG with a distributive line smoother."""
