"""Where a solve stands as plain data and whole-grid arrays, and back again on any number of ranks."""

from dataclasses import fields, is_dataclass

import numpy as np

from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes, Contradiction, Past
from mgehl.solver.position import Position, Step, Trial
from mgehl.solver.problem import State
from mgehl.solver.relaxation import Standing, Sweep

KINDS = {
    kind.__name__: kind
    for kind in (
        Changes,
        Contradiction,
        Cycle,
        Outcome,
        Past,
        Position,
        Standing,
        State,
        Step,
        Sweep,
        Trial,
    )  # fmt: skip
}
"""What a record may hold: nothing else comes to life when one is read."""


class Writer:
    """Turns objects into JSON's values; local arrays are gathered into `arrays` (on rank 0)."""

    def __init__(self, grid):
        self._grid, self.arrays = grid, {}

    def plain(self, value):
        """The value as plain data (collective)."""
        if is_dataclass(value):
            inside = {field.name: self.plain(getattr(value, field.name)) for field in fields(value)}
            return {"kind": type(value).__name__, "fields": inside}
        if isinstance(value, np.ndarray):
            name = f"array{len(self.arrays)}"
            self.arrays[name] = self._grid.gather(value)
            return {"array": name}
        if isinstance(value, tuple):
            return {"tuple": [self.plain(each) for each in value]}
        if isinstance(value, list):
            return [self.plain(each) for each in value]
        return value.item() if isinstance(value, np.generic) else value


class Reader:
    """Turns plain data back into objects; rank 0 has the whole `arrays`, every rank gets its lines."""

    def __init__(self, grid, arrays):
        self._grid, self._arrays = grid, arrays

    def alive(self, plain):
        """The object that `plain` was made of (collective)."""
        if isinstance(plain, dict) and "kind" in plain:
            inside = {name: self.alive(value) for name, value in plain["fields"].items()}
            return KINDS[plain["kind"]](**inside)
        if isinstance(plain, dict) and "tuple" in plain:
            return tuple(self.alive(each) for each in plain["tuple"])
        if isinstance(plain, dict):
            return self._grid.scatter(self._arrays[plain["array"]] if self._arrays else None)
        if isinstance(plain, list):
            return [self.alive(each) for each in plain]
        return plain
