"""The page of one run: what run.html.j2 shows is put together here where a template could not."""

import re
from dataclasses import fields
from functools import partial
from itertools import chain, groupby
from pathlib import Path

from mgehl.config import SECTIONS
from mgehl.errors import UserError
from mgehl.kinds.cited import cited
from mgehl.kinds.kind import pressure_unit
from mgehl.kinds.loaded import assumptions
from mgehl.kinds.own import naming_keys
from mgehl.kinds.plausible import implausible
from mgehl.kinds.time import of_formulas
from mgehl.model.films import FORMULAS
from mgehl.model.own_function import file_and_function
from mgehl.model.sources import SOURCES
from mgehl.output.advice import beside_bands
from mgehl.output.digits import pressure_words, with_band
from mgehl.output.files import plain_result
from mgehl.output.films_in_words import band_words, digits_of, heating_words
from mgehl.output.friction_result import coefficient_words, friction_lines
from mgehl.output.mixed_words import gap_band_words, mean_gaps
from mgehl.output.pictures import style
from mgehl.output.pictures.figures import drawn_by, figures
from mgehl.output.report.page import BAD, DOUBTFUL, GOOD, NO_NUMBER, number, picture, render
from mgehl.output.resolution import RESOLVED_CELLS, STANDS, STARVED_FROM, near_rest, of_inlet
from mgehl.output.summary import COMPLEMENTARITY_TOLERANCE
from mgehl.output.surface import ADVICE as SURFACE
from mgehl.output.surface import RESOLVED_NODES
from mgehl.output.time_words import means_in_short, time_lines
from mgehl.output.words import advice, largest_pressure_words, span
from mgehl.solver.recipe import A_STATE
from mgehl.solver.verification import FEWEST_NODES, LARGEST_EDGE_PRESSURE

HISTORY_NAMES = {
    "grid": "nodes", "speed_mm_s": "speed, mm/s", "central_film_nm": "central film, nm",
    "minimum_film_nm": "minimum film, nm", "seconds": "time, s", "e_p": "e^p", "e_p_lubr": "e^p of fluid",
    "e_p_solid": "e^p of contact",
}  # fmt: skip
"""Headings of columns of history.csv that are not plain words."""

LONG_HISTORY = 400
"""Cycles on one grid beyond which the page leaves out those in between: relaxation takes thousands."""

LISTED = ("nodes", "contradictions", "grids")
"""Lists of nodes and of grids in a result, which have tables of their own."""

HOLDS, CARE, BROKEN = ("holds", GOOD), ("to be read with care", DOUBTFUL), ("broken", BAD)
UNDECIDED = "not decided on this grid", DOUBTFUL


def report(solution, name):
    """The page of a `Solution` on rank 0 as HTML text; `name` is the run's, such as its directory's."""
    result, config, rows = solution.result, solution.config, solution.rows
    kind = "dry" if solution.is_dry else "loaded" if solution.contact.is_loaded else "wedge"
    page = {"title": config.kind.heading(solution), "subtitle": f"Run {name}"}
    page["verdict"] = *verdict(result), result.reason
    heads, last, shown = history_of(rows)
    of_what = of_formulas(config) if kind == "loaded" else ""
    mark = "" if result.converged else " (in doubt)" if result.settled else " (not converged)"
    mark = " at the end" + mark if result.time else mark
    how = {each.key: each.how for each in config.derived}
    with naming_keys(solution.contact):  # some numbers ask the user's own laws again
        return render(
            page, **FUNCTIONS, kind=kind, mark=mark, solution=solution, result=result, config=config,
            contact=solution.contact, mesh=solution.mesh, line=solution.mesh.is_line,
            tolerance=config.solver.tolerance,
            of_what=of_what, films=films_of(result, of_what) if kind == "loaded" else None,
            pictures=list(pictures(solution)), keys=list(keys_of(config)),
            inputs=[((key, "code"), config.said(key), how.get(key, "")) for key in config.physical],
            notes=list(notes_on(solution)),
            odd=list(odd(config, solution.contact, (result.recipe or {}).get("begins") == A_STATE)),
            sources=[(each.people, each.title, f"{each.where}, {each.year}", each.doi)
                     for each in map(SOURCES.get, cited(config, solution.contact))],
            heads=heads, last=last, shown=shown,
            every="Every cycle" if len(shown) == len(rows) else f"{len(shown)} of {len(rows)} cycles",
            versions=[(package, (text, "code")) for package, text in result.versions.items()],
            record=[((field, "code"), text) for field, text in _leaves(plain_result(result))],
        )  # fmt: skip


