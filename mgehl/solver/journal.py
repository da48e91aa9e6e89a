"""What a run has reached, told to whoever keeps it."""


class Journal:
    """Keeps nothing. `output.checkpoint.Checkpoint` is the one that keeps everything on disk.

    A run is a row of solves. Each asks first whether it was finished before (`recall`), then whether it was
    under way (`standing`); it tells of every step and of its end. What it tells of has a `record()`, and
    `made` turns that `Record` back into an object (`solver.record`). All methods are collective on the
    communicator of `grid`.
    """

    def recall(self, grid, made):
        """The end of the next solve where it is finished, else None."""

    def standing(self, grid, made):
        """Where the next solve stood when the run was stopped; None at its beginning."""

    def step(self, grid, position):
        """Take note of the `position` before a step: all that the way from here depends on.

        Raises `errors.Stopped` when the run is to end here.
        """

    def finish(self, grid, outcome):
        """Take note of the `outcome`, the end of a solve."""


def told_to_stop(comm, stop):
    """The `Stopped` that `stop` returns on any rank, else None (collective).

    A signal may reach one rank only, and clocks differ.
    """
    return next((each for each in comm.allgather(stop()) if each), None)


NOTHING_KEPT = Journal()
