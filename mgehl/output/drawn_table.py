"""A table of text as a terminal shows it: columns under each other, no line longer than the terminal."""

from mgehl.errors import printable
from mgehl.output.digits import is_number

WIDTH = 120
"""Columns of the table where the width of the terminal is not known."""
BETWEEN = 2
"""Spaces between columns."""


def drawn(rows, columns, width=None):
    """Some columns of the rows, dictionaries of text; numbers stand on the right.

    Columns that have no room are drawn below, with the first column repeated before them.
    """
    cells = {column: [printable(row[column]) for row in rows] for column in columns}
    first, *others = columns
    blocks = _blocks(first, others, cells, width or WIDTH)
    return "\n\n".join("\n".join(_block(block, cells)) for block in blocks)


def _blocks(first, others, cells, width):
    """Lists of columns, each with the first one and as many others as have room."""
    blocks, taken = [[first]], _wide(first, cells)
    for column in others:
        more = BETWEEN + _wide(column, cells)
        if taken + more > width and len(blocks[-1]) > 1:
            blocks.append([first])
            taken = _wide(first, cells)
        blocks[-1].append(column)
        taken += more
    return blocks


def _block(columns, cells):
    """Lines of a table of these columns: heads, a rule, rows."""
    yield _line(columns, columns, cells)
    yield _line(["─" * _wide(column, cells) for column in columns], columns, cells)
    for row in zip(*(cells[column] for column in columns), strict=True):
        yield _line(row, columns, cells)


def _line(texts, columns, cells):
    aligned = [
        f"{text:{'>' if _is_numeric(cells[column]) else '<'}{_wide(column, cells)}}"
        for text, column in zip(texts, columns, strict=True)
    ]
    return (" " * BETWEEN).join(aligned).rstrip()


def _wide(column, cells):
    return max(map(len, (column, *cells[column])))


def _is_numeric(texts):
    """True where all that is said are numbers, and something is."""
    said = [text for text in texts if text]
    return bool(said) and all(map(is_number, said))