def odd(config, contact, goes_on):
    """What is unusual in the input, as far as its files are still there: the result needs them no more."""
    try:
        yield from (f"unusual: {words}" for words in implausible(config, contact, goes_on))
    except UserError as error:
        yield f"unusual: the rest could not be looked at: {error}"


def verdict(result):
    """The judgement of a result of any kind of contact: its kind and words."""
    if result.converged and result.overlap.nodes:
        return DOUBTFUL, "Converged, but the bodies overlap"
    kind = GOOD if result.converged else DOUBTFUL if result.settled else BAD
    return kind, result.verdict[0].upper() + result.verdict[1:]


def limited(name, value, limit):
    """The row of a check that |value| <= limit; what is not finite breaks it."""
    holds = value is not None and abs(value) <= limit
    return name, number(value, 2), f"{limit:g}", HOLDS if holds else BROKEN


def enough(name, value, limit):
    """The row of a check that value >= limit."""
    return name, number(value), f"at least {limit:g}", HOLDS if value >= limit else BROKEN


def absent(name, amount, of=None, care=False, decided=True):
    """The row of a check that there is none of something, or none of so many."""
    found = number(amount, 2) if of is None else f"{amount} of {of}"
    return name, found, "0", (CARE if care else BROKEN) if amount else HOLDS if decided else UNDECIDED


def informing(name, value):
    """A row beside checks that judges nothing."""
    return name, number(value, 2), "", ("for information", "muted")


def judged(verdict, words):
    """The judgement of a grid or a domain by its verdict."""
    return words, (GOOD if verdict in ("resolved", "sufficient") else DOUBTFUL)


def shows(verdict, nodes):
    """The row of the check that the grid shows the surface; nothing of smooth bodies."""
    needed, advised = f"at least {RESOLVED_NODES:g}", SURFACE.get(verdict)
    row = "nodes in the shortest wave of the surface", number(nodes, 3), needed, judged(verdict, advised)
    return advised and row


def from_each(records, names, digits=6):
    """Rows of some fields of records, which are dictionaries or have them as attributes."""
    for each in records:
        fields = each if isinstance(each, dict) else vars(each)
        yield [", ".join(fields[name]) if isinstance(fields[name], list) else number(fields[name], digits)
               for name in names]  # fmt: skip


def carried(mixed, name):
    """A part of the load in %: with its band as on the terminal, without it with four digits."""
    percent, band = 100 * getattr(mixed, name), mixed.error and getattr(mixed.error, name)
    return number(percent, 4) if band is None else with_band(percent, 100 * band)


def film(nm, half_width=None, digits=None):
    """A film in nm as on the terminal: with its band; without, as `with_band`."""
    return NO_NUMBER if number(nm) == NO_NUMBER else with_band(nm, half_width, digits)


FUNCTIONS = {
    "percent": lambda part: number(None if part is None else 100 * part, 4),
    "sentence": lambda words: f"{words[0].upper()}{words[1:]}.",
    "COMPLEMENTARITY_TOLERANCE": COMPLEMENTARITY_TOLERANCE,
    "FEWEST_NODES": FEWEST_NODES, "LARGEST_EDGE_PRESSURE": LARGEST_EDGE_PRESSURE,
    "RESOLVED_CELLS": RESOLVED_CELLS, "STARVED_FROM": STARVED_FROM, "STANDS": STANDS,
} | {
    each.__name__: each for each in (
        number, limited, enough, absent, informing, judged, shows, from_each, advice, band_words,
        gap_band_words, mean_gaps, near_rest, of_inlet, span, carried, largest_pressure_words, time_lines,
        means_in_short, heating_words, friction_lines, coefficient_words, pressure_words, pressure_unit,
    )
}  # fmt: skip
"""What run.html.j2 calls."""


