"""Tables of text: how a terminal, Markdown and CSV have them, and the one of several runs."""

import csv
import io
import re
from itertools import pairwise
from pathlib import Path

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from mgehl.config import KEYS
from mgehl.errors import NoRunError, printable
from mgehl.output.digits import is_number, with_band
from mgehl.output.quantities import BANDS, of_what, read_told, told_at
from mgehl.output.stored import read_texts
from mgehl.output.words import span

DEFAULT = "default"
"""Stands for a scheme that the configuration does not name: the run chose it."""


def yes(holds):
    """As tables have it."""
    return "yes" if holds else "no"


COLUMNS = {
    "ranks": ("ranks", "d"),
    "converged": ("converged", yes),
    "load N": ("load_N", ".8g"),
    "drag N": ("drag_N", ".5g"),
    "largest pressure MPa": ("max_pressure_MPa", ".5g"),
    "central nm": ("central_film_nm", ".4f"),
    "minimum nm": ("minimum_film_nm", ".4f"),
    "H_Moes central": ("moes_film.central", ".5f"),
    "H_Moes minimum": ("moes_film.minimum", ".5f"),
    "largest pressure GPa": ("max_pressure_GPa", ".5g"),
    "approach um": ("approach_um", ".6g"),
    "residual": ("residual", ".1e"),
    "load error": ("load_error", ".1e"),
    "load on contact": ("contact.load_fraction", ".5f"),
    "load on solids": ("mixed.solid_load_fraction", ".5f"),
    "contact/Hertz area": ("contact.area_fraction", ".5f"),
    "mean gap nm": ("mixed.mean_gap_nm", ".7g"),
    "loaded gap nm": ("mixed.loaded_gap_nm", ".6g"),
    "friction": ("friction.coefficient", ".5g"),
    "friction of film": ("friction.film_coefficient", ".4g"),
    "friction of solids": ("friction.solid_coefficient", ".4g"),
    "rolling friction": ("friction.rolling_coefficient", ".5g"),
    "flash 1 K": ("friction.temperatures.largest_1", ".4g"),
    "flash 2 K": ("friction.temperatures.largest_2", ".4g"),
    "film K": ("friction.temperatures.film", ".4g"),
    "lambda": ("mixed.lambda_ratio", ".4g"),
    "mean film nm": ("mixed.mean_film_nm", ".4g"),
    "contact nodes on X": ("contact.x_nodes", span),
    "on Y": ("contact.y_nodes", span),
    "largest gap in contact nm": ("contact.largest_gap_nm", ".1e"),
    "Eq. 2 violations": ("pressure_inequality", lambda found: "{violations} of {checked}".format(**found)),
    "inlet cells": ("resolution.inlet_cells", ".2f"),
    "domain": ("resolution.domain", "s"),
    "convolutions": ("work.convolutions", ".1f"),
}
"""What each column shows: where it is in result.json, and its format or a function. What has a band, by
`BANDS`, is rounded by that, and has digits enough before."""

OF_HEAT = "flash 1 K", "flash 2 K", "film K"
"""Columns that only runs with temperatures have."""

SLIDING = "friction", "friction of film", "friction of solids"
"""Columns of bodies whose sliding is known: where it is not given their 0 is no answer."""

UNIT = re.compile("( nm| um| GPa| N|)$")
"""What stands behind the ± of a column of half-widths."""

WIDTH = 120
"""Columns of a table where the width of the terminal is not known."""


def collect(directories, keys=(), left_out=None):
    """A row (dict of text) for each run directory, all of the same columns, with these `keys` of the
    configurations, "section.key", in SI units; empty where a run has none. Raises OutputError for a
    directory that is not as its run wrote it, OSError if one cannot be read; `left_out` is called with the
    error of what is no finished run, if it is given and there are others."""
    rows, why = [], []
    for directory in directories:
        try:
            rows.append(_row(Path(directory), keys))
        except NoRunError as error:
            why.append(error)
    if why and not (rows and left_out):
        raise why[0]
    for error in why:
        left_out(error)
    columns = dict.fromkeys(name for row in rows for name in row)
    return [{name: row.get(name, "") for name in columns} for row in rows]


