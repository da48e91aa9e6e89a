"""Whether the bands about runs in time hold the limit: roughness that moves, by chance; speeds and loads
that change. Each beside a finer grid.

The limit is told from the two finest grids by the first order, which the bands think of.
"""

import numpy as np

from mgehl.output.digits import with_band
from mgehl.output.series import MEANS
from mgehl.studies.chance import by_logarithm
from mgehl.studies.columns import told
from mgehl.studies.courses import COURSES
from mgehl.studies.courses import case as course
from mgehl.studies.limits import JudgedBand, summary
from mgehl.studies.machine import p_h_of_one
from mgehl.studies.study import merged

NODES, CASES, SEED = (65, 129), 12, 24
"""Grids on which bands are made; the last one is refined once for the limit."""

RADIUS, MODULUS = 12.5e-3, 110e9
"""Of the balls: m, E' in Pa."""

PRESSURE, SPEED, RMS = (0.3e9, 1.2e9), (0.01, 0.5), (2e-8, 2e-7)
"""From, to: the largest pressure of smooth bodies in Pa, m/s, roughness in m."""

SHORTEST, LONGEST = (0.3, 0.6), (1.5, 4.0)
"""Shortest wave over the contact's radius, longest over the shortest."""

SLIDE_TO_ROLL, LASTS = (-1.0, 1.0), 1.5
"""From, to; passages that a run takes."""

OIL = {"viscosity": 0.25, "viscosity_law": "roelands", "pressure_viscosity": 22e-9}
DOMAIN = {"x": [-2.5, 1.5], "y": [-2.0, 2.0]}

WITHIN = "of a passage", "of the run", "at the end"
"""What a mean is over; or when a number is."""


def run(study):
    """Solve all; write the tables `passages` and `passages-bands`."""
    nodes = study.asked.nodes or NODES
    grids = *nodes, 2 * nodes[-1] - 1
    changing = {title: course(nodes[0], *how) for title, how in COURSES.items()}
    cases = changing | study.drawn(draw, CASES, SEED)
    study.expected = len(cases) * len(grids)
    rows, bands = [], {}
    for title, tables in cases.items():
        asked = {
            f"{title}, {n} nodes": merged(tables, {"grid": {"nodes": n}, "solver": {"error": True}})
            for n in grids
        }
        found = [each for _, each in study.solved(asked) if each.result.converged]
        if len(found) == len(grids):
            rows.extend(_judged(title, found, bands))
    study.write_table("passages", rows)
    study.write_table("passages-bands", list(summary(bands)))


def draw(cases, seed):
    """So many random runs, {name: nested tables}. A longer list begins with the same ones."""
    return dict(_drawn(np.random.default_rng([seed, number]), number) for number in range(1, cases + 1))


def _drawn(chance, number):
    """(Name, tables) of one: a ball with a rough surface, on it or on what it rolls on."""
    pressure, speed, rms = (by_logarithm(chance, *ends) for ends in (PRESSURE, SPEED, RMS))
    ball = {"radius_x": RADIUS, "radius_y": RADIUS, "reduced_modulus": MODULUS}
    load = (pressure / p_h_of_one(ball, "load")) ** 3
    radius = (1.5 * load * RADIUS / MODULUS) ** (1.0 / 3.0)
    shortest, sliding = radius * chance.uniform(*SHORTEST), chance.uniform(*SLIDE_TO_ROLL)
    body = str(chance.choice(("body_1", "body_2")))
    share = 1.0 + (0.5 if body == "body_1" else -0.5) * sliding
    name = f"{number}: {1e9 * rms:.0f} nm on {body}, {1e3 * speed:.0f} mm/s, slide-to-roll {sliding:.2f}"
    return name, {
        "contact": ball | {"load": float(load), "boundary_film": 2e-9},
        "lubricant": OIL,
        "motion": {"speed": speed, "slide_to_roll": float(sliding)},
        "surface": {
            "kind": "self-affine", "rms": rms, "hurst": 0.8, "seed": number, "body": body,
            "shortest_wavelength": float(shortest),
            "longest_wavelength": float(shortest * by_logarithm(chance, *LONGEST)),
        },
        "grid": DOMAIN,
        "time": {"end": float(LASTS * 2.0 * radius / (share * speed))},
    }  # fmt: skip


def _judged(title, found, bands):
    """Rows of a case, one for each number on each grid but the finest; `bands`, {name: [JudgedBand]}, get
    what each says."""
    fine, coarse = map(_values, found[:-3:-1])
    for solution in found[:-1]:
        values, halves, time = _values(solution), _half_widths(solution), solution.result.time
        for key in (key for key in fine if key in coarse and key in halves):
            band = JudgedBand(values[key], halves[key], 2.0 * fine[key] - coarse[key])
            name = " ".join(key)
            bands.setdefault(name, []).append(band)
            yield {
                "case": title,
                "nodes": str(solution.mesh.nx),
                "steps": str(time.steps),
                **told(solution.result, "inlet cells"),
                "of": name,
                "value": with_band(band.value, band.half_width),
                "limit": f"{band.limit:.4g}",
                "band/error": band.over_error,
            }


def _values(solution):
    """{(column, what of): number} of a run."""
    time, last = solution.result.time, solution.rows[-1]
    of_passage, of_run, at_the_end = WITHIN
    means = {(name, of_passage): mean.value for name, mean in time.means.items()}
    whole = {(name, of_run): value for name, value in time.whole.items()}
    return means | whole | {(name, at_the_end): last[name] for name in MEANS}


def _half_widths(solution):
    """{(column, what of): half-width} of its bands."""
    error = solution.result.time.error
    parts = zip(WITHIN, (error.means, error.whole, error.at_the_end), strict=True)
    return {(name, within): half for within, found in parts for name, half in found.items()}
