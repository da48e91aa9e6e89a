"""What every study does: solve cases one after the other, say so, write tables and pictures."""

import time
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import log2
from pathlib import Path

from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, one_line
from mgehl.output.drawn_table import drawn
from mgehl.output.files import on_first_rank
from mgehl.output.solution_record import record_of, solution_from
from mgehl.output.table import markdown, write_csv
from mgehl.output.whole_file import write_whole
from mgehl.run import solve
from mgehl.saying import columns, complain, say
from mgehl.studies.cache import PointCache, key_of

PAPER = {"discretization": {"couette": "1B", "face_mobility": "arithmetic"}}
"""What the paper differences by, and a study that does not say otherwise."""

BEST = {"couette": "3B", "face_mobility": "linear-gap"}
"""What a case of one's own is differenced by."""

PLAUSIBLE_ORDERS = (0.5, 3.0)
"""Orders outside of this range come from values that are too far from their limit to tell it."""

PAPERS_DOMAIN = {"x": [-1.9, 1.3], "y": [-1.5, 1.5]}


@dataclass
class Study:
    """A study's directory and grids; cases are solved on `comm`, rank 0 speaks and writes."""

    directory: Path
    comm: MPI.Comm
    nodes: tuple = ()
    """Nodes along each side, coarsest first; empty for the study's own choice."""
    speak: bool = True
    cases: int = 0
    """How many cases there will be. A study that sets it before the first tells the time left."""
    failures: int = field(default=0, init=False)
    """Cases that had to converge and did not."""
    branch: str = "both"
    """Branches that are wanted of a study of both: "down", "up" or "both"."""
    mean: str = "arithmetic"
    """Mean of the mobility, for a study that follows one."""
    home: Path | None = None
    """Directory of its points where it is not that of tables and pictures."""
    boundary_film: float | None = None
    """In m, for study rough; None for its own choice."""
    wanted: int | None = None
    """Random cases of studies that draw some; None for its own choice."""
    seed: int | None = None
    """By which it draws them."""
    _done: int = field(default=0, init=False)
    _started: float = field(default_factory=time.perf_counter, init=False)

    @property
    def first(self):
        """True on the rank that writes; fields of solutions are whole there."""
        return self.comm.rank == 0

    def solve(self, title, tables, must_converge=True):
        """Solve the configuration of nested `tables`; return the `Solution`.

        Films get no bands unless the tables ask for them: studies compare grids themselves. Where a case
        without a solution is an answer, too, it does not make the study a failure.
        """
        config = _config(tables)
        key = key_of(config.as_toml_tables())
        solution = self.cache.load(key, solution_from)
        if solution is None:
            solution = solve(config, self.comm)
            self.cache.store(key, partial(record_of, solution))
        self.failures += must_converge and not solution.result.converged
        self.tell(title, solution.result, must_converge)
        return solution

    @cached_property
    def cache(self):
        """Its finished points."""
        return PointCache(self.home or self.directory, self.comm)

    def tell(self, title, result, must_converge=True):
        """Count a finished case and say how long the others will take."""
        self._done += 1
        if self.first and self.speak:
            spent = time.perf_counter() - self._started
            left = spent / self._done * max(self.cases - self._done, 0)
            # How many points a bracket takes is not known before.
            when = f"/{self.cases}  {left:5.0f} s left" if self.cases else f"  after {spent:5.0f} s"
            say(f"{self._done:3d}{when}  {title}{_verdict(result, must_converge)}")

    def write_table(self, name, rows):
        """Write rows (dictionaries of text) as NAME.csv and NAME.md, and print them (collective)."""
        on_first_rank(self.comm, self._write_table, name, rows)

    def draw(self, name, function, *arguments):
        """Draw NAME.png by `function(path, *arguments)` on rank 0 (collective)."""
        on_first_rank(self.comm, self._draw, name, function, arguments)

    def _write_table(self, name, rows):
        text = markdown(rows, list(rows[0]))
        try:
            write_csv(self.directory / f"{name}.csv", rows)
        except OSError as error:
            raise OutputError(f"{self.directory}: cannot be written: {error}") from None
        write_whole(self.directory / f"{name}.md", text + "\n")
        if self.speak:
            say(f"\n{name}\n\n{drawn(rows, list(rows[0]), columns())}\n")

    def _draw(self, name, function, arguments):
        path = self.directory / f"{name}.png"
        try:
            function(path, *arguments)
        except Exception as error:  # what matplotlib raises is anybody's guess; the tables are there
            complain(f"{path}: cannot be drawn: {one_line(error)}")
        else:
            if self.speak:
                say(f"picture {path.name}")


def _config(tables):
    """The configuration of a case; its films get no bands where the tables say nothing of them."""
    config = config_from_tables(merged(PAPER, tables))
    if "error" in tables.get("solver", {}) or not config.kind.is_loaded:
        return config
    return replace(config, solver=replace(config.solver, error=False))


def _verdict(result, must_converge):
    """Words after a case that did not converge; empty where it did. A state that settled and breaks Eq. 2
    is called that. Where the study asks whether there is a solution, none is no failure.
    """
    if result.converged:
        return ""
    other = "NOT CONVERGED" if must_converge else "no solution, which is an answer here"
    return f"  {result.doubt.upper() if result.settled else other}: {result.reason}"


def verdict(found):
    """Converged, or not a result and why."""
    if found.converged:
        return "converged"
    return f"{found.doubt if found.settled else 'NOT CONVERGED'}: {found.reason}"


def papers_grid(nodes):
    """So many nodes a side on the domain of Liu's section 4.3."""
    return {"nodes": nodes, **PAPERS_DOMAIN}


def merged(*tables):
    """Nested tables put together, later ones first in authority."""
    result = {}
    for table in tables:
        for section, keys in table.items():
            result.setdefault(section, {}).update(keys)
    return result


def observed_order(coarse, fine):
    """Power of the spacing by which an error falls when that is halved."""
    return log2(abs(coarse) / abs(fine)) if coarse and fine else float("nan")


def richardson(values):
    """(limit, observed order) from the values on the last three grids, each twice as fine.

    NaN where the differences do not fall with one sign: there is no limit to see yet.
    """
    coarse, middle, fine = values[-3:]
    first, second = middle - coarse, fine - middle
    if second == 0.0 or not first / second > 1.0:
        return float("nan"), float("nan")
    ratio = first / second
    return fine + second / (ratio - 1.0), log2(ratio)


def plausible(order):
    """True of an observed order that a second-order code may have on its way to the limit."""
    return PLAUSIBLE_ORDERS[0] <= order <= PLAUSIBLE_ORDERS[1]


def statistic(function, values, shown="{:.1f}"):
    """A mean, median or the like of some values, as a summary tells it; "none" where there are none."""
    values = list(values)
    return shown.format(function(values)) if values else "none"