def _row(directory, keys):
    told, texts = read_told(directory), read_texts(directory)
    nodes, result = told.value("grid.nodes"), told.result
    row = {
        "run": directory.resolve().name,
        **{key: said(told.value(key)) for key in keys},
        "nodes": str(nodes),
        "couette": told.tables["discretization"].get("couette", DEFAULT),
        **({"numbers of": of} if (of := of_what(result)) else {}),
    }
    for name, (path, shape) in COLUMNS.items():
        if path.split(".")[0] in result:
            found = told_at(result, path)
            if found is None and name in OF_HEAT:
                continue
            row[name] = shape(found) if callable(shape) else "" if found is None else format(found, shape)
            if path in BANDS:
                half_width = told_at(result, BANDS[path])
                row[_of_band(name)] = "" if half_width is None else f"{half_width:.4g}"
    if told.value("contact.kind") == "line":
        for name in ("approach um", "approach ± um"):  # from a distance of a: loads cannot be compared
            row.pop(name, None)
    if told.value("motion.slide_to_roll") is None:
        row |= {name: "" for name in SLIDING if name in row}
    if told.lambda_ratio is not None:
        row["lambda"] = format(told.lambda_ratio, ".4g")
    history = csv.DictReader(texts["history.csv"].splitlines())
    of_all = nodes if told.value("contact.kind") == "line" else nodes**2
    row |= _work([each for each in history if int(each["grid"]) == nodes], of_all)
    return row | {"wall s": f"{result['wall_s']:.1f}"}


def _of_band(column):
    """The column of the half-width of a column's band."""
    return UNIT.sub(r" ±\1", column, count=1)


def said(value):
    """A value of a configuration; empty without one."""
    return "" if value is None else f"{value:.10g}" if isinstance(value, float) else str(value)


def _work(finest, nodes):
    """Columns of the work on a grid of so many nodes, from its rows of the history. A run may solve on it
    several times, from step 0 each; between them are other grids, too."""
    iterations = (each["linear_iterations"] for each in finest if "linear_iterations" in each)
    found = {"most GMRES iterations": max(iterations, key=int, default="")}
    rows = [(b, a) for b, a in pairwise(finest) if "seconds" in a and int(a["step"]) > 0]
    seconds = sum(float(after["seconds"]) - float(before["seconds"]) for before, after in rows)
    # A row of a run in time is a step in time.
    if steps := sum(int(after.get("newton_steps", 1)) for _, after in rows):
        found["Newton steps on finest"] = str(steps)
        found["us a step and node"] = f"{1e6 * seconds / steps / nodes:.3f}"
    return found


def with_bands(rows):
    """The rows of `collect` as shown: numbers with their bands and no more digits than those."""

    def shown(row, name):
        band = row.get(_of_band(name))
        return with_band(float(row[name]), float(band)) if band else row[name]

    return [{name: shown(row, name) for name in row if "±" not in name} for row in rows]


def drawn(rows, columns, width=None, names=1):
    """Some columns of the rows as text, no line longer than `width`; numbers stand on the right. Columns
    that have no room are drawn below, of rows that have something there, with the first columns repeated
    before them: as many as name a row."""
    first, width = columns[:names], width or WIDTH
    blocks = [[*first]]
    for column in columns[names:]:
        wider = _shown(rows, [*blocks[-1], column]).splitlines()
        if len(blocks[-1]) > names and max(map(len, wider)) > width:
            blocks.append([*first])
        blocks[-1].append(column)
    kept = [[row for row in rows if any(row[column] for column in block[names:])] for block in blocks[1:]]
    return "\n\n".join(_shown(*each, width) for each in zip([rows, *kept], blocks, strict=True))


def _shown(rows, columns, width=10**6):
    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for column in columns:
        said = [row[column] for row in rows if row[column]]
        right = bool(said) and all(map(is_number, said))
        table.add_column(Text(headed(column)), justify="right" if right else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text(printable(row[column])) for column in columns))
    console = Console(file=io.StringIO(), width=width, color_system=None)
    console.print(table)
    return "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())


def headed(column):
    """A column's name as shown: that of a key has its unit."""
    unit = KEYS[column].metadata["unit"] if column in KEYS else None
    return f"{column}, {unit}" if unit else column


def markdown(rows, columns):
    """Some columns of the rows as a Markdown table; no text ends its cell or moves the cursor."""
    heads = map(headed, columns)
    lines = [heads, ["---"] * len(columns), *([row[column] for column in columns] for row in rows)]
    return "\n".join(
        "| " + " | ".join(printable(text).replace("|", "\\|") for text in line) + " |" for line in lines
    )
