"""Tables of the pages, from the CSV files in runs/tables.

    python tests/tools/page_tables.py      write them anew, wherever a page says where they come from

A page says so by a comment before the table: `<!-- numbers: NAME -->` for all of NAME.csv,
`<!-- numbers: NAME[ROWS]: COLUMN, COLUMN -->` for some columns, and rows whose first cell matches an
expression. Where that file is missing, the page stays as it is.
"""

import csv
import re

from places import ROOT

from mgehl.output.table import markdown, with_bands

TABLES = ROOT / "runs" / "tables"
PAGES = [ROOT / name for name in ("README.md", "configs/README.md", "runs/README.md")]
MARK = re.compile(r"(<!-- numbers: ([\w-]+)(?:\[(.+)\])?(?:: (.+))? -->\n)((?:\|.*\n)*)")


def filled(text):
    """The text of a page with its tables as the CSV files have them."""
    return MARK.sub(_table, text)


def _table(match):
    mark, name, wanted, columns, before = match.groups()
    path = TABLES / f"{name}.csv"
    if not path.exists():
        return mark + before
    with path.open(newline="") as file:
        rows = with_bands(list(csv.DictReader(file)))
    rows = [row for row in rows if re.match(wanted or "", next(iter(row.values())))]
    return f"{mark}{markdown(rows, columns.split(', ') if columns else list(rows[0]))}\n"


if __name__ == "__main__":
    for page in PAGES:
        page.write_text(filled(page.read_text()))
