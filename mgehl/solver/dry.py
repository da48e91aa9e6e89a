"""The dry contact of bodies that no formula knows: what a film is started from.

Conjugate gradients on the pressed nodes, a node entering where the bodies overlap and leaving where
they pull [Polonsky and Keer 1999]. Two convolutions a step.
"""

import numpy as np

TOLERANCE = 1e-3
"""Relative change of the pressure by a step: a first guess needs no more. From 1e-4 to 1e-2 the same work
within 2 % for a coated ball on 129 nodes."""

MAX_STEPS = 100
"""A limit that nothing should reach: the coated ball's guess takes fewer than 6."""


def dry_pressure(problem, P):
    """Pressure (lines, nx) with which the bodies of a `ContactProblem` carry its load; `P` is a guess."""
    grid, load = problem.grid, problem.contact.load_integral
    P = np.where(problem.boundary, 0.0, P)
    P *= load / problem.load(P)
    direction, before, kept = np.zeros(grid.shape), 1.0, 0.0
    for _ in range(MAX_STEPS):
        pressed = P > 0.0
        gap = _about_mean(grid, problem.gap(P, 0.0), pressed)
        square = grid.sum((gap[pressed] ** 2).sum())
        direction = np.where(pressed, gap + kept * square / before * direction, 0.0)
        response = _about_mean(grid, problem.deflection(direction), pressed)
        step = grid.sum((gap * direction)[pressed].sum()) / grid.sum((response * direction)[pressed].sum())
        new = np.maximum(P - step * direction, 0.0)
        overlap = (new == 0.0) & (gap < 0.0) & ~problem.boundary
        new[overlap] = -step * gap[overlap]
        kept, before = (0.0 if grid.count(overlap) else 1.0), square
        new *= load / problem.load(new)
        change = problem.load(np.abs(new - P)) / load
        P = new
        if change < TOLERANCE:
            break
    return P


def _about_mean(grid, array, nodes):
    """The array less its mean over some nodes, which the approach of the bodies stands for."""
    return array - grid.sum(array[nodes].sum()) / grid.count(nodes)
