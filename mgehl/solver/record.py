"""What is kept of a solve: named values and named arrays, which anybody can read; no class of the solver.

Names are those of the fields of the `Kept` classes; a dot parts that of a whole from that of its part. A
new one, or one that is no more, is another `output.checkpoint.FORMAT`.
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Record:
    """Values that JSON can hold, and arrays of this rank's lines, (..., lines, nx), by their names."""

    values: dict = field(default_factory=dict)
    arrays: dict = field(default_factory=dict)

    @classmethod
    def of(cls, **named):
        """A `Record` of values, arrays and parts; a part may be `Kept`. What is None is left out."""
        record = cls()
        for name, each in named.items():
            if isinstance(each, Kept):
                each = each.record()
            if isinstance(each, Record):
                record.values.update({f"{name}.{key}": value for key, value in each.values.items()})
                record.arrays.update({f"{name}.{key}": array for key, array in each.arrays.items()})
            elif isinstance(each, np.ndarray):
                record.arrays[name] = each
            elif each is not None:
                record.values[name] = each.item() if isinstance(each, np.generic) else each
        return record

    @classmethod
    def table(cls, rows):
        """The `Record` of objects with the same values: a list for each value; empty without objects."""
        records = [row.record().values for row in rows]
        return cls({name: [values[name] for values in records] for name in records[0]} if records else {})

    def rows(self):
        """The `Record` of each row of a `table`."""
        columns = zip(*self.values.values(), strict=True)
        return [Record(dict(zip(self.values, row, strict=True))) for row in columns]

    def part(self, name):
        """What is kept of a part, without its name; empty where it is not there."""
        start = f"{name}."
        return Record(
            {key.removeprefix(start): each for key, each in self.values.items() if key.startswith(start)},
            {key.removeprefix(start): each for key, each in self.arrays.items() if key.startswith(start)},
        )

    def without(self, name):
        """The rest, without that part."""
        start = f"{name}."
        return Record(
            {key: each for key, each in self.values.items() if not key.startswith(start)},
            {key: each for key, each in self.arrays.items() if not key.startswith(start)},
        )

    @classmethod
    def from_record(cls, record):
        """The `record` itself, where it is a part that its owner makes something of."""
        return record

    def __bool__(self):
        """Whether anything is kept."""
        return bool(self.values or self.arrays)


class Kept:
    """A dataclass of values, arrays and others of its kind: what it keeps has the names of its fields."""

    PARTS = {}
    """{field: class} of those that are `Kept` themselves, or a `Record`."""
    ROWS = {}
    """{field: (its name in records, class)} of lists of such."""

    def record(self):
        """The `Record` of it, whose arrays are its own and no copies."""
        named = dict(vars(self))
        for own, (name, _) in self.ROWS.items():
            named[name] = Record.table(named.pop(own))
        return Record.of(**named)

    @classmethod
    def from_record(cls, record):
        """The one that a `Record` was made of. KeyError or TypeError where it is another's."""
        made = {}
        for own, kind in cls.PARTS.items():
            part, record = record.part(own), record.without(own)
            if part:
                made[own] = kind.from_record(part)
        for own, (name, kind) in cls.ROWS.items():
            made[own] = [kind.from_record(row) for row in record.part(name).rows()]
            record = record.without(name)
        return cls(**made, **record.values, **record.arrays)
