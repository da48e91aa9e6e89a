"""A contact at many values of its keys: each point starts from its neighbours and is a run of its own.

SWEEP/
    runs/001, ...             a run directory for each point, in the order in which they are solved
    sweep.csv, .md, .nc, .png one table, the same as arrays with a dimension for each key, and curves
    report.html               all on one page

A point that has no answer is said and passed; the next one starts from the last that has one.
"""

from mgehl.output.files import on_first_rank
from mgehl.output.laws import portable
from mgehl.output.quantities import Told, read_told
from mgehl.output.study_directory import RUNS, StudyRecord
from mgehl.output.surroundings import versions
from mgehl.output.table import collect, said
from mgehl.studies.dataset import write_arrays
from mgehl.studies.neighbours import start_of
from mgehl.studies.points import WAYS
from mgehl.studies.study import begun

NEVER_THE_SAME = "wall s", "us a step and node"
"""Columns that a sweep leaves out: one that was killed and resumed has the same table."""

SHOWN = [
    "converged", "central nm", "mean gap nm", "load on solids", "friction", "convolutions", "why not",
]  # fmt: skip
"""Columns that are printed; the table has more."""


def swept(directory, comm, axes, points, watch, speak=True, asked=()):
    """Solve all points in a directory, or read what is there; write table, arrays, curves and a page.

    Collective; returns the `Study`. `asked` are the words of a command line. Raises OutputError where a run
    that is there is of another configuration.
    """
    record = StudyRecord("sweep", (points[0].config.grid.nodes,), comm.size, versions(), settings=asked)
    with begun(directory, comm, record, speak, watch=watch) as study:
        fill(study, study.home, axes, points)
    return study


def fill(study, directory, axes, points, name="sweep"):
    """The same in a directory of a `Study`, whose files are NAME.csv and others; return the `Told` runs
    (collective)."""
    from mgehl.output.pictures.curves import curves  # matplotlib is slow to import

    folder, behind, runs = directory / RUNS, [], []
    called = "" if name == "sweep" else f"{name}, "
    study.cases = max(study.cases, len(points))
    for point in points:
        title, path = f"{called}{_title(axes, point)}", folder / point.run
        solution = study.passed(title, study.run, path, point.config, start_of(behind, axes, point))
        if not solution:
            runs.append(Told(portable(point.config), None, study.lost[title]))
            continue
        study.failures += not solution.result.converged
        study.tell(title, solution.result)
        runs.append(study.comm.bcast(on_first_rank(study.comm, read_told, path)))
        behind = [*behind[-1:], (point, solution)] if solution.result.settled else behind
    rows = study.comm.bcast(on_first_rank(study.comm, _rows, folder, axes, points, runs))
    study.write_table(name, rows, [axis.key for axis in axes] + SHOWN)
    on_first_rank(study.comm, write_arrays, study.directory / f"{name}.nc", axes, points, runs)
    study.draw(name, curves, runs, axes[0].key, [WAYS[p.way] for p in points if points[-1].way])
    return runs


def _title(axes, point):
    words = [point.config.said(axis.key) for axis in axes]
    return ", ".join(words) + (f", {WAYS[1]}" if point.way else "")


def _rows(folder, axes, points, runs):
    """Text of all points, in order."""
    keys = [axis.key for axis in axes]
    there = [folder / point.run for point, told in zip(points, runs, strict=True) if told.result]
    found = {row["run"]: row for row in (collect(there, keys) if there else [])}
    rows = []
    for point, told in zip(points, runs, strict=True):
        row = {"run": point.run} | ({"way": WAYS[point.way]} if points[-1].way else {})
        row |= {key: said(point.config.value(key)) for key in keys}
        row |= found.get(point.run, {"converged": "no"})
        why = told.result["reason"] if told.result else told.why
        rows.append(row | {"why not": "" if told.converged else why})
    return [{name: text for name, text in row.items() if name not in NEVER_THE_SAME} for row in rows]
