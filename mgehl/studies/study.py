"""What every study does: solve named configurations, keep their points, write tables and pictures.

A study is a module with `run(study)`: named configurations go to `Study.solved`, what comes back becomes
rows of tables, and pictures where there are any.
"""

import time
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import log2
from pathlib import Path

from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, UserError, one_line
from mgehl.output.files import on_first_rank
from mgehl.output.stored import record_of, solution_from
from mgehl.output.table import drawn, markdown, write_csv
from mgehl.output.whole_file import write_whole
from mgehl.run import solve
from mgehl.saying import columns, complain, say
from mgehl.studies.cache import PointCache, key_of

PAPER = {"discretization": {"couette": "1B", "face_mobility": "arithmetic"}}
"""What the paper differences by."""

BEST = {"couette": "3B", "face_mobility": "linear-gap"}
"""What a smooth case of one's own is differenced by."""

PLAUSIBLE_ORDERS = (0.5, 3.0)
"""Orders outside of this range come from values that are too far from their limit to tell it."""

PAPERS_DOMAIN = {"x": [-1.9, 1.3], "y": [-1.5, 1.5]}


@dataclass
class Study:
    """A study's directory and what was asked of it; `comm` solves its cases, rank 0 speaks and writes."""

    directory: Path
    comm: MPI.Comm
    nodes: tuple = ()
    """Nodes along each side, coarsest first; empty for the study's own choice."""
    speak: bool = True
    cases: int = 0
    """How many there will be at the least, for the time left."""
    branch: str = "both"
    """Branches that are wanted of a study of both: "down", "up" or "both"."""
    settings: dict = field(default_factory=dict)
    """Nested tables that every case has besides its own, with authority over them."""
    wanted: int | None = None
    """Random cases of studies that draw some; None for its own choice."""
    seed: int | None = None
    """By which it draws them."""
    resume: bool = True
    """Whether what has finished is taken as it is."""
    home: Path | None = None
    """Directory of its points where it is not that of tables and pictures."""
    lost: dict = field(default_factory=dict, init=False)
    """Why cases have no answer at all, by their names."""
    failures: int = field(default=0, init=False)
    """Cases that had to converge and did not."""
    _done: int = field(default=0, init=False)
    _started: float = field(default_factory=time.perf_counter, init=False)

    @property
    def first(self):
        """True on the rank that writes; fields of solutions are whole there."""
        return self.comm.rank == 0

    def solved(self, cases, **how):
        """Solve configurations, {name: nested tables}, one after the other; yield (name, `Solution`).

        A case that cannot be solved is said, remembered in `lost` and passed. Raises ConfigError before the
        first is solved if one cannot be used. `how` as of `solve`.
        """
        for tables in cases.values():
            self.config(tables)
        self.cases = max(self.cases, self._done + len(cases))
        for name, tables in cases.items():
            try:
                solution = self.solve(name, tables, **how)
            except OutputError:
                raise
            except UserError as error:
                self.lose(name, error)
            else:
                yield name, solution

    def solve(self, title, tables, must_converge=True, with_fields=True):
        """Solve the configuration of nested `tables`; return the `Solution`.

        Films get no bands unless the tables ask for them: studies compare grids themselves. Where a case
        without a solution is an answer, too, it does not make the study a failure. Without fields, points
        are small.
        """
        config = self.config(tables)
        key = key_of(config.as_toml_tables())
        solution = self.cache.load(key, solution_from)
        if solution is None:
            solution = solve(config, self.comm)
            solution = solution if with_fields else solution.shared()
            self.cache.store(key, partial(record_of, solution))
        self.failures += must_converge and not solution.result.converged
        self.tell(title, solution.result, must_converge)
        return solution

    def lose(self, name, error):
        """Say and remember why a case has no answer at all."""
        self.lost[name] = str(error)
        self.failures += 1
        self._done += 1
        if self.first:
            complain(f"{name}: not solved: {error}")

    def config(self, tables):
        """The configuration of a case; its films get no bands where the tables say nothing of them."""
        tables = merged(tables, self.settings)
        config = config_from_tables(tables)
        if "error" in tables.get("solver", {}) or not config.kind.is_loaded:
            return config
        return replace(config, solver=replace(config.solver, error=False))

    @cached_property
    def cache(self):
        """Its finished points."""
        return PointCache(self.home or self.directory, self.comm)

    def tell(self, title, result, must_converge=True):
        """Say what came of a finished case."""
        none = "NOT CONVERGED" if must_converge else "no solution, which is an answer here"
        self._tell(title, "" if result.converged else f"  {verdict(result, none)}")

    def _tell(self, title, what):
        """Say a case, and how long the others will take."""
        self._done += 1
        if self.first and self.speak:
            spent = time.perf_counter() - self._started
            left = spent / self._done * max(self.cases - self._done, 0)
            say(f"{self._done:3d}/{max(self.cases, self._done)}  {left:5.0f} s left  {title}{what}")

    def write_table(self, name, rows, shown=()):
        """Write rows (dictionaries of text) as NAME.csv and NAME.md, and print them, or what is to be
        `shown` of their columns (collective).

        Columns are those of all rows; nothing is written of no row.
        """
        on_first_rank(self.comm, self._write_table, name, rows, shown)

    def draw(self, name, function, *arguments):
        """Draw NAME.png by `function(path, *arguments)` on rank 0 (collective)."""
        on_first_rank(self.comm, self._draw, name, function, arguments)

    def _write_table(self, name, rows, shown):
        if not rows:
            return
        heads = list(dict.fromkeys(head for row in rows for head in row))
        rows = [dict.fromkeys(heads, "") | row for row in rows]
        try:
            write_csv(self.directory / f"{name}.csv", rows)
        except OSError as error:
            raise OutputError(f"{self.directory}: cannot be written: {error}") from None
        write_whole(self.directory / f"{name}.md", markdown(rows, heads) + "\n")
        if self.speak:
            shown = [head for head in shown if head in heads] or heads
            say(f"\n{name}\n\n{drawn(rows, shown, columns())}\n")

    def _draw(self, name, function, arguments):
        path = self.directory / f"{name}.png"
        try:
            function(path, *arguments)
        except Exception as error:  # what matplotlib raises is anybody's guess; the tables are there
            complain(f"{path}: cannot be drawn: {one_line(error)}")
        else:
            if self.speak:
                say(f"picture {path.name}")


def verdict(result, otherwise="NOT CONVERGED"):
    """Converged, or in doubt or `otherwise` and why."""
    if result.converged:
        return "converged"
    return f"{result.doubt if result.settled else otherwise}: {result.reason}"


def yes(holds):
    """As tables have it."""
    return "yes" if holds else "no"


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
