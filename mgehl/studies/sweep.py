"""A contact at many values of its keys: each point starts from its neighbours and is a run of its own.

SWEEP/
    runs/001, ...             a run directory for each point, in the order in which they are solved
    sweep.csv, .md, .nc, .png one table, the same as arrays with a dimension for each key, and curves

The path through several keys is a snake: from one point to the next a single key changes, by one value. A
point that has no answer is said and passed; the next one starts from the last that has one.
"""

import re
import tomllib
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import log, nan, prod
from pathlib import Path

import numpy as np
import tomli_w

from mgehl.config import KEYS, Config, checked_key
from mgehl.errors import ConfigError, OutputError, UserError
from mgehl.output.checkpoint import is_begun
from mgehl.output.directory import clear_checkpoint, make_directory
from mgehl.output.files import CONFIGURATION, FIELDS, REPORT, on_first_rank
from mgehl.output.laws import portable
from mgehl.output.lock import locked
from mgehl.output.netcdf import netcdf_file, put
from mgehl.output.quantities import QUANTITIES, Told, read_told
from mgehl.output.report.page import render
from mgehl.output.report.study_report import study_report
from mgehl.output.solution import on_every_rank
from mgehl.output.stored import read_run, read_texts
from mgehl.output.study_directory import StudyRecord, begin_study, finish_study
from mgehl.output.surroundings import versions
from mgehl.output.table import collect, said
from mgehl.output.whole_file import whole_file, write_whole, writing
from mgehl.run import enter, run
from mgehl.solver.restart import Forecast
from mgehl.studies.study import Study
from mgehl.version import VERSION

FOLDER = "runs"

WHAT = "a contact at many values of its keys, each point from its neighbours"

WAYS = "there", "back"

MOST_POINTS = 10000

DECADE = 10.0
"""Last over first value beyond which the values of a range are of equal ratio."""

NEAR = 4.0
"""Ratio of two films, and of two steps along a key, within which what changes is forecast."""

NEVER_THE_SAME = "wall s", "us a step and node"
"""Columns that a sweep leaves out: one that was killed and resumed has the same table."""

SHOWN = [
    "converged", "central nm", "mean gap nm", "load on solids", "friction", "convolutions", "why not",
]  # fmt: skip
"""Columns that are printed; the table has more."""

_NUMBER = r"[-+]?(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][-+]?\d+)?"
_RANGE = re.compile(rf"(?:(lin|log)\()?\s*({_NUMBER})\.\.({_NUMBER})\s*([^:()]*?)\s*:\s*(\d+)\s*\)?")
_ITEM = re.compile(rf"\s*({_NUMBER})\s*(.*?)\s*")


@dataclass(frozen=True)
class Axis:
    """A key and its values in SI units, in the order in which they are taken."""

    key: str
    values: tuple

    @property
    def name(self):
        """Of its dimension."""
        return self.key.replace(".", "_")

    @property
    def unit(self):
        """ "1" where it has none."""
        return KEYS[self.key].metadata["unit"] or "1"


@dataclass(frozen=True)
class Point:
    """A point of a sweep: its place in the arrays, the way it is met on, its configuration."""

    number: int
    place: tuple
    way: int
    config: Config

    @property
    def run(self):
        """Name of its directory."""
        return f"{self.number:03d}"


def axis_of(config, key, values):
    """The `Axis` of a key; values are a list, or a text such as "1e-4..1 m/s:20" or "50,100,200 N".

    Raises ConfigError where the key cannot be swept, or where the values are none that it takes.
    """
    checked_key("--over", key)
    rules = KEYS[key].metadata
    if rules["kind"] not in (int, float):
        raise ConfigError(f"--over {key}: cannot be swept: only keys with a number can")
    if key.startswith("time."):
        raise ConfigError(f"--over {key}: cannot be swept: [time] tells of one run")
    found = _values(config, key, values) if isinstance(values, str) else _read(config, key, values)
    if len(found) < 2:
        raise ConfigError(f"--over {key}: has fewer than two values")
    if len({*found}) < len(found):
        raise ConfigError(f"--over {key}: has the same value twice")
    return Axis(key, tuple(found))


