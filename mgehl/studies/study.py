"""Cases, each solved once and a run directory before the next begins; tables, pictures and a page.

DIRECTORY/
    runs/                     a run directory for each case
    *.csv, *.md, *.nc, *.png  tables, the same as arrays, and pictures
    report.html, study.json   all on one page, and what was asked for

A study is a module with `run(study)`, which makes rows of tables of what `Study.solved` returns. A sweep is
a study whose cases follow from axes.
"""

import time
import tomllib
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import tomli_w
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import OutputError, UserError, one_line
from mgehl.kinds.choice import value_of
from mgehl.output.checkpoint import is_begun
from mgehl.output.directory import make_directory
from mgehl.output.files import CONFIGURATION, FIELDS, REPORT, csv_text, on_first_rank
from mgehl.output.laws import changed_laws, law_files, portable
from mgehl.output.lock import locked
from mgehl.output.pictures.titles import differing
from mgehl.output.report.page import render
from mgehl.output.report.study_report import study_report
from mgehl.output.solution import on_every_rank
from mgehl.output.stored import read_run, read_texts
from mgehl.output.study_directory import RUNS, StudyRecord, begin_study, clear_runs, finish_study
from mgehl.output.table import drawn, markdown, said
from mgehl.output.whole_file import write_whole
from mgehl.run import Watch, enter, run
from mgehl.saying import columns, complain, say
from mgehl.studies.case_names import directory_of
from mgehl.studies.catalogue import WHAT

PAPER = {"discretization": {"couette": "1B", "face_mobility": "arithmetic"}}
"""What the paper differences by."""

BEST = {"couette": "3B", "face_mobility": "linear-gap"}
"""What a smooth case of one's own is differenced by."""

PAPERS_DOMAIN = {"x": [-1.9, 1.3], "y": [-1.5, 1.5]}


@contextmanager
def begun(directory, comm, record, resume=True, force=False, **how):
    """The `Study` of a `StudyRecord` in a directory, which it holds; at the end its tables replace those
    that were there (collective). What has finished is taken with `resume`; all is solved anew with `force`.
    `how` are other fields of the `Study`."""
    on_first_rank(comm, make_directory, directory, resume or force)
    with locked(comm, directory):
        stage = comm.bcast(on_first_rank(comm, begin_study, directory, record, resume))
        if not resume:
            on_first_rank(comm, clear_runs, directory)
        study = Study(stage, comm, record, home=Path(directory), **how)
        yield study
        on_first_rank(comm, finish_study, directory, stage, resume)
        on_first_rank(comm, _write_page, study.home)
    if study.first and study.speak:
        say(f"results in {directory}")


def _write_page(directory):
    write_whole(directory / REPORT, render(study_report(directory, WHAT)))


