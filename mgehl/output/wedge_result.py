"""The result of a wedge bearing as one record. Its fields are result.json's."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, WALL
from mgehl.output.film_error import FilmError, no_band
from mgehl.output.result import Overlap
from mgehl.output.words import bearing_words
from mgehl.solver.mass import Mass, account
from mgehl.solver.verification import closed_face_flow, flux_imbalance

GIVEN = no_band("the gap of a rigid bearing is given")


@dataclass(frozen=True)
class WedgeResult:
    """Everything result.json holds; P and the load as in [Liu eq. 44], lengths in mm.

    Loads are above the ambient pressure.
    """

    converged: bool
    reason: str
    load: float
    """Integral of P over X and Y."""
    load_N: float
    max_P: float
    min_P: float
    max_pressure_MPa: float
    residual: float
    flux_imbalance: float
    closed_face_flow: float
    """Largest flow through a face that contact closes: what leaks through solid."""
    solid_nodes: int
    cavitated_nodes: int
    linear_iterations: int
    wall_s: float
    ranks: int
    versions: dict
    error: FilmError = GIVEN
    torn_filling: float | None = None
    """Mean part of the gap that cavities hold oil in; None without any."""
    mass: Mass | None = None
    """The account of the oil; None in older results."""

    @property
    def settled(self):
        """As `converged`: there is no inequality besides the equations."""
        return self.converged

    @property
    def overlap(self):
        """None: the gap is given."""
        return Overlap(0, 0.0)

    def words(self, verbose=True):
        """The answer and whether it can be trusted: everything, or only what most want to know."""
        return bearing_words(self)

    def __str__(self):
        return self.words()


def summarise_wedge(problem, outcome, wall_s, versions):
    """Evaluate the final state and put the `WedgeResult` together (collective)."""
    grid, bearing, state = problem.grid, problem.contact, outcome.state
    evaluation = problem.evaluate(state)
    residual = problem.rms(problem.residual(evaluation, state.status))
    across = bearing.width / bearing.y_scale if grid.mesh.is_line else 1.0
    solid, torn = state.status == CONTACT, state.status == CAVITATED
    load = across * problem.load(np.where(solid, state.P, state.P - bearing.ambient))
    largest = grid.max(state.P)
    pad = (evaluation.status != BOUNDARY) & (evaluation.status != WALL)
    # Half of what the plate would carry along is dragged through a gap.
    unit = 0.5 * bearing.speed * bearing.film_scale * bearing.y_scale * across
    cavities = grid.count(torn)
    return WedgeResult(
        converged=outcome.converged,
        reason=outcome.reason,
        load=load,
        load_N=load * bearing.pressure_scale * bearing.x_scale * bearing.y_scale,
        max_P=largest,
        min_P=grid.min(state.P),
        max_pressure_MPa=1e-6 * bearing.pressure_scale * largest,
        residual=residual,
        flux_imbalance=flux_imbalance(problem, evaluation),
        closed_face_flow=closed_face_flow(problem, evaluation),
        solid_nodes=grid.count(solid),
        cavitated_nodes=cavities,
        linear_iterations=sum(step.linear_iterations for step in outcome.cycles),
        wall_s=wall_s,
        ranks=grid.comm.size,
        versions=versions,
        torn_filling=grid.sum(state.filling[torn].sum()) / cavities if cavities else None,
        mass=account(problem, state, evaluation, pad, unit),
    )
