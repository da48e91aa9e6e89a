"""One table of several run directories, from the files that the runs wrote."""

import csv
import json
import tomllib
from itertools import pairwise
from pathlib import Path

from mgehl.errors import UserError, printable
from mgehl.output.digits import with_band
from mgehl.output.domain import UNKNOWN
from mgehl.output.stored import read_texts
from mgehl.output.whole_file import whole_file
from mgehl.output.words import span

DEFAULT = "default"
"""Stands for a scheme that the configuration does not name: the run chose it."""

FILMS, GAPS = ("central", "minimum"), ("mean", "loaded")


def collect(directories):
    """A row (dict of text) for each run directory, all of the same columns; empty where a run has none.

    Raises OutputError for a directory that is not as its run wrote it, OSError if one cannot be read,
    UserError if it has no film.
    """
    rows = [_row(Path(directory)) for directory in directories]
    columns = dict.fromkeys(name for row in rows for name in row)
    return [{name: row.get(name, "") for name in columns} for row in rows]


def markdown(rows, columns):
    """Some columns of the rows as a Markdown table."""
    lines = [columns, ["---"] * len(columns), *([row[column] for column in columns] for row in rows)]
    return "\n".join("| " + " | ".join(map(_cell, line)) + " |" for line in lines)


def _cell(text):
    """Text of a file without characters that would end the cell or move the cursor."""
    return printable(text).replace("|", "\\|")


def write_csv(path, rows):
    """The rows as CSV."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def _row(directory):
    texts = read_texts(directory)
    result, config = json.loads(texts["result.json"]), tomllib.loads(texts["configuration.toml"])
    if config["discretization"].get("contact_model") == "dry":
        raise UserError(f"{directory}: is a dry contact, without the films that this table is of")
    history = list(csv.DictReader(texts["history.csv"].splitlines()))
    nodes = config["grid"]["nodes"]
    finest = [row for row in history if int(row["grid"]) == nodes]
    row = {
        "run": directory.resolve().name,
        "nodes": str(nodes),
        "couette": config["discretization"].get("couette", DEFAULT),
        "ranks": str(result["ranks"]),
        "converged": "yes" if result["converged"] else "no",
    }
    row |= _loaded(result) if "contact" in result else _bearing(result)
    row["most GMRES iterations"] = max(
        (each.get("linear_iterations", "0") for each in finest), key=int, default=""
    )
    steps = [float(each["seconds"]) - float(before["seconds"]) for before, each in _steps(finest)]
    if steps:
        row["Newton steps on finest"] = str(len(steps))
        of_all = nodes if config["contact"]["kind"] == "line" else nodes**2
        row["us a step and node"] = f"{1e6 * sum(steps) / len(steps) / of_all:.3f}"
    return row | {"wall s": f"{result['wall_s']:.1f}"}


def _bearing(result):
    """Columns of a wedge: a load, and neither films nor contact."""
    return {"load N": f"{result['load_N']:.6g}", "residual": f"{result['residual']:.1e}"}


def _loaded(result):
    """Columns of a loaded contact."""
    contact, inequality = result["contact"], result["pressure_inequality"]
    return {
        **_films(result),
        "H_Moes central": _digits(result["moes_film"]["central"], ".5f"),
        "H_Moes minimum": _digits(result["moes_film"]["minimum"], ".5f"),
        "residual": _digits(result["residual"], ".1e"),
        "load error": _digits(result["load_error"], ".1e"),
        "load on contact": _digits(contact["load_fraction"], ".4f"),
        "contact/Hertz area": _digits(contact["area_fraction"], ".4f"),
        **_gaps(result),
        "lambda": _of_rough(result, "lambda_ratio"),
        "mean film nm": _of_rough(result, "mean_film_nm"),
        "contact nodes on X": span(contact["x_nodes"]),
        "on Y": span(contact["y_nodes"]),
        "largest gap in contact nm": _digits(contact["largest_gap_nm"], ".1e"),
        "Eq. 2 violations": f"{inequality['violations']} of {inequality['checked']}",
        "inlet cells": f"{result['resolution']['inlet_cells']:.2f}",
        "domain": result["resolution"].get("domain", UNKNOWN),
        "convolutions": f"{result['work']['convolutions']:.1f}",
        "Newton steps on finest": "",
    }


def _digits(number, digits):
    """A number of result.json, which is null where it was not finite."""
    return "nan" if number is None else format(number, digits)


def _of_rough(result, name):
    """A number of `MixedResult`; empty of smooth bodies, of older runs and where there is none."""
    value = (result.get("mixed") or {}).get(name)
    return "" if value is None else f"{value:.4g}"


def _films(result):
    """Central and minimum film with all digits, and their bands; empty where there is none."""
    error = result.get("error") or {}
    columns = {f"{film} nm": _digits(result[f"{film}_film_nm"], ".4f") for film in FILMS}
    bands = {film: error.get(f"{film}_nm") for film in FILMS}
    return columns | {f"{film} ± nm": "" if band is None else f"{band:.4g}" for film, band in bands.items()}


def _gaps(result):
    """The same of the mean gaps of rough bodies."""
    mixed = result.get("mixed") or {}
    error = mixed.get("error") or {}
    found = {gap: mixed.get(f"{gap}_gap_nm") for gap in GAPS}
    bands = {gap: error.get(f"{gap}_nm") for gap in GAPS}
    return {f"{gap} gap nm": "" if nm is None else f"{nm:.6g}" for gap, nm in found.items()} | {
        f"{gap} gap ± nm": "" if band is None else f"{band:.4g}" for gap, band in bands.items()
    }


def with_bands(rows):
    """The rows of `collect` as they are shown: films and gaps with their bands and no more digits than they
    have."""
    return [_with_bands(row) for row in rows]


def _with_bands(row):
    numbers = [*FILMS, *(f"{gap} gap" for gap in GAPS)]
    shown = {
        f"{name} nm": with_band(float(row[f"{name} nm"]), float(row[f"{name} ± nm"]))
        for name in numbers
        if row.get(f"{name} ± nm")
    }
    return {name: text for name, text in (row | shown).items() if "±" not in name}


def _steps(finest):
    """Rows of the history before and after each step on the finest grid; a run may solve on it several
    times, from step 0 each."""
    return [pair for pair in pairwise(finest) if "seconds" in pair[1] and int(pair[1]["step"]) > 0]
