"""All that the solver may be told: of Newton's method, of steps in time, and together.

What is a key of the configuration, too, has that key's default.
"""

from dataclasses import dataclass, field, replace

from mgehl.config_sections import SolverSection
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.relaxation import RelaxationSettings
from mgehl.solver.squeeze import SQUEEZE

COARSE_TOLERANCE = 1e-4
"""Residual at which a coarse grid has served its purpose; 3e-5 to 1e-3 take the same work."""

PASSING_TOLERANCE = 1e-3
"""Residual at which a solve on the way from one speed to another is left, though its sets still change:
1e-2 may leave the next step with too little film, 1e-4 takes half as much work again."""


@dataclass(frozen=True)
class NewtonSettings:
    """Tolerances and limits of Newton's method on one grid."""

    tolerance: float = SolverSection.tolerance
    """For the rms residual and the load error."""
    certain: float = 0.0
    """Residual below which sets that still change are no reason to go on."""
    max_steps: int = SolverSection.max_steps
    idle_steps: int | None = SolverSection.idle_steps
    """Steps in a row that may leave more than `judge.STUCK` of the least residual; None: the recipe's."""
    max_work: int = SolverSection.max_work
    """Convolutions of all solves of a run, in those of the finest grid, after which none goes on."""
    spreading_steps: int | None = None
    """Steps in which contact may spread before a solve is given up; None: any."""
    linear_tolerance: float = SolverSection.linear_tolerance
    """Relative tolerance of GMRES in a step: looser ones take more steps of fewer iterations."""
    max_pressure_step: float = 0.3
    """Largest change of a pressure in one step, over p_h. A longer step is shortened as a whole: near
    a fold it leads astray."""
    over_largest: bool = False
    """Whether it is over the largest pressure, where that is more than p_h."""
    by_film: bool = False
    """Whether the film's change bounds steps, too: where it closes as continuously as it opens."""
    squeeze: float = SolverSection.squeeze
    """Rate of implicit time steps per rms residual and cell (`solver.squeeze`); 0 for Newton's own."""
    by_reduced_pressure: bool = False
    """Whether pressures fall as the viscosity lets them (`step_length.as_oil_flows`): in time in every
    step, else after one that gained nothing. Of peaks that touch that finds as many as it loses."""
    eliminates: bool = False
    """Whether few nodes that make up most of the residual are solved by themselves between two steps."""
    passes_on: bool = False
    """Whether contact opens with all contact behind it (`Partition`), and at once (`layers`)."""
    in_time: bool = False
    """Whether the state is one of many, near the one before: it is solved no further than is asked."""


@dataclass(frozen=True)
class TimeSettings:
    """How a run in time is solved."""

    step: float | None
    """Steps in s; None: as `Pace` chooses."""
    part: float
    """Residual that a step may leave, over that with which it begins."""
    least: float
    """Residual below which nothing is asked."""


@dataclass(frozen=True)
class SolverSettings:
    """All that the solver may be told."""

    by_newton: bool = True
    """Whether by Newton's method, not by the paper's relaxation on the finest grid alone."""
    scheme: Scheme = field(default_factory=Scheme)
    start: str = SolverSection.start
    """The user's "film" or "contact", or another first guess of `mgehl.solver.recipe`."""
    first_nodes: int = SolverSection.first_nodes
    """Nodes along X of the first grid of the nested iteration, and of a contact start's fluid."""
    inlet_cells: float = SolverSection.inlet_cells
    """Cells that the inlet must have on the coarse grids: the speed is raised until it has. Fewer (1.4)
    lead to spurious contact that poisons finer grids."""
    newton: NewtonSettings = field(default_factory=NewtonSettings)
    cycle: CycleSettings = field(default_factory=CycleSettings)
    relaxation: RelaxationSettings = field(default_factory=RelaxationSettings)
    time: TimeSettings | None = None
    """Of a run in time."""
    error: bool = SolverSection.error
    """Whether coarser grids are solved, too, to tell how far the films are from their limit."""

    def limited(self, **newton):
        """The same with other limits of Newton's method."""
        return replace(self, newton=replace(self.newton, **newton))

    def roughly(self):
        """The same for solves whose answers only lead to others, as those of coarse grids."""
        return self.limited(tolerance=COARSE_TOLERANCE)

    def in_passing(self):
        """The same for solves that are only on the way to the next one on their grid."""
        return self.limited(tolerance=PASSING_TOLERANCE, certain=PASSING_TOLERANCE)

    def squeezed(self):
        """The same by time steps: with a squeeze of `SQUEEZE` at the least."""
        return self.limited(squeeze=max(self.newton.squeeze, SQUEEZE))
