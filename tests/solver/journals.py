"""Journals of runs that were stopped: what one kept before a step another goes on from."""

from mgehl.solver.journal import Journal
from mgehl.solver.record import Record


class Kept(Journal):
    """What a checkpoint would have before every step on a grid of so many nodes."""

    def __init__(self, nodes=65):
        self.nodes, self.records = nodes, []

    def step(self, grid, position):
        if grid.mesh.nx == self.nodes:
            record = position.record()
            arrays = {name: each.copy() for name, each in record.arrays.items()}
            self.records.append(Record(dict(record.values), arrays))


class Standing(Journal):
    """Of a run that was stopped there."""

    def __init__(self, record, nodes=65):
        self.nodes, self.record = nodes, record

    def standing(self, grid, made):
        return made(self.record) if grid.mesh.nx == self.nodes else None
