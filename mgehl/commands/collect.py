"""mgehl collect: make one table of several run directories

Print a Markdown table with a row for each run directory.

example: mgehl collect runs/try --columns 'run,motion.speed,central nm' --out runs/try.csv
"""

from pathlib import Path

from mgehl.errors import OutputError, UserError
from mgehl.saying import complain


def add(parser):
    parser.add_argument("runs", nargs="+", metavar="RUN", help="run directory")
    parser.add_argument("--out", metavar="FILE", help="write the whole table as CSV, too")
    parser.add_argument("--columns", metavar="A,B", help="print only these columns; any key of "
                        "the configuration may be one")  # fmt: skip


def execute(options):
    """Print the table, drawn on a terminal and else in Markdown; write it as CSV, too, where asked to."""
    from mgehl.config import KEYS
    from mgehl.output.files import csv_text
    from mgehl.output.table import collect, drawn, markdown, with_bands
    from mgehl.output.whole_file import write_whole
    from mgehl.saying import columns as terminal_columns

    named = options.columns.split(",") if options.columns else []
    try:
        rows = collect(options.runs, [column for column in named if column in KEYS], _left_out)
        if options.out:
            Path(options.out).parent.mkdir(parents=True, exist_ok=True)
            write_whole(options.out, csv_text(rows))
    except OSError as error:
        raise OutputError(f"{error.filename}: {error.strerror}") from None
    except (ValueError, KeyError) as error:
        raise OutputError(f"a file of these runs is damaged: {error}") from None
    rows = with_bands(rows)
    columns = named or [column for column in rows[0] if any(row[column] for row in rows)]
    unknown = [column for column in columns if column not in rows[0]]
    if unknown:
        raise UserError(f"--columns {unknown[0]}: known are {', '.join(rows[0])}, and keys (mgehl keys)")
    width = terminal_columns()
    print(drawn(rows, columns, width) if width else markdown(rows, columns))


def _left_out(error):
    """Tell what is no run: a pattern of the shell may name anything."""
    complain(f"left out: {error}")
