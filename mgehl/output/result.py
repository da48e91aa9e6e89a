"""The result of a run as one record: films, verdicts, work. Its fields are result.json's."""

from dataclasses import dataclass, field

from mgehl.model.contact import Groups
from mgehl.output.dry_error import DryError
from mgehl.output.film_error import NOT_ASKED, FilmError
from mgehl.output.friction_result import FrictionResult
from mgehl.output.mixed_result import MixedResult
from mgehl.output.resolution import Resolution
from mgehl.output.surface import SurfaceOnGrid
from mgehl.output.words import result_words
from mgehl.solver.gaps import NARROW
from mgehl.solver.inequality import Inequality
from mgehl.solver.mass import CLOSED, Mass
from mgehl.solver.verification import NOT_SEEN, Edge


@dataclass(frozen=True)
class ContactResult:
    """The solid contact; node numbers count from 1, None without contact on that line."""

    nodes: int
    area_fraction: float
    load_fraction: float
    """Part of the load on nodes in contact, oil in layers included."""
    x_nodes: tuple | None
    y_nodes: tuple | None
    largest_gap_nm: float
    """Largest |H| of a contact node: what the zero-gap equation has left, or the boundary film's."""
    kept_gap_nm: float = 0.0
    """Gap that adsorbed layers keep between bodies in contact (contact.boundary_film)."""


@dataclass(frozen=True)
class Overlap:
    """Nodes outside of contact whose gap is negative: the unified equations leave some."""

    nodes: int
    largest_nm: float


@dataclass(frozen=True)
class MoesFilm:
    """Central and minimum film as (h/R_x)(2U)^(-1/2)."""

    central: float
    minimum: float


@dataclass(frozen=True)
class Work:
    """Convolutions in equivalents of one on the finest grid; Newton steps or sweeps on all grids."""

    convolutions: float
    steps: int


@dataclass(frozen=True)
class Making:
    """How a loaded contact's answer was made: what a `Result` tells of it, and no check asks."""

    work: Work
    wall_s: float
    versions: dict
    """Of what solved it, by their names."""


@dataclass(frozen=True)
class HertzResult:
    """What Hertz' formulas say of smooth half-spaces under the same load."""

    max_pressure_GPa: float
    approach_um: float
    """Of a line contact with the constant of a deflection that counts -ln|x/a|, as the computed one."""


@dataclass(frozen=True)
class Mean:
    """A mean over the last passage, and its difference from that over the one before, None where there was
    but one, and in older results. That tells nothing of grid and steps: `TimeError` does."""

    value: float
    between_passages: float | None = None


@dataclass(frozen=True)
class TimeError:
    """Half-widths of bands by columns of series.nc: the limit of ever finer grids and ever shorter steps
    lies within. A column that two grids tell too differently has none."""

    how: str
    means: dict[str, float] = field(default_factory=dict)
    """About those over the last passage."""
    whole: dict[str, float] = field(default_factory=dict)
    """About those over the whole run."""
    at_the_end: dict[str, float] = field(default_factory=dict)
    convolutions: float = 0.0
    """What the coarser grid took, in equivalents of one on the finest."""


@dataclass(frozen=True)
class TimeResult:
    """Of a run in time; the films and pressures beside it are those at its end."""

    end_s: float
    steps: int
    halved: int
    """Steps that had to be taken in parts."""
    largest_closure: float
    """Largest part of the stored oil that storage and flow leave open in a step."""
    largest_node: float
    """The same of a single node in the last step."""
    convolutions_a_step: float
    """Half of the steps took fewer."""
    passages: float
    """Hertz lengths that the slowest moving heights have gone; of smooth bodies the mean surface."""
    means: dict[str, Mean]
    """Over the last passage; none before the end of the first."""
    whole: dict[str, float] = field(default_factory=dict)
    """Means over the whole run where speed or load change, as over the cycle of a cam."""
    largest_shear_MPa: float = None
    """Of all steps; None in older results, as the two that follow."""
    most_pressure_GPa: float = None
    least_film_nm: float = None
    spikes: int = 0
    """Steps whose largest pressure is a spike that three nodes do not hold."""
    squeezed_beyond: float = 0.0
    """Of all steps the largest part of the load on what is squeezed out beyond the domain, below 0 in."""
    error: TimeError | None = None
    """The bands about its means; None in older results."""
    Sq_nm: float | None = None
    """Rms of the heights within the Hertz ellipse over the last passage; None of smooth bodies."""


