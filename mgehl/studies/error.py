"""Whether the bands about films hold the limit: contacts of every sort, each beside finer grids on its
domain.

The limit is Richardson's, from the two finest grids of the scheme that converges fastest; all schemes are
compared with it. A case is a contact on a grid that puts at least one cell into its inlet. With `--cases`
so many random point contacts take the place of the list, by the best scheme alone: none of them was known
when the rules of the bands were made.
"""

from dataclasses import dataclass
from math import isfinite, nan
from statistics import median

import numpy as np

from mgehl.output.digits import with_band
from mgehl.studies.study import BEST, merged

NODES = (65, 129, 257)
"""Nodes of the grids on which bands are made."""

FINER = {"point": 1, "line": 2}
"""How often the last of these grids is refined for the limit, by kind of contact."""

WIDE = {"x": [-3.5, 1.5], "y": [-2.5, 2.5]}
WIDER = {"x": [-6.0, 3.0], "y": [-4.5, 4.5]}
NARROW = {"x": [-1.4, 1.2], "y": [-1.2, 1.2]}
DEFAULT = {"x": [-1.9, 1.3], "y": [-1.5, 1.5]}
RADIUS = 12.7e-3
"""Along x, m."""

POINTS = (
    (10, 5, 1.0, "barus", WIDER),
    (50, 2, 1.0, "barus", WIDE),
    (100, 5, 1.0, "roelands", WIDE),
    (200, 10, 1.0, "barus", DEFAULT),
    (400, 8, 0.5, "roelands", DEFAULT),
    (500, 10, 4.0, "barus", DEFAULT),
    (1000, 12, 1.0, "barus", DEFAULT),
    (2000, 10, 2.0, "roelands", DEFAULT),
    (4000, 10, 1.0, "barus", DEFAULT),
    (10000, 12, 1.0, "roelands", NARROW),
    (40000, 15, 1.0, "roelands", NARROW),
)
"""M, L, radius_y/radius_x, viscosity law, domain."""

LINES = (
    (500e3, 0.5, "barus", (-1.9, 1.3)),
    (100e3, 0.1, "roelands", (-2.5, 1.5)),
    (1e6, 0.2, "roelands", (-1.9, 1.3)),
    (30e3, 0.5, "barus", (-4.0, 2.0)),
)
"""Load in N/m, speed in m/s, viscosity law, domain."""

LOADS, MATERIALS = (10.0, 2000.0), (2.0, 14.0)
RATIOS, LAWS = (0.5, 1.0, 1.0, 2.0, 4.0), ("barus", "roelands")
"""What random contacts are drawn from: M by its logarithm, L, R_y/R_x and viscosity laws."""

SEED = 11

SCHEMES = (
    {"couette": "1B", "face_mobility": "arithmetic"},
    {"couette": "2B", "face_mobility": "arithmetic"},
    BEST,
)
FILMS = ("central", "minimum")


@dataclass(frozen=True)
class Case:
    """A film with its band beside the limit, in nm."""

    film: str
    scheme: str
    value: float
    half_width: float | None
    limit: float

    @property
    def off(self):
        """The true error."""
        return abs(self.limit - self.value)

    @property
    def holds(self):
        """Whether the limit lies within the band."""
        return self.off <= self.half_width


def run(study):
    """Solve all; write the tables `cases` and `bands`."""
    nodes, contacts, schemes = study.nodes or NODES, dict(_contacts(POINTS, LINES)), SCHEMES
    if study.wanted:
        drawn = draw(study.wanted, SEED if study.seed is None else study.seed)
        contacts, schemes = dict(_contacts(drawn, ())), (BEST,)
    study.cases = len(contacts) * (len(schemes) * len(nodes) + 1)
    rows, cases = [], []
    for name, tables in contacts.items():
        limits = _limits(_solve(study, name, tables, _finest(tables, nodes), BEST).result.error)
        for scheme in schemes:
            for n in nodes:
                result = _solve(study, name, tables, n, scheme).result
                beside = [_case(film, scheme, result, limits) for film in FILMS]
                rows.append(_row(name, n, scheme, result, beside))
                cases += beside
    study.write_table("cases", rows)
    study.write_table("bands", list(_summary(cases)))