def _values(config, key, text):
    """The values that a text names."""
    told = f'--over {key}="{text}"'
    if ".." not in text:
        items = [_ITEM.fullmatch(item) for item in text.split(",")]
        if not all(items):
            raise ConfigError(f'{told}: must be as "50,100,200 N" or "50..200 N:4"')
        unit = items[-1][2]
        return _read(config, key, [_word(item[1], item[2] or unit) for item in items])
    match = _RANGE.fullmatch(text.strip())
    if not match:
        raise ConfigError(f'{told}: must be as "1e-4..1 m/s:20" or "log(1e-4..1 m/s:20)"')
    how, first, last, unit, count = match.groups()
    if KEYS[key].metadata["unit"] and not unit:
        raise ConfigError(f"{told}: needs a unit, such as {KEYS[key].metadata['unit']}")
    first, last = _read(config, key, [_word(first, unit), _word(last, unit)])
    if first == last or not 2 <= int(count) <= MOST_POINTS:
        raise ConfigError(f"{told}: is empty: needs two ends that differ and 2 to {MOST_POINTS} values")
    positive = first > 0.0 and last > 0.0
    if how == "log" and not positive:
        raise ConfigError(f"{told}: log needs ends above 0")
    by_ratio = how == "log" or (how is None and positive and max(first, last) > DECADE * min(first, last))
    space = np.geomspace if by_ratio else np.linspace
    inner = [float(f"{each:.6g}") for each in space(first, last, int(count))[1:-1]]
    return _read(config, key, [first, *inner, last])


def _word(number, unit):
    return f"{number} {unit}" if unit else float(number)


def _read(config, key, values):
    """Values as the key takes them, in SI units."""
    return [config.with_({key: value}).value(key) for value in values]


def points_of(config, axes, both_ways=False):
    """The `Point`s of a sweep in order. Raises ConfigError where one cannot be used."""
    keys = [axis.key for axis in axes]
    if len({*keys}) < len(keys):
        raise ConfigError(f"--over {max(keys, key=keys.count)}: is given twice")
    if prod(len(axis.values) for axis in axes) > MOST_POINTS:
        raise ConfigError(f"--over: has more than {MOST_POINTS} points")
    path = [(place, 0) for place in _snake([len(axis.values) for axis in axes])]
    path += [(place, 1) for place, _ in path[::-1]] if both_ways else []
    values = [{axis.key: axis.values[k] for axis, k in zip(axes, place, strict=True)} for place, _ in path]
    return [
        Point(number, *each, config.with_(own))
        for number, (each, own) in enumerate(zip(path, values, strict=True), 1)
    ]


def _snake(lengths):
    """Places of an array, each beside the one before; the first index goes fastest."""
    if not lengths:
        return [()]
    outer, inner = _snake(lengths[1:]), range(lengths[0])
    return [(k, *rest) for turn, rest in enumerate(outer) for k in (inner[::-1] if turn % 2 else inner)]


def swept(directory, comm, axes, points, watch, speak=True, asked=()):
    """Solve all points in a directory, or read what is there; write table, arrays, curves and a page.

    Collective; returns the `Study`. `asked` are the words of a command line. Raises OutputError where a run
    that is there is of another configuration.
    """
    record = StudyRecord("sweep", (points[0].config.grid.nodes,), comm.size, versions(), settings=asked)
    on_first_rank(comm, make_directory, directory, True)
    with locked(comm, directory):
        stage = comm.bcast(on_first_rank(comm, begin_study, directory, record, True))
        study = Study(stage, comm, speak=speak)
        fill(study, directory, axes, points, watch)
        on_first_rank(comm, finish_study, directory, stage, False)
        on_first_rank(comm, _write_page, Path(directory))
    return study


def _write_page(directory):
    write_whole(directory / REPORT, render(study_report(directory, {"sweep": WHAT})))


def fill(study, directory, axes, points, watch, name="sweep"):
    """The same with the files of a `Study`, NAME.csv and others in its own directory; return the `Told`
    runs (collective)."""
    folder, behind, runs = Path(directory) / FOLDER, [], []
    called = "" if name == "sweep" else f"{name}, "
    study.cases = max(study.cases, len(points))
    for point in points:
        try:
            solution = _solved(study, folder / point.run, point, _start(behind, axes, point), watch)
        except OutputError:
            raise
        except UserError as error:
            study.lose(f"{called}{_title(axes, point)}", error)
            runs.append(Told(portable(point.config), None, str(error)))
            continue
        study.failures += not solution.result.converged
        study.tell(f"{called}{_title(axes, point)}", solution.result)
        runs.append(study.comm.bcast(on_first_rank(study.comm, read_told, folder / point.run)))
        behind = [*behind[-1:], (point, solution)] if solution.result.settled else behind
    rows = study.comm.bcast(on_first_rank(study.comm, _rows, folder, axes, points, runs))
    study.write_table(name, rows, [axis.key for axis in axes] + SHOWN)
    on_first_rank(study.comm, _write_arrays, study.directory / f"{name}.nc", axes, points, runs)
    study.draw(name, _draw, runs, axes[0].key, [WAYS[p.way] for p in points if points[-1].way])
    return runs


