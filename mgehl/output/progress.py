"""The history of a run while it runs: a row for each cycle, and the time that is left."""

import time
from math import inf, isfinite, log

STEPS_A_GRID = 8
"""Newton steps that a grid not yet begun is expected to take."""


class Progress:
    """Collects the history of a run and tells the speaker of it, with the time that is left: the monitor of
    a `Task`. `kind` makes a cycle a row: `newton_row` and its like. A run that goes on begins with what its
    checkpoint had of it (`record`, `go_on`)."""

    def __init__(self, kind, film_scale, hierarchy, tolerance, speaker):
        self._kind, self._nm, self._hierarchy, self._speaker = kind, 1e9 * film_scale, hierarchy, speaker
        self._finest, self._tolerance = hierarchy.grids[-1].mesh.nx, tolerance
        self._started = time.perf_counter()
        self._news = ""
        self.rows = []

    def __call__(self, level, cycle):
        """Take one cycle."""
        if level.news and level.news != self._news:
            self.news(level.news)
            self._news = level.news
        row = self._row(self._kind, level, cycle)
        self.rows.append(row)
        self._speaker.row(row, seconds_left(self.rows, self._finest, self._tolerance))

    def take(self, row, left):
        """Take a row of the history that is no cycle's, with the seconds that are left."""
        self.rows.append(row)
        self._speaker.row(row, left)

    def beside(self, level, cycle):
        """Tell of a cycle that does not lead to the answer; the history does not keep it. All but those of
        dry contacts are Newton's."""
        kind = dry_row if self._kind is dry_row else newton_row
        self._speaker.row(self._row(kind, level, cycle))

    def tell(self, row, left):
        """Tell of a row that the history does not keep, with the seconds that are left."""
        self._speaker.row(row, left)

    def news(self, words):
        """Tell of what comes next."""
        self._speaker.news(words)

    def _row(self, kind, level, cycle):
        speed = {} if level.speed is None else {"speed_mm_s": 1e3 * level.speed}
        row = {"grid": level.nodes} | speed | kind(cycle, self._nm)
        return row | {"convolutions": self.convolutions, "seconds": self.seconds}

    @property
    def convolutions(self):
        """In equivalents of one on the finest grid, those of the part before included."""
        return self._hierarchy.convolutions

    @property
    def seconds(self):
        """Of work, that of the part before included."""
        return time.perf_counter() - self._started

    @property
    def steps(self):
        """Newton steps or sweeps on all grids."""
        return sum(1 for row in self.rows if row["step"] > 0)

    def record(self):
        """Everything that was collected, as plain data."""
        return {"rows": self.rows, "convolutions": self.convolutions, "seconds": self.seconds}

    def go_on(self, record):
        """Begin where a `record` was made."""
        self.rows = list(record["rows"])
        self._hierarchy.go_on(record["convolutions"])
        self._started = time.perf_counter() - record["seconds"]


def newton_row(cycle, nm):
    """What history.csv keeps of a Newton cycle; `nm` is nanometres in a unit of H."""
    return _state_row(cycle, nm) | {
        "changed_nodes": cycle.changes.total,
        "linear_iterations": cycle.linear_iterations,
        "step_length": cycle.step_length,
    }


def sweep_row(sweep, nm):
    """Of a relaxation sweep."""
    errors = {"e_p": sweep.e_p, "e_p_lubr": sweep.e_p_fluid, "e_p_solid": sweep.e_p_solid}
    return _state_row(sweep, nm) | errors


def dry_row(step, nm):
    """Of a set of pressed nodes."""
    return vars(step) | {"gap_nm": step.residual * nm}


def _state_row(cycle, nm):
    """The state that a Newton cycle or a sweep starts from."""
    films = {"central_film_nm": cycle.central * nm, "minimum_film_nm": cycle.minimum * nm}
    errors = {name: getattr(cycle, name) for name in ("step", "residual", "load_error")}
    return errors | films | {name: getattr(cycle, name) for name in ("contact_nodes", "cavitated_nodes")}


def wedge_rows(nodes, steps):
    """The history of a wedge: what each linear solve found and took."""
    return [
        {"grid": nodes, "step": k, "residual": step.residual, "linear_iterations": step.linear_iterations}
        for k, step in enumerate(steps)
    ]


def seconds_left(rows, finest, tolerance):
    """Guess the time to the end from the history; None where that is too short to tell.

    On the present grid residuals go on falling as in the last steps; a finer one takes a few steps, each
    four times as long. A walk in speed has more solves to come, of which nothing is known here.
    """
    begun = max((k for k, row in enumerate(rows) if row["step"] == 0), default=0)
    here, nodes = rows[begun:], rows[-1]["grid"]  # a run may solve on the finest grid several times
    if len(here) < 2 or not isfinite(here[-1]["residual"]):
        return None
    each = (here[-1]["seconds"] - here[0]["seconds"]) / (len(here) - 1)
    first, *others, last = (row["residual"] for row in here[-4:])
    steps = STEPS_A_GRID
    if last <= tolerance:
        steps = 0.0
    elif last < first < inf:
        steps = log(last / tolerance) / log(first / last) * (1 + len(others))
    left = steps * each
    while nodes < finest:
        nodes, each = 2 * nodes - 1, 4.0 * each
        left += STEPS_A_GRID * each
    return left
