"""Columns that tables of several studies have beside those of `output.table`: where a result has the number
and how it is written.
"""

from operator import attrgetter

from mgehl.output import table
from mgehl.output.table import yes
from mgehl.output.words import span


def broken(inequality):
    """How often an inequality is broken, of how many."""
    return f"{inequality.violations} of {inequality.checked}"


COLUMNS = table.COLUMNS | {
    "settled": ("settled", yes),
    "wall s": ("wall_s", ".1f"),
    "steps": ("work.steps", "d"),
    "contact nodes": ("contact.nodes", "d"),
    "contact on X": ("contact.x_nodes", span),
    "largest gap nm": ("contact.largest_gap_nm", ".1e"),
    "Eq. 2 broken": ("other_inequality", broken),
    "at the interface": ("pressure_inequality", broken),
    "grid verdict": ("resolution.verdict", str),
    "lambda": ("mixed.lambda_ratio", ".3g"),
    "made": ("mass.made_share", ".1e"),
    "load mm": ("load", ".5f"),
    "largest P 1/mm": ("max_P", ".6f"),
    "smallest P 1/mm": ("min_P", ".6f"),
    "flow through closed faces": ("closed_face_flow", ".1e"),
    "flux imbalance": ("flux_imbalance", ".1e"),
    "iterations": ("linear_iterations", "d"),
}
"""Name: attributes of a result; format, or a function."""


def told(result, names):
    """{column: text} of a result; `names` are "a, b:.0f, ...", with a format where it is not the usual."""
    cells = {}
    for each in names.split(", "):
        name, _, own = each.partition(":")
        where, shape = COLUMNS[name]
        value = attrgetter(where)(result)
        cells[name] = shape(value) if callable(shape) else format(value + 0, own or shape)  # -0.0 is 0
    return cells


def statistic(function, values, shown="{:.1f}"):
    """A mean, median or the like of some values, as a summary tells it; "none" where there are none."""
    values = list(values)
    return shown.format(function(values)) if values else "none"