def draw(cases, seed):
    """So many random contacts, as in `POINTS`. A longer list begins with the same ones."""
    chance = np.random.default_rng(seed)
    for _ in range(cases):
        load = round(float(np.exp(chance.uniform(*np.log(LOADS)))), 1)
        material = round(float(chance.uniform(*MATERIALS)), 2)
        domain = WIDER if load < 40.0 else WIDE if load < 300.0 else DEFAULT
        yield load, material, float(chance.choice(RATIOS)), str(chance.choice(LAWS)), domain


def _contacts(points, lines):
    """(Name, tables) of every contact."""
    for M, L, ratio, law, domain in points:
        yield (
            f"M {M}, L {L}, R_y/R_x {ratio:g}, {law}",
            {
                "moes": {"M": M, "L": L},
                "contact": {"radius_y": ratio * RADIUS},
                "lubricant": {"viscosity_law": law},
                "grid": domain,
            },
        )
    for load, speed, law, x in lines:
        yield (
            f"line, {1e-3 * load:g} N/mm, {speed:g} m/s, {law}",
            {
                "contact": {"kind": "line", "load_per_length": load},
                "motion": {"speed": speed},
                "lubricant": {"viscosity_law": law},
                "grid": {"x": list(x)},
            },
        )


def _finest(tables, nodes):
    """Nodes of the grid that the limit comes from."""
    return (nodes[-1] - 1) * 2 ** FINER[tables["contact"].get("kind", "point")] + 1


def _solve(study, name, tables, nodes, scheme):
    how = {"grid": {"nodes": nodes}, "discretization": scheme, "solver": {"error": True}}
    title = f"{name}, {_name(scheme)}, {nodes} nodes"
    return study.solve(title, merged(tables, how), must_converge=False)


def _name(scheme):
    return f"{scheme['couette']}, {scheme['face_mobility']}"


def _limits(error):
    """Richardson's limits, by film, from the two finest of the grids that a band came from."""
    if error.central_nm is None:
        return dict.fromkeys(FILMS, nan)
    finest, coarser = error.grids[:2]
    limits = {}
    for film in FILMS:
        last, before = (getattr(grid, f"{film}_nm") for grid in (finest, coarser))
        limits[film] = last + (last - before) / (2**error.order - 1)
    return limits


def _case(film, scheme, result, limits):
    value = getattr(result, f"{film}_film_nm")
    return Case(film, _name(scheme), value, getattr(result.error, f"{film}_nm"), limits[film])


def _row(name, nodes, scheme, result, beside):
    row = {
        "contact": name,
        "scheme": _name(scheme),
        "nodes": str(nodes),
        "inlet cells": f"{result.resolution.inlet_cells:.2f}",
    }
    for case in beside:
        row[f"{case.film} nm"] = with_band(case.value, case.half_width)
        row[f"{case.film} limit nm"] = f"{case.limit:.4g}"
        row[f"{case.film} band/error"] = _ratio(case)
    work = 100.0 * result.error.convolutions / result.work.convolutions
    why = "" if result.error.central_nm is not None else result.error.how
    return row | {"more work %": f"{work:.0f}", "no band": why}


def _ratio(case):
    """Half-width over the true error; marked where the band does not hold the limit."""
    if case.half_width is None or not case.off > 0.0:
        return ""
    return f"{case.half_width / case.off:.2f}{'' if case.holds else ' !'}"


def _summary(cases):
    """A row for each scheme and film: how often the band holds the limit, and how wide it is."""
    for scheme in map(_name, SCHEMES):
        for film in FILMS:
            own = [case for case in cases if (case.scheme, case.film) == (scheme, film)]
            known = [case for case in own if case.half_width is not None and isfinite(case.limit)]
            if known:
                yield _summary_row(scheme, film, known)


def _summary_row(scheme, film, known):
    ratios = [case.half_width / case.off for case in known if case.off > 0.0]
    return {
        "scheme": scheme,
        "film": film,
        "bands": str(len(known)),
        "hold the limit": str(sum(case.holds for case in known)),
        "in %": f"{100.0 * sum(case.holds for case in known) / len(known):.0f}",
        "median of half-width/error": f"{median(ratios):.2f}",
        "median error %": f"{100.0 * median(case.off / case.limit for case in known):.2f}",
    }
