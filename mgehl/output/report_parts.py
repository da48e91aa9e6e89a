"""Sections of a run's page that every kind of contact has."""

from dataclasses import asdict, fields
from itertools import groupby

from mgehl.config import FOREIGN, MOES_REPLACES, SECTIONS
from mgehl.output import style
from mgehl.output.figures import drawn_by, figures
from mgehl.output.page import BAD, DOUBTFUL, GOOD, Cell, Section, Text, number, picture, table
from mgehl.output.wedge_result import WedgeResult

HOLDS, CARE, BROKEN = Cell("holds", GOOD), Cell("to be read with care", DOUBTFUL), Cell("broken", BAD)


def configuration_section(config):
    """Every key that the contact heeds, by sections; what differs from the default is in bold."""
    rows = []
    for name in SECTIONS:
        own = _key_rows(name, getattr(config, name), config)
        rows += [(Cell(f"[{name}]"),), *own] if own else []
    caption = (
        "Values that were used; in bold those that differ from the default, with the default beside them"
    )
    whole = table(caption, ("key", "value", "instead of", "meaning"), rows)
    return Section("configuration", "Configuration", (whole,))


def _key_rows(name, section, config):
    unused = set(FOREIGN[config.contact.kind])
    if config.moes.M is not None:
        unused |= {".".join(pair) for pair in MOES_REPLACES}
    if name in unused:
        return []
    keys = [key for key in fields(section) if f"{name}.{key.name}" not in unused]
    return [_key_row(name, key, getattr(section, key.name)) for key in keys]


def _key_row(section, key, value):
    used, default = (setting(each, key.metadata["unit"]) for each in (value, key.default))
    changed = used != default
    return (
        Cell(f"{section}.{key.name}", "code"),
        Cell(used, "changed" if changed else ""),
        default if changed else "",
        key.metadata["help"],
    )


def setting(value, unit=None):
    """A value of the configuration as text; ten digits tell apart all that anyone would write."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value:.10g} {unit or ''}".strip()
    if value is None:
        return "unset"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return " to ".join(map(setting, value))
    return str(value)


def pictures(solution):
    """Every picture of the run as SVG, by kind."""
    kinds = [kind for kind in drawn_by(solution) if solution.rows or kind != "history"]
    drawn = figures(solution, kinds)
    with style.applied():
        return {each.name: _picture(each, solution) for each in drawn}


def _picture(drawn, solution):
    title = _OF_A_WEDGE.get(drawn.name, drawn.title) if _is_wedge(solution.result) else drawn.title
    caption = title[0].upper() + title[1:]
    alt = f"{caption}. {ALTERNATIVES[drawn.name](solution.result)}"
    content = style.rendered(drawn.figure, "svg")
    return picture(f"{caption}.", alt, content, "image/svg+xml", wide=drawn.name in ("lines", "history"))


_OF_A_WEDGE = {"lines": "pressure on the centre line", "pressure": "pressure, the solid in grey"}

ALTERNATIVES = {
    "lines": lambda result: f"The largest pressure is {_largest(result)}.",
    "film": lambda result: (
        f"The film is {number(result.central_film_nm, 4)} nm in the centre and "
        f"{number(result.minimum_film_nm, 4)} nm at its thinnest."
    ),
    "pressure": lambda result: f"Its maximum is {_largest(result)}.",
    "status": lambda result: f"{_solid(result)} nodes are solid, {result.cavitated_nodes} are cavitated.",
    "history": lambda result: f"The last residual is {number(result.residual, 2)}.",
}
"""What a reader who does not see a picture is told besides its title, by kind of picture."""


def _largest(result):
    if _is_wedge(result):
        return f"{number(result.max_pressure_MPa, 4)} MPa"
    return f"{number(result.max_pressure_GPa, 4)} GPa"


def _solid(result):
    return result.solid_nodes if _is_wedge(result) else result.contact.nodes


def _is_wedge(result):
    return isinstance(result, WedgeResult)


HISTORY_NAMES = {
    "grid": "nodes", "speed_mm_s": "speed, mm/s", "central_film_nm": "central film, nm",
    "minimum_film_nm": "minimum film, nm", "seconds": "time, s", "e_p": "e^p", "e_p_lubr": "e^p of fluid",
    "e_p_solid": "e^p of contact",
}  # fmt: skip
"""Headings of columns of history.csv that are not plain words."""

LONG_HISTORY = 400
"""Cycles on one grid beyond which the page leaves out those in between: relaxation takes thousands."""


def history_section(rows, drawn):
    """The history's picture, the last cycle of every grid, and all cycles, folded."""
    if not rows:
        return Section("history", "Convergence history", (Text("No cycle was recorded."),))
    grids = [list(cycles) for _, cycles in groupby(rows, key=lambda row: row["grid"])]
    heads = [HISTORY_NAMES.get(name, name.replace("_", " ")) for name in rows[0]]
    last = [_history_row(cycles[-1]) for cycles in grids]
    shown = [row for cycles in grids for row in _thinned(cycles)]
    every = "Every cycle" if len(shown) == len(rows) else f"{len(shown)} of {len(rows)} cycles"
    return Section(
        "history",
        "Convergence history",
        (
            drawn,
            table("The last cycle on every grid", heads, last),
            table(every, heads, map(_history_row, shown), folded=True),
        ),
    )


def _thinned(cycles):
    """At most about `LONG_HISTORY` cycles, the last one among them."""
    stride = -(-len(cycles) // LONG_HISTORY)
    return cycles[::-stride][::-1]


def _history_row(row):
    return [number(value, 4) for value in row.values()]


def versions_section(versions):
    """What computed the run."""
    rows = [(name, Cell(text, "code")) for name, text in versions.items()]
    return Section(
        "versions", "Versions", (table("Software that computed this run", ("name", "version"), rows),)
    )


LISTED = {"nodes", "contradictions"}
"""Lists of nodes in a result, which have tables of their own."""


def record_section(result):
    """All of result.json, folded, a row for each number."""
    rows = [(Cell(name, "code"), text) for name, text in _leaves(asdict(result))]
    whole = table("All fields of result.json", ("field", "value"), rows, folded=True)
    return Section("record", "The whole record", (whole,))


def _leaves(tree, path=""):
    """Pairs of a dotted name and a text for everything that nested dictionaries hold."""
    for name, value in tree.items():
        if isinstance(value, dict):
            yield from _leaves(value, f"{path}{name}.")
        else:
            yield path + name, _field(name, value)


def _field(name, value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if name in LISTED and isinstance(value, list):
        return f"a list of {len(value)}"
    if name in ("x_nodes", "y_nodes"):
        return span(value)
    return number(value, 10)


def span(ends):
    """First and last node of a stretch."""
    return f"{ends[0]} to {ends[1]}" if ends else "none"


CHECKS, CHECK_HEADS = "What was checked on the final state", ("check", "found", "allowed", "verdict")


def limited(name, value, limit):
    """The row of a check that |value| <= limit; what is not finite breaks it."""
    holds = value is not None and abs(value) <= limit
    return name, number(value, 2), f"{limit:g}", HOLDS if holds else BROKEN


def absent(name, amount, found=None, otherwise=BROKEN):
    """The row of a check that there is none of something; `found` is said instead of the amount."""
    return name, found or str(amount), "0", HOLDS if amount == 0 else otherwise


def informing(name, value):
    """A row beside checks that judges nothing."""
    return name, number(value, 2), "", Cell("for information", "muted")
