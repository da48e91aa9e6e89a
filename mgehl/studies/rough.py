"""Whether the bands about gaps, pressure, loads and friction of rough contacts hold what finer grids find:
rollers and contacts of machines drawn at random, which slide.

Each grid's band is asked for what the finest grid finds. Nothing is extrapolated: rough contacts show no
order.
"""

from mgehl.studies import machine, rollers
from mgehl.studies.limits import judged, number_of, summary
from mgehl.studies.study import merged

GRIDS = {"line": (513, 1025, 2049), "point": (65, 129, 257)}
"""Grids on which bands are made, by kind of contact; the last one tells what they should hold."""

CASES, SEED = 32, 30111
"""Half of them rollers. No rule of the bands was chosen on what this seed draws."""

SLIDES = {
    "motion": {"slide_to_roll": 1.0},
    "friction": {
        "model": "limiting", "eyring_stress": 5e6, "limiting_coefficient": 0.05,
        "boundary_coefficient": 0.12, "thinning": False,
    },
}  # fmt: skip
"""Friction that does not thin the film."""

BANDED = {
    "mean gap": "mean_gap_nm",
    "gap by pressure": "loaded_gap_nm",
    "largest pressure": "max_pressure_GPa",
    "load on contact": "load_on_contact",
    "load on solids": "load_on_solids",
    "friction": "friction",
}


def run(study):
    """Solve all; write the tables `cases` and `bands`."""
    drawn = study.drawn(draw, CASES, SEED)
    study.expected = sum(len(GRIDS[kind]) for kind, _ in drawn.values())
    rows, bands = [], {}
    for name, (kind, tables) in drawn.items():
        *coarse, finest = _on_grids(study, name, tables, GRIDS[kind])
        for solution in coarse if finest else ():
            limits = {each: number_of(of, finest.result) for each, of in BANDED.items()}
            row, own = judged(name, solution, "lambda, inlet cells", limits, BANDED)
            rows.append(row)
            for each, band in own.items():
                bands.setdefault(f"{each}, {kind}", []).append(band)
    study.write_table("cases", rows)
    study.write_table("bands", summary(bands))


def draw(cases, seed):
    """{name: (kind, nested tables)} of so many contacts, rollers first."""
    lines, points = rollers.draw(cases - cases // 2, seed), machine.draw(cases // 2, seed)
    found = {f"roller {each.title}": ("line", each.tables) for each in lines}
    found |= {f"machine {each.title}": ("point", each.tables) for each in points}
    return {name: (kind, merged(tables, SLIDES)) for name, (kind, tables) in found.items()}


def _on_grids(study, name, tables, grids):
    """A `Solution` of each grid that converged, and last that of the finest one, or None."""
    cases = {
        f"{name}, {n} nodes": merged(tables, {"grid": {"nodes": n}, "solver": {"error": n < grids[-1]}})
        for n in grids
    }
    found = dict(study.solved(cases, must_converge=False))
    *coarse, finest = (found.get(title) for title in cases)
    return *filter(_converged, coarse), finest if _converged(finest) else None


def _converged(solution):
    return solution is not None and solution.result.converged
