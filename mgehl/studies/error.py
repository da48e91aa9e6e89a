"""Whether the bands about films, largest pressure and friction hold the limit: point contacts drawn at
random, each beside a finer grid.

The limit is Richardson's, from the two finest grids. None of the contacts was known when the rules of the
bands were made.
"""

from math import nan

import numpy as np

from mgehl.output.film_error import FILMS
from mgehl.studies.limits import judged, number_of, summary
from mgehl.studies.study import BEST, merged

NODES, CASES, SEED = (65, 129, 257), 40, 11
"""Grids on which bands are made; the last one is refined once for the limit."""

RADIUS = 12.7e-3
"""Along x, m."""

LOADS, MATERIALS = (10.0, 2000.0), (2.0, 14.0)
RATIOS, LAWS = (0.5, 1.0, 1.0, 2.0, 4.0), ("barus", "roelands")
"""What contacts are drawn from: M by its logarithm, L, R_y/R_x and viscosity laws."""

SLIDES = 0.02
"""Slide-to-roll ratio: Newtonian friction, which does not thin the film."""

BANDED = {each: f"{each}_film_nm" for each in FILMS}
BANDED |= {"largest pressure": "max_pressure_GPa", "friction": "friction"}

DOMAINS = (
    (40.0, {"x": [-6.0, 3.0], "y": [-4.5, 4.5]}),
    (300.0, {"x": [-3.5, 1.5], "y": [-2.5, 2.5]}),
    (np.inf, {"x": [-1.9, 1.3], "y": [-1.5, 1.5]}),
)
"""Domains by the load M below which they are taken."""


def run(study):
    """Solve all; write the tables `cases` and `bands`."""
    nodes = study.asked.nodes or NODES
    contacts = study.drawn(draw, CASES, SEED)
    study.expected = len(contacts) * (len(nodes) + 1)
    rows, bands = [], {name: [] for name in BANDED}
    for name, contact in contacts.items():
        grids = *nodes, 2 * nodes[-1] - 1
        tables = {f"{name}, {n} nodes": merged(contact, {"grid": {"nodes": n}}) for n in grids}
        found = [each for _, each in study.solved(tables, must_converge=False)]
        if len(found) < len(grids):
            continue
        limits = limits_of(found[-1].result.error) | _limits_of_loads(*found[-2:])
        for solution in found[:-1]:
            row, own = judged(name, solution, "inlet cells", limits, BANDED)
            rows.append(row | _more(solution.result))
            for each, band in own.items():
                bands[each].append(band)
    study.write_table("cases", rows)
    study.write_table("bands", summary(bands))


def draw(cases, seed):
    """So many random contacts, {name: nested tables}. A longer list begins with the same ones."""
    chance, drawn = np.random.default_rng(seed), {}
    for _ in range(cases):
        M = round(float(np.exp(chance.uniform(*np.log(LOADS)))), 1)
        L = round(float(chance.uniform(*MATERIALS)), 2)
        ratio, law = float(chance.choice(RATIOS)), str(chance.choice(LAWS))
        drawn[f"M {M}, L {L}, R_y/R_x {ratio:g}, {law}"] = {
            "moes": {"M": M, "L": L},
            "contact": {"radius_y": ratio * RADIUS},
            "lubricant": {"viscosity_law": law},
            "grid": next(domain for below, domain in DOMAINS if below > M),
            "motion": {"slide_to_roll": SLIDES},
            "discretization": BEST,
            "solver": {"error": True},
        }
    return drawn


def limits_of(error):
    """Richardson's limits, by film, from the two finest of the grids that a band came from."""
    if error.central_nm is None:
        return dict.fromkeys(FILMS, nan)
    finest, coarser = error.grids[:2]
    limits = {}
    for film in FILMS:
        last, before = (getattr(grid, f"{film}_nm") for grid in (finest, coarser))
        limits[film] = last + (last - before) / (2**error.order - 1)
    return limits


def _limits_of_loads(coarse, fine):
    """The same of what else has bands, which is of the second order in the spacing."""
    of_loads = {name: of for name, of in BANDED.items() if name not in FILMS}
    return {
        name: (4.0 * number_of(of, fine.result) - number_of(of, coarse.result)) / 3.0
        for name, of in of_loads.items()
    }


def _more(result):
    """What bands cost, and why there are none."""
    more = f"{100.0 * result.error.convolutions / result.work.convolutions:.0f}"
    return {"more work %": more, "no band": "" if result.error.central_nm is not None else result.error.how}