@dataclass(frozen=True, kw_only=True)
class Result:
    """Everything result.json holds. What a contact has not, as a dry one has no film, is None here and left
    out there. (None, and no Optional: in result.json null is a number that is not finite.)
    """

    converged: bool
    """`settled`, Eq. 2 holds within pressures' error, no node makes oil, the contact lies in its domain, on
    enough nodes."""
    settled: bool
    """Sets, residual, load and complementarity hold; of dry contacts and bearings as `converged`."""
    reason: str

    # Of a loaded contact.
    max_pressure_GPa: float = None
    max_pressure_band_GPa: float = None
    """Half-width of the band about the largest pressure; None where there is none."""
    pressure_crest: float = None
    """By how much the pressure may be larger between nodes, over the largest; None without a fluid."""
    load_error: float = None
    complementarity_error: float = None
    """Of a dry contact the largest |gap| in contact, overlap elsewhere (units of H), or pull (p_h)."""
    contact: ContactResult = None
    overlap: Overlap = Overlap(0, 0.0)
    work: Work = None
    """Of a dry contact the steps are sets of pressed nodes."""
    wall_s: float
    ranks: int
    versions: dict
    error: FilmError = NOT_ASKED
    edge: Edge = NOT_SEEN

    # With a fluid; a bearing has not all of these.
    central_film_nm: float = None
    minimum_film_nm: float = None
    """The smallest gap of all nodes, contact and what lies outside the ellipse included."""
    residual: float = None
    residual_limit: float | None = None
    """Up to which it is an answer's: the tolerance, or more of thick films and by rounding; None in older
    results."""
    flux_imbalance: float = None
    cavitated_nodes: int = None
    mass: Mass | None = None
    """The account of the oil; None in older results."""
    pressure_inequality: Inequality | None = None
    """Compared at the interface, as the paper states it: `converged` asks for this."""
    other_inequality: Inequality | None = None
    """Compared between nodes on both sides of it, a cell apart: `converged` does not ask for this."""
    contradictions: list | None = None
    """Nodes that can be neither film nor contact, of an iteration whose sets cycle."""
    resolution: Resolution | None = None
    surface: SurfaceOnGrid | None = None
    """How well the grid shows a dry contact's surface; of lubricated ones `resolution` says so."""
    groups: Groups | None = None
    """By the oil's own viscosity, as `moes_film` and `formulas`: no heat of shear has thinned it."""
    moes_film: MoesFilm | None = None
    formulas: dict | None = None
    """Films that formulas predict, by name in nm: those made for such bodies, of oil with this density."""
    formulas_of: str = ""
    """Of which load, speed and direction of a run in time groups and formulas are; empty where of all."""
    mixed: MixedResult | None = None
    """Film and contact of rough bodies; None of smooth ones."""
    friction: FrictionResult | None = None
    """None in older results."""
    thermal_reduction: float = None
    """Part of the film that the heat of shear in the inlet leaves (Gupta); None: oil without the data."""
    is_thermally_reduced: bool = False
    """Whether the film has been solved with so much less viscosity."""
    time: TimeResult | None = None
    """Of a run in time; all else is of the state at its end."""
    recipe: dict | None = None
    """{choice: value} of `mgehl.solver.recipe`: how it was solved; None in older results."""

    # Of a loaded contact without a fluid.
    dry_error: DryError | None = None
    """Bands about its numbers; None in older results."""
    approach_um: float = None
    """Of the bodies, from where their smooth shapes would touch."""
    boundary_nodes: int = None
    """Nodes in contact beside the domain's boundary: there must be none."""
    hertz: HertzResult | None = None
    Sq_nm: float = None
    """Rms of the heights within the Hertz semi-axes, about their mean; 0 of smooth bodies."""

    # Of a rigid bearing: P and load as in [Liu eq. 44], lengths in mm; loads above the ambient pressure.
    load: float = None
    """Integral of P over X and Y."""
    load_N: float = None
    load_band_N: float | None = None
    """Half-width of the load's band; None where there is none: `load_band_how` says why, or by what."""
    load_band_how: str = ""
    drag_N: float = None
    """What drags the plate against its motion; None in older results, as the two that follow."""
    drag_power_W: float = None
    """That times the plate's speed."""
    pressure_centre_mm: float = None
    """X about which the load has no moment; None without a load."""
    max_P: float = None
    min_P: float = None
    max_pressure_MPa: float = None
    closed_face_flow: float = None
    """Largest flow through a face that contact closes: what leaks through solid."""
    solid_nodes: int = None
    linear_iterations: int = None
    torn_filling: float = None
    """Mean part of the gap that cavities hold oil in; None without any."""

    @property
    def doubt(self):
        """Of a state that settled and has not converged: what is wrong with it, in a few words."""
        if self.pressure_inequality.violations:
            return "Eq. 2 is broken"
        if self.mass and self.mass.made_share > CLOSED:
            return "oil is made"
        return self.edge.wrong[0] or "Eq. 2 is broken"

    @property
    def is_a_spike(self):
        """Whether the largest pressure is that of a spike which the grid does not hold."""
        return self.max_pressure_band_GPa is None and (self.pressure_crest or 0.0) > NARROW

    @property
    def verdict(self):
        """Whether it is an answer, in a few words: as titles have it."""
        if self.converged:
            return "converged"
        return f"settled, but {self.doubt}" if self.settled else "not converged"

    def words(self, verbose=True):
        """The answer and whether it can be trusted: everything, or only what most want to know."""
        return result_words(self, verbose)

    def __str__(self):
        return self.words()