def films_of(result, of_what=""):
    """Rows of films: the computed ones with their bands, then those of formulas, `of_what` in words. What
    did not converge, and what an instant has, is not compared with formulas."""
    is_steady = result.converged and not result.time
    own, error = (result.central_film_nm, result.minimum_film_nm), result.error
    bands, digits = (error.central_nm, error.minimum_nm), digits_of(error)
    shown = [film(nm, band, digits) for nm, band in zip(own, bands, strict=True)]
    rows = [("computed", shown[0], "", shown[1], "")]
    formulas = {name.removesuffix("_nm"): nm for name, nm in result.formulas.items()}
    for name in dict.fromkeys(re.sub("_(central|minimum)$", "", name) for name in formulas):
        theirs = formulas.get(f"{name}_central", formulas.get(name)), formulas.get(f"{name}_minimum")
        cells = (_beside(*each, is_steady) for each in zip(own, theirs, strict=True))
        known = FORMULAS.get(name)
        label = known.label if known else name.replace("_", " ")
        rows.append((f"{label}{of_what}", *chain(*cells)))
    return rows


def _beside(own, formula, is_steady):
    """The film of a formula and how much thicker the computed one is."""
    if formula is None:
        return "", ""
    return number(formula, 4), number(own / formula, 4) if is_steady and own is not None else ""


def pictures(solution):
    """Every picture of the run as SVG."""
    kinds = [kind for kind in drawn_by(solution) if solution.rows or kind != "history"]
    with style.applied():
        for name, title, figure in figures(solution, kinds):
            content, size = style.rendered(figure, "svg"), figure.get_size_inches()
            yield picture(FUNCTIONS["sentence"](title), content, "image/svg+xml", size, name)


def notes_on(solution):
    """Sentences on the films of a lubricated contact: what formulas assume, and beside the bands."""
    contact = solution.contact
    if contact.is_loaded and not solution.is_dry:
        if solution.result.formulas:
            yield "What the formulas assume: " + "; ".join(assumptions(contact))
        yield from beside_bands(solution)


def keys_of(config):
    """Rows of every key that the contact heeds, by sections; what differs from the default is marked."""
    for section in SECTIONS:
        keys = [key for key in fields(getattr(config, section))
                if not {section, f"{section}.{key.name}"} & set(config.unused)]  # fmt: skip
        if keys:
            yield (f"[{section}]",)
        for key in keys:
            used = setting(getattr(getattr(config, section), key.name), key.metadata["unit"])
            default = setting(key.default, key.metadata["unit"])
            told = ((used, "changed"), default) if used != default else (used, "")
            yield (f"{section}.{key.name}", "code"), *told, key.metadata["help"]


def setting(value, unit=None):
    """A value of the configuration as text; ten digits tell apart all that anyone would write."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value:.10g} {unit or ''}".strip()
    if value is None or isinstance(value, bool):
        return {None: "unset", True: "true", False: "false"}[value]
    if isinstance(value, tuple):
        return " to ".join(map(setting, value))
    if own := file_and_function(value):
        return f"{Path(own[0]).name}:{own[1]}"
    return str(value)


def history_of(rows):
    """Headings; the last cycle on every grid; all cycles, or some of each grid where they are many."""
    cycles = [list(group) for _, group in groupby(rows, key=lambda row: row["grid"])]
    strides = [-(-len(each) // LONG_HISTORY) for each in cycles]
    thinned = [each[::-stride][::-1] for each, stride in zip(cycles, strides, strict=True)]
    text = partial(number, digits=4)
    last = [list(map(text, each[-1].values())) for each in cycles]
    shown = [list(map(text, row.values())) for each in thinned for row in each]
    return [HISTORY_NAMES.get(name, name.replace("_", " ")) for name in (rows or [{}])[0]], last, shown


def _leaves(tree, path=""):
    """Pairs of a dotted name and a text for everything that nested dictionaries hold."""
    for name, value in tree.items():
        if isinstance(value, dict):
            yield from _leaves(value, f"{path}{name}.")
        elif name in LISTED and not isinstance(value, int):
            yield path + name, f"a list of {len(value)}"
        elif name in ("x_nodes", "y_nodes"):
            yield path + name, span(value)
        elif name == "otherwise":
            yield path + name, ", then ".join(value) or "nothing"
        elif isinstance(value, bool):
            yield path + name, str(value).lower()
        else:
            yield path + name, value if isinstance(value, str) else number(value, 10)
