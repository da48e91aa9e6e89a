"""What a run says while it runs: a line of text for each cycle."""

import time
from dataclasses import dataclass

from mgehl.kinds.loaded import speed_words
from mgehl.output.terminal import seconds_left


class Progress:
    """Collects the history of a run and tells the speaker of it, with the time that is left.

    The monitor of `nested_iteration` and its like. `kind` says what is kept and told of a cycle.
    A run that goes on begins with what its checkpoint had of all this (`record`, `go_on`).
    """

    def __init__(self, kind, film_scale, hierarchy, tolerance, speaker):
        self._kind, self._nm, self._hierarchy, self._speaker = kind, 1e9 * film_scale, hierarchy, speaker
        self._finest, self._tolerance = hierarchy.grids[-1].mesh.nx, tolerance
        self._started, self._convolutions_before = time.perf_counter(), 0.0
        self._news = ""
        self.rows = []

    def __call__(self, level, cycle):
        """Take one cycle."""
        if level.news and level.news != self._news:
            self._speaker.news(level.news)
            self._news = level.news
        row = self._row(self._kind, level, cycle)
        self.rows.append(row)
        left = seconds_left(self.rows, self._finest, self._tolerance)
        self._speaker.row(row, self._line(self._kind, row), left)

    def beside(self, level, cycle):
        """Tell of a Newton cycle that does not lead to the answer; the history does not keep it."""
        row = self._row(NEWTON, level, cycle)
        self._speaker.row(row, self._line(NEWTON, row))

    def _line(self, kind, row):
        return (kind.line if self._speaker.verbose else kind.short)(row)

    def _row(self, kind, level, cycle):
        speed = {} if level.speed is None else {"speed_mm_s": 1e3 * level.speed}
        row = {"grid": level.nodes} | speed | kind.row(cycle, self._nm)
        return row | {"convolutions": self.convolutions, "seconds": self.seconds}

    @property
    def convolutions(self):
        """In equivalents of one on the finest grid, those of the part before included."""
        return self._convolutions_before + self._hierarchy.convolutions

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
        self._convolutions_before = record["convolutions"] - self._hierarchy.convolutions
        self._started = time.perf_counter() - record["seconds"]


def newton_row(cycle, nm):
    """What history.csv keeps of a Newton cycle."""
    return _state_row(cycle, nm) | {
        "changed_nodes": cycle.changes.total,
        "linear_iterations": cycle.linear_iterations,
        "step_length": cycle.step_length,
    }


def short_line(row):
    """A Newton cycle or a sweep on the terminal, in 80 columns."""
    return (
        f"{row['grid']:4d} nodes  {speed_words(1e-3 * row['speed_mm_s']):>9}  step {row['step']:2d}  "
        f"residual {row['residual']:7.1e}  film {row['central_film_nm']:6.4g} nm  "
        f"contact {row['contact_nodes']}"
    )


def newton_line(row):
    """All of a Newton cycle."""
    return f"{_state(row)}  changed {row['changed_nodes']:5d}"


def sweep_row(sweep, nm):
    """What history.csv keeps of a relaxation sweep."""
    errors = {"e_p": sweep.e_p, "e_p_lubr": sweep.e_p_fluid, "e_p_solid": sweep.e_p_solid}
    return _state_row(sweep, nm) | errors


def sweep_line(row):
    """All of a relaxation sweep."""
    apart = f"lubr. {row['e_p_lubr']:8.2e}, solid {row['e_p_solid']:8.2e}"
    return f"{_state(row)}  e^p {row['e_p']:8.2e} ({apart})"


def dry_row(step, nm):
    """What history.csv keeps of a set of pressed nodes."""
    return vars(step) | {"gap_nm": step.residual * nm}


def short_dry_line(row):
    """A set of pressed nodes on the terminal, in 80 columns."""
    return (
        f"{row['grid']:4d} nodes  step {row['step']:2d}  gap in contact {row['gap_nm']:7.1e} nm  "
        f"contact {row['contact_nodes']}  changed {row['changed_nodes']}"
    )


def dry_line(row):
    """All of a set of pressed nodes."""
    return (
        f"grid {row['grid']:5d}  dry  step {row['step']:2d}  gap in contact {row['gap_nm']:8.2e} nm  "
        f"contact {row['contact_nodes']:6d}  changed {row['changed_nodes']:5d}  "
        f"iterations {row['linear_iterations']:3d}"
    )


@dataclass(frozen=True)
class Kind:
    """What history.csv keeps of a cycle and what the terminal shows of that: all, or a short line."""

    row: object
    line: object
    short: object


NEWTON = Kind(newton_row, newton_line, short_line)
RELAXATION = Kind(sweep_row, sweep_line, short_line)
DRY = Kind(dry_row, dry_line, short_dry_line)


def _state_row(cycle, nm):
    """The state that a Newton cycle or a sweep starts from."""
    return {
        "step": cycle.step,
        "residual": cycle.residual,
        "load_error": cycle.load_error,
        "central_film_nm": cycle.central * nm,
        "minimum_film_nm": cycle.minimum * nm,
        "contact_nodes": cycle.contact_nodes,
        "cavitated_nodes": cycle.cavitated_nodes,
    }


def _state(row):
    return (
        f"grid {row['grid']:5d}  {row['speed_mm_s']:9.4g} mm/s  step {row['step']:2d}  "
        f"residual {row['residual']:8.2e}  load {row['load_error']:+8.1e}  "
        f"film {row['central_film_nm']:10.4f} min {row['minimum_film_nm']:10.4f} nm  "
        f"contact {row['contact_nodes']:6d}  cavitated {row['cavitated_nodes']:6d}"
    )


def wedge_rows(nodes, steps):
    """The history of a wedge: what each linear solve found and took."""
    return [
        {"grid": nodes, "step": k, "residual": step.residual, "linear_iterations": step.linear_iterations}
        for k, step in enumerate(steps)
    ]


def wedge_line(row):
    """A linear solve on the terminal."""
    return (
        f"grid {row['grid']:5d}  solve {row['step']:2d}  residual {row['residual']:8.2e}  "
        f"iterations {row['linear_iterations']:3d}"
    )