def _title(axes, point):
    words = [point.config.said(axis.key) for axis in axes]
    return ", ".join(words) + (f", {WAYS[1]}" if point.way else "")


def _solved(study, path, point, start, watch):
    """The `Solution` of a point, from its directory where it has finished (collective)."""
    comm, case = study.comm, enter(point.config, study.comm)
    if not study.resume:
        on_first_rank(comm, clear_checkpoint, path)
    if not study.resume or not comm.bcast(on_first_rank(comm, _has_finished, path, case.config)):
        on_first_rank(comm, make_directory, path, True)
        with locked(comm, path):
            run(case, path, comm, watch, start if case.contact.is_loaded else None)
    return on_every_rank(comm, on_first_rank(comm, read_run, path))


def _has_finished(path, config):
    """Whether the run of this configuration is there."""
    if is_begun(path) or not (path / FIELDS).exists():
        return False
    if tomllib.loads(read_texts(path)[CONFIGURATION]) != tomllib.loads(tomli_w.dumps(portable(config))):
        raise OutputError(f"--resume: {path} is of another configuration; choose another with --out")
    return True


def _start(behind, axes, point):
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
    """Change that is expected of the next solution, over that between two; None where none can be.

    The film goes by a power of the key, all else as the film: from 0.5 to 0.3 m/s a rough ball's comes
    within a per cent.
    """
    x = [log(value) for value in values] if min(values) > 0.0 else values
    steps, films = (x[2] - x[1]) / (x[1] - x[0]), [_film(each.result) for each in (before, last)]
    if not 0.0 < steps < NEAR or not min(films) > 0.0 or not max(films) < NEAR * min(films):
        return None
    ratio = films[1] / films[0]
    return steps if abs(ratio - 1.0) < 1e-6 else (ratio**steps - 1.0) / (1.0 - 1.0 / ratio)


def _film(result):
    return result.mixed.mean_gap_nm if result.mixed else result.central_film_nm


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


def _draw(path, runs, key, names):
    from mgehl.output.pictures.curves import curves
    from mgehl.output.pictures.style import applied, save

    with applied():
        save(curves(runs, key, names), path)


def _write_arrays(path, axes, points, runs):
    """sweep.nc, CF: every number of `QUANTITIES` and its band over the keys; nan without an answer."""
    ways = points[-1].way + 1
    shape = (ways, *(len(axis.values) for axis in axes))
    names = ["way", *(axis.name for axis in axes)]
    first = 0 if ways == 2 else 1

    def array(found):
        values = np.full(shape, nan)
        for point, told in zip(points, runs, strict=True):
            values[(point.way, *point.place)] = found(point, told)
        return values[0] if first else values

    with writing(path), whole_file(path) as part, netcdf_file(part) as file:
        file.attrs.update({"Conventions": "CF-1.8", "title": "sweep", "source": f"mgehl {VERSION}"})
        file.dimensions = dict(zip(names[first:], shape[first:], strict=True))
        write = partial(put, file)
        if not first:
            write("way", ("way",), np.arange(2), units="1", flag_values=np.arange(2),
                  flag_meanings=" ".join(WAYS), long_name="way along the keys")  # fmt: skip
        for axis in axes:
            text = KEYS[axis.key].metadata["help"]
            write(axis.name, (axis.name,), np.array(axis.values, float), units=axis.unit, long_name=text,
                  key=axis.key)  # fmt: skip

        def one(name, found, unit, meaning):
            write(name, tuple(names[first:]), array(found), units=unit, long_name=meaning)

        for name, (where, unit, meaning, band) in QUANTITIES.items():
            one(name, lambda _, told, p=where: told.number(p) if told.settled else nan, unit, meaning)
            if band:
                about = f"half-width of the band about the {meaning}"
                one(
                    f"{name}_band",
                    lambda _, told, p=band: told.number(p) if told.settled else nan,
                    unit,
                    about,
                )
        one("converged", lambda _, told: float(told.converged), "1", "whether all checks hold")
        one("run", lambda point, _: float(point.number), "1", f"number of its directory in {FOLDER}/")