@dataclass
class Study:
    """A study's directory and what is asked of it; `comm` solves its cases, rank 0 speaks and writes."""

    directory: Path
    """Of tables and pictures."""
    comm: MPI.Comm
    asked: StudyRecord
    speak: bool = True
    expected: int = 0
    """How many cases there will be at the least, for the time left."""
    settings: dict = field(default_factory=dict)
    """Nested tables that every case has besides its own, with authority over them."""
    home: Path | None = None
    """Directory of its runs where it is not that of tables and pictures."""
    watch: Watch = Watch(picture=False)
    """What accompanies every solve."""
    lost: dict = field(default_factory=dict, init=False)
    """Why cases have no answer at all, by their names."""
    failures: int = field(default=0, init=False)
    """Cases that had to converge and did not."""
    _done: int = field(default=0, init=False)
    _started: float = field(default_factory=time.perf_counter, init=False)

    def __post_init__(self):
        self.home = self.home or self.directory

    @property
    def first(self):
        """True on the rank that writes; fields of solutions are whole there."""
        return self.comm.rank == 0

    def drawn(self, draw, cases, seed):
        """What `draw(cases, seed)` finds by chance: so many, by this seed, unless others are asked for."""
        return draw(self.asked.cases or cases, seed if self.asked.seed is None else self.asked.seed)

    def solved(self, cases, must_converge=True):
        """Solve configurations, {name: nested tables}, one after the other; yield (name, `Solution`). One
        that cannot be solved is said, remembered in `lost` and passed. Raises ConfigError beforehand."""
        for tables in cases.values():
            self.config(tables)
        self.expected = max(self.expected, self._done + len(cases))
        for name, tables in cases.items():
            solution = self.passed(name, self.solve, name, tables, must_converge)
            if solution:
                yield name, solution

    def passed(self, name, solve, *arguments):
        """What a case's `solve` returns; None without an answer, which is said and remembered."""
        try:
            return solve(*arguments)
        except OutputError:
            raise
        except UserError as error:
            self.lost[name] = str(error)
            self.failures += 1
            self._done += 1
            if self.first:
                complain(f"{name}: not solved: {error}")
            return None

    def solve(self, title, tables, must_converge=True):
        """The `Solution` of the configuration of nested `tables`, without bands unless these ask for them.
        Where a case without a solution is an answer, too, it does not make the study a failure."""
        config = self.config(tables)
        solution = self.run(self.path_of(title, config.as_toml_tables()), config)
        self.failures += must_converge and not solution.result.converged
        self.tell(title, solution.result, must_converge)
        return solution

    def config(self, tables):
        """The configuration of a case; its films get no bands where the tables say nothing of them."""
        tables = merged(tables, self.settings)
        config = config_from_tables(tables)
        if "error" in tables.get("solver", {}) or not config.kind.is_loaded:
            return config
        return replace(config, solver=replace(config.solver, error=False))

    def path_of(self, title, description):
        """The run directory of a case whose answer depends on a `description`, plain data (collective)."""
        return self.comm.bcast(directory_of(self.home / RUNS, title, description) if self.first else None)

    def run(self, path, config, start=None):
        """The `Solution` of a configuration, with its fields on rank 0; from its directory if there.

        Else it goes on there, or is solved from the `start` (collective). Raises OutputError where the run
        there is of another configuration.
        """
        case = enter(config, self.comm)
        if not self.comm.bcast(on_first_rank(self.comm, _has_finished, path, case.config)):
            on_first_rank(self.comm, make_directory, path, True)
            with locked(self.comm, path):
                run(case, path, self.comm, self.watch, start if case.contact.is_loaded else None)
        found = on_every_rank(self.comm, on_first_rank(self.comm, read_run, path))
        # Laws of a run that is read are anybody's, and not run; these are the case's own.
        return replace(found, contact=case.contact) if law_files(case.config) else found

    def tell(self, title, result, must_converge=True):
        """Say what came of a finished case, and how long the others will take."""
        self._done += 1
        if self.first and self.speak:
            none = "NOT CONVERGED" if must_converge else "no solution, which is an answer here"
            what = "" if result.converged else f"  {verdict(result, none)}"
            left = (time.perf_counter() - self._started) / self._done * max(self.expected - self._done, 0)
            say(f"{self._done:3d}/{max(self.expected, self._done)}  {left:5.0f} s left  {title}{what}")

    def write_table(self, name, rows, shown=(), names=1):
        """Write rows (dictionaries of text) as NAME.csv and NAME.md, if there are any, and print them, or
        what is to be `shown` of their columns that are not empty; the first `names` of them name a row
        (collective)."""
        on_first_rank(self.comm, self._write_table, name, list(rows), shown, names)

    def draw(self, name, function, *arguments):
        """Draw NAME.png, the figure that `function(*arguments)` returns, on rank 0 (collective)."""
        on_first_rank(self.comm, self._draw, name, function, arguments)

    def _write_table(self, name, rows, shown, names):
        if not rows:
            return
        heads = list(dict.fromkeys(head for row in rows for head in row))
        rows = [dict.fromkeys(heads, "") | row for row in rows]
        write_whole(self.directory / f"{name}.csv", csv_text(rows))
        write_whole(self.directory / f"{name}.md", markdown(rows, heads) + "\n")
        if self.speak:
            shown = [head for head in shown if any(row.get(head) for row in rows)] or heads
            say(f"\n{name}\n\n{drawn(rows, shown, columns(), names)}\n")

    def _draw(self, name, function, arguments):
        from mgehl.output.pictures.style import applied, save  # matplotlib is slow to import

        path = self.directory / f"{name}.png"
        try:
            with applied():
                save(function(*arguments), path)
        except Exception as error:  # what matplotlib raises is anybody's guess; the tables are there
            complain(f"{path.name}: cannot be drawn: {one_line(error)}")
        else:
            if self.speak:
                say(f"picture {path.name}")


def _has_finished(path, config):
    """Whether the run of this configuration is there."""
    if is_begun(path) or not (path / FIELDS).exists():
        return False
    try:
        known = read_texts(path)[CONFIGURATION]
    except OutputError as error:
        raise OutputError(f"{error}; without {path} it is solved anew") from None
    there, here = (tomllib.loads(text) for text in (known, tomli_w.dumps(portable(config))))
    if keys := differing([there, here]):
        old, new = (said(value_of(tables, keys[0])) or "unset" for tables in (there, here))
        other = f"is of another configuration, {keys[0]} = {old} and not {new}"
        raise OutputError(f"--resume: {path} {other}; choose another with --out")
    if changed := changed_laws(path, config):
        complain(f"{path}: is solved anew, for {', '.join(changed)} changed since it was")
    return not changed


def verdict(result, otherwise="NOT CONVERGED"):
    """Converged, or in doubt or `otherwise` and why."""
    if result.converged:
        return "converged"
    return f"{result.doubt if result.settled else otherwise}: {result.reason}"


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
