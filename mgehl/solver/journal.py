"""What a run has reached, told to whoever keeps it."""


class Journal:
    """Keeps nothing; `output.checkpoint.Checkpoint` keeps everything (collective on the comm of `grid`).

    Each solve of a run asks whether it was finished (`recall`) or under way (`standing`) before, and tells
    of every step and its end. What is told has a `record()`; `made` turns that back into an object.
    """

    def recall(self, grid, made):
        """The end of the next solve where it is finished, else None."""

    def standing(self, grid, made):
        """Where the next solve stood when the run was stopped; None at its beginning."""

    def step(self, grid, position):
        """Take note of the `position` before a step: all that the way from here depends on. Raises
        `errors.Stopped` when the run is to end here."""

    def finish(self, grid, outcome):
        """Take note of the `outcome`, the end of a solve."""


class Asked(Journal):
    """Keeps nothing, but may be told to stop."""

    def __init__(self, stop):
        self._stop = stop

    def step(self, grid, position):
        """Raise the `Stopped` of whoever was told."""
        if stopped := told_to_stop(grid.comm, self._stop):
            raise stopped


def told_to_stop(comm, stop):
    """The `Stopped` that `stop` returns on any rank, else None (collective). A signal may reach one rank
    only, and clocks differ."""
    return next((each for each in comm.allgather(stop()) if each), None)


NOTHING_KEPT = Journal()
