"""What a run says: a line per cycle and a last block on whether to trust the answer."""

import time


class Progress:
    """Collects the history of a run and, on the rank that may speak, prints it."""

    def __init__(self, film_scale, work, speak):
        self._nm, self._work, self._speak = 1e9 * film_scale, work, speak
        self._started = time.perf_counter()
        self.rows = []

    def __call__(self, level, cycle):
        """Take one cycle; the monitor of `nested_iteration`."""
        row = {
            "grid": level.nodes,
            "speed_mm_s": 1e3 * level.speed,
            "step": cycle.step,
            "residual": cycle.residual,
            "load_error": cycle.load_error,
            "central_film_nm": cycle.central * self._nm,
            "minimum_film_nm": cycle.minimum * self._nm,
            "contact_nodes": cycle.contact_nodes,
            "cavitated_nodes": cycle.cavitated_nodes,
            "changed_nodes": cycle.changes.total,
            "linear_iterations": cycle.linear_iterations,
            "step_length": cycle.step_length,
            "convolutions": self._work(),
            "seconds": time.perf_counter() - self._started,
        }
        self.rows.append(row)
        if self._speak:
            print(_line(row), flush=True)

    @property
    def newton_steps(self):
        """Newton steps on all grids."""
        return sum(1 for row in self.rows if row["step"] > 0)


def _line(row):
    return (
        f"grid {row['grid']:5d}  {row['speed_mm_s']:9.4g} mm/s  step {row['step']:2d}  "
        f"residual {row['residual']:8.2e}  load {row['load_error']:+8.1e}  "
        f"film {row['central_film_nm']:10.4f} min {row['minimum_film_nm']:10.4f} nm  "
        f"contact {row['contact_nodes']:6d}  cavitated {row['cavitated_nodes']:6d}  "
        f"changed {row['changed_nodes']:5d}"
    )


def trust_block(result):
    """The last words of a run: the answer, and whether and why it can be trusted."""
    contact, inequality, resolution = result.contact, result.pressure_inequality, result.resolution
    verdict = "CONVERGED" if result.converged else "NOT CONVERGED"
    lines = [
        f"{verdict}: {result.reason}",
        f"  central film {result.central_film_nm:.4f} nm, minimum {result.minimum_film_nm:.4f} nm, "
        f"largest pressure {result.max_pressure_GPa:.4f} GPa",
        f"  residual {result.residual:.1e}, load error {result.load_error:.1e}, complementarity "
        f"{result.complementarity_error:.1e}, flux imbalance {result.flux_imbalance:.1e}",
        f"  contact: {contact.nodes} nodes, {100 * contact.area_fraction:.2f} % of the Hertz area; "
        f"nodes {_span(contact.x_nodes)} on Y = 0, {_span(contact.y_nodes)} on X = 0; "
        f"largest gap {contact.largest_gap_nm:.1e} nm",
        f"  pressure inequality broken at {inequality.violations} of {inequality.checked} interface nodes",
        f"  inlet: {resolution.inlet_cells:.2f} cells, {_ADVICE[resolution.verdict]}",
        f"  work: {result.work.convolutions:.1f} fine-grid convolutions, {result.work.newton_steps} Newton "
        f"steps, {result.wall_s:.1f} s on {result.ranks} ranks",
    ]
    lines += [
        f"  Eq. 2 violated at node ({each['i']}, {each['j']}) by {each['size']:.2e} p_h"
        for each in inequality.nodes[:20]
    ]
    if inequality.violations > 20:
        lines.append(f"  ... and at {inequality.violations - 20} more nodes, listed in result.json")
    return "\n".join(lines)


_ADVICE = {
    "resolved": "resolved",
    "coarse": "coarse (below 4): expect the film to change with the grid",
    "grid-determined": "grid-determined (below 1): the contact set is the grid's, not the problem's",
}


def _span(ends):
    return f"{ends[0]}..{ends[1]}" if ends else "none"
