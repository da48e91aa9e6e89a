"""What bodies that approach each other squeeze out beyond the domain, and what that carries of the load.

Outside the oil between rigid bodies resists the approach (`mgehl.model.far_field`), where the film reaches
the side of the domain: what is torn there has no pressure. Under a load that grows the gap at the sides
falls by less than H0: there bodies yield, too.
"""

import numpy as np

from mgehl.discretization.status import LUBRICATED

THINNEST = 1e-6
"""Film in units of H for which that is reckoned at the least: it hardly depends on the film."""


class Beyond:
    """The oil around the domain of a `ContactProblem`, which is told what it does in a step."""

    def __init__(self, problem):
        self._problem = problem
        self._seen = _seen(problem)

    def resist(self, state, dT, growth):
        """Let it resist in a step of length dT from a state, in which the load grows by a factor
        (collective)."""
        problem = self._problem
        yields = self._at_sides(state.H - state.H0 - problem.undeformed)
        problem.resistance = self._resistance(state, dT) * self._at_sides(state.status == LUBRICATED)
        problem.H0_before = state.H0 - yields * (growth - 1.0)

    def _resistance(self, state, dT):
        """The load beyond the domain, in units of the integral of P, over what H0 falls by in a step."""
        problem, flowing = self._problem, self._problem.flowing
        film = max(problem.films(state)[0], THINNEST) * flowing.film_scale
        fall = flowing.film_scale / (dT * flowing.x_scale / problem.contact.speed)
        load = flowing.squeezed_beyond(problem.grid.mesh, film) * fall
        return load / problem.contact.load * problem.contact.load_integral

    def _at_sides(self, values):
        """Mean of `values`, (lines, nx), over the sides."""
        return self._problem.grid.sum(np.vdot(self._seen, values))


def _seen(problem):
    """How much of what is squeezed out beyond the domain passes each node beside its sides, (lines, nx): a
    way along a side counts as it is seen from the centre, and the load beyond falls with the gap's square.
    """
    grid, mesh = problem.grid, problem.grid.mesh
    beside_x, beside_y = grid.beside_boundary()
    along = beside_x * np.abs(grid.X) * mesh.dY + beside_y * np.abs(grid.Y) * mesh.dX
    gap = problem.contact.smooth_gap(*np.broadcast_arrays(grid.X, grid.Y))
    seen = np.divide(along, gap**2, out=np.zeros(grid.shape), where=along > 0.0)
    return seen / grid.sum(seen.sum())
