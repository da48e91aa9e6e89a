"""A contact at many values of its keys: each point starts from its neighbours and is a run of its own,
runs/001, ... in the order of solving. What has no answer so is looked for once more from the point after
it, the last one first: runs/001-again, ...

sweep.csv, .md, .nc, .png are one table, the same as arrays with a dimension for each key, and curves;
report.html has all. A point that has no answer is said and passed.
"""

from dataclasses import dataclass, field
from functools import partial
from itertools import chain, pairwise
from math import log, nan
from pathlib import Path

import numpy as np

from mgehl.config import KEYS
from mgehl.errors import OutputError
from mgehl.output.files import on_first_rank
from mgehl.output.friction_result import strength_lines
from mgehl.output.laws import portable
from mgehl.output.netcdf import netcdf_file, put
from mgehl.output.quantities import Told, numbers_and_bands, read_told, told_at
from mgehl.output.study_directory import RUNS, StudyRecord
from mgehl.output.surroundings import versions
from mgehl.output.table import collect, said
from mgehl.output.whole_file import whole_file, writing
from mgehl.saying import mention
from mgehl.solver.recipe import A_STATE
from mgehl.solver.restart import Forecast
from mgehl.studies.points import WAYS
from mgehl.studies.study import begun

NEVER_THE_SAME = "wall s", "us a step and node"
"""Columns that a sweep leaves out: one that was killed and resumed has the same table."""

OF_FILMS = "central nm", "mean gap nm", "load on solids", "friction", "convolutions"
OF_DRY_BODIES = "largest pressure GPa", "approach um", "contact/Hertz area"
OF_BEARINGS = "load N", "largest pressure MPa"
"""Columns that are printed; the table has more."""

AGAIN = "-again"
"""What the name of a run ends with that started from the point after it."""

NEAR = 4.0
"""Ratio of two films, and of two steps along a key, within which what changes is forecast."""


def swept(directory, comm, axes, points, watch, speak=True, words=()):
    """Solve all points in a directory, or read what is there; write table, arrays, curves and a page.

    Collective; returns the `Study`. `words` are those of a command line. Raises OutputError where a run
    that is there is of another configuration, or of none of the points.
    """
    record = StudyRecord("sweep", (points[0].config.grid.nodes,), comm.size, versions(), settings=words)
    with begun(directory, comm, record, speak=speak, watch=watch) as study:
        fill(study, study.home, axes, points)
    return study


def fill(study, directory, axes, points, name="sweep"):
    """The same in a `Study`'s directory, in files NAME.csv, ...; return the `Told` runs (collective)."""
    from mgehl.output.pictures.curves import curves  # matplotlib is slow to import

    folder, called = directory / RUNS, "" if name == "sweep" else f"{name}, "
    on_first_rank(study.comm, _refuse_others, folder, points)
    study.expected = max(study.expected, len(points))
    walk = _Walk(study, folder, called, axes)
    walk.in_order(points)
    walk.once_more()
    runs, names = [each.told for each in walk.stops], [each.run for each in walk.stops]
    rows = study.comm.bcast(on_first_rank(study.comm, _rows, folder, axes, points, runs, names))
    shown = [axis.key for axis in axes] + ["converged", *_printed(points[0].config), "why not"]
    study.write_table(name, rows, shown, names=len(axes))
    if study.first and study.speak:
        _say_of_shear(runs)
        _say_of_ways([stop for stop in walk.stops if stop.point.way])
    on_first_rank(study.comm, write_arrays, study.directory / f"{name}.nc", axes, points, runs)
    study.draw(name, curves, runs, axes[0].key, [WAYS[p.way] for p in points if points[-1].way])
    return runs


def _printed(config):
    """Columns of such a contact that are printed."""
    if config.is_dry:
        return OF_DRY_BODIES
    return OF_FILMS if config.kind.is_loaded else OF_BEARINGS


@dataclass
class _Stop:
    """A `Point` that the walk has come to: what its run tells, and the name of that run."""

    point: object
    told: Told
    run: str


@dataclass
class _Walk:
    """Solves the points of a `Study` in a folder, each from one beside it (collective)."""

    study: object
    folder: Path
    called: str
    """What stands before the titles of its points."""
    axes: tuple
    stops: list = field(default_factory=list)
    """Of the points so far, solved or not, in order."""

    def in_order(self, points):
        """Solve points one after the other, each from those behind it."""
        behind = []
        for point in points:
            solution, stop = self._solved(point, point.run, start_of(behind, self.axes, point))
            self.stops.append(stop)
            behind = [*behind[-1:], (point, solution)] if stop.told.settled else behind

    def once_more(self):
        """Look for what was not found from the point after it, the last one first."""
        study = self.study
        for k in reversed(range(len(self.stops) - 1)):
            stop, after = self.stops[k : k + 2]
            was_tried = stop.told.result and not stop.told.settled
            config = stop.point.config
            if not was_tried or not after.told.settled or config.is_in_time or config.is_dry:
                continue
            study.expected += 1
            start = study.run(self.folder / after.run, after.point.config)
            _, again = self._solved(stop.point, f"{stop.point.run}{AGAIN}", start, ", again")
            study.failures -= 1  # a point fails once at the most
            self.stops[k] = again if again.told.settled else stop

    def _solved(self, point, run, start, more=""):
        """The `Solution` of a point, or None, and its `_Stop`."""
        study, title = self.study, f"{self.called}{_title(self.axes, point)}{more}"
        solution = study.passed(title, study.run, self.folder / run, point.config, start)
        if not solution:
            return None, _Stop(point, Told(portable(point.config), None, study.lost[title]), run)
        study.failures += not solution.result.converged
        study.tell(title, solution.result)
        told = study.comm.bcast(on_first_rank(study.comm, read_told, self.folder / run))
        return solution, _Stop(point, told, run)


def _say_of_ways(back):
    """Say how many of the stops on the way back began from nothing: there the ways say nothing."""
    recipes = (told_at(stop.told.result, "recipe.begins") for stop in back if stop.told.settled)
    anew = sum(begins is not None and begins != A_STATE for begins in recipes)
    if anew:
        mention(
            f"{anew} of {len(back)} points on the way back were solved from nothing, for the point before "
            "is too far: of these the two ways tell nothing"
        )


def _say_of_shear(runs):
    """Say of how many points the shear is more than oils bear, and what to think of that."""
    shears = (told_at(told.result, "friction.largest_shear_MPa") for told in runs)
    strong = list(chain.from_iterable(map(strength_lines, shears)))
    if strong:
        mention(f"in {len(strong)} of {len(runs)} points: {strong[0]}")


def _refuse_others(folder, points):
    """Raise OutputError where a folder has runs of other points besides: no table would tell of them."""
    there = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
    names = {point.run + more for point in points for more in ("", AGAIN)}
    if others := sorted(there - names):
        raise OutputError(f"--resume: {folder / others[0]} is of a longer sweep; choose another with --out")


def _title(axes, point):
    words = [point.config.said(axis.key) for axis in axes]
    return ", ".join(words) + (f", {WAYS[1]}" if point.way else "")


def _rows(folder, axes, points, runs, names):
    """Text of all points, in order; `names` are those of their runs."""
    keys = [axis.key for axis in axes]
    there = [folder / run for run, told in zip(names, runs, strict=True) if told.result]
    found = {row["run"]: row for row in (collect(there, keys) if there else [])}
    rows = []
    for point, told, run in zip(points, runs, names, strict=True):
        row = {"run": run} | ({"way": WAYS[point.way]} if points[-1].way else {})
        row |= {key: said(point.config.value(key)) for key in keys}
        row |= found.get(run, {"converged": "no"})
        why = told.result["reason"] if told.result else told.why
        rows.append(row | {"why not": "" if told.converged else why})
    return [{name: text for name, text in row.items() if name not in NEVER_THE_SAME} for row in rows]


def start_of(behind, axes, point):
    """What a point starts from: the last one, or what is forecast from the last two of one line."""
    if not behind or point.config.is_in_time:
        return None
    last = behind[-1][1]
    if point.config.is_dry or not last.contact.is_loaded:
        return last
    if len(behind) < 2:
        return Forecast(last)
    places = [*(each.place for each, _ in behind), point.place]
    moved = [[k for k, (a, b) in enumerate(zip(*pair, strict=True)) if a != b] for pair in pairwise(places)]
    if len(moved[0]) != 1 or moved[0] != moved[1]:
        return Forecast(last)
    axis = axes[moved[0][0]]
    factor = _factor([axis.values[place[moved[0][0]]] for place in places], *(each for _, each in behind))
    return Forecast(last, behind[0][1], factor) if factor else Forecast(last)


def _factor(values, before, last):
    """Change that is expected of the next solution, over that between two; None where none can be. The film
    goes by a power of the key, all else as the film."""
    x = [log(value) for value in values] if min(values) > 0.0 else values
    steps, films = (x[2] - x[1]) / (x[1] - x[0]), [_film(each.result) for each in (before, last)]
    if not 0.0 < steps < NEAR or not min(films) > 0.0 or not max(films) < NEAR * min(films):
        return None
    ratio = films[1] / films[0]
    return steps if abs(ratio - 1.0) < 1e-6 else (ratio**steps - 1.0) / (1.0 - 1.0 / ratio)


def _film(result):
    return result.mixed.mean_gap_nm if result.mixed else result.central_film_nm


def write_arrays(path, axes, points, runs):
    """Write netCDF by CF of the `Told` runs of all points; nan where there is no answer."""
    both = points[-1].way == 1
    names = (["way"] if both else []) + [axis.name for axis in axes]
    with writing(path), whole_file(path) as part, netcdf_file(part, "sweep") as file:
        shape = *((2,) if both else ()), *(len(axis.values) for axis in axes)
        file.dimensions = dict(zip(names, shape, strict=True))
        _write_coordinates(partial(put, file), axes, both)
        for name, unit, meaning, values in _variables(points, runs):
            array = np.full(shape, nan)
            for point, value in zip(points, values, strict=True):
                array[(point.way, *point.place) if both else point.place] = value
            put(file, name, tuple(names), array, units=unit, long_name=meaning)


def _write_coordinates(write, axes, both):
    if both:
        write("way", ("way",), np.arange(2), units="1", flag_values=np.arange(2),
              flag_meanings=" ".join(WAYS), long_name="way along the keys")  # fmt: skip
    for axis in axes:
        text = KEYS[axis.key].metadata["help"]
        write(axis.name, (axis.name,), np.array(axis.values, float), units=axis.unit, long_name=text,
              key=axis.key)  # fmt: skip


def _variables(points, runs):
    """(Name, unit, meaning, number of each point)."""

    def numbers(path):
        return [run.number(path) if run.settled else nan for run in runs]

    for name, unit, meaning, path in numbers_and_bands():
        yield name, unit, meaning, numbers(path)
    yield "converged", "1", "whether all checks hold", [float(run.converged) for run in runs]
    yield "run", "1", f"number of its directory in {RUNS}/", [float(point.number) for point in points]
