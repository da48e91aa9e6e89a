"""Which grid a film needs by each scheme: errors of many full films at 2, 4 and 8 cells in the inlet.

The domain of a film is chosen so that its first grid has two cells in the inlet. All its grids have that
domain, so that errors are the grid's alone. Limits are Richardson's, from the finest grids by the best
scheme.
"""

from dataclasses import dataclass
from itertools import product
from statistics import median

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.studies.schemes import saw_tooth
from mgehl.studies.study import BEST, merged, plausible, richardson

LIMITS_BY = tuple(BEST.values())
"""Couette scheme and mean of the mobility that give the limits."""

SCHEMES = (*product(("1B", "2B", "3B"), ("arithmetic", "logarithmic")), LIMITS_BY)

CELLS = (2, 4, 8)
LARGEST = 257
"""Nodes of the largest grid on which every scheme is solved, unless a case begins with that grid."""

RADIUS = 12.7e-3
OUTLET, BESIDE = 1.25, 6.0
"""Least room behind the centre in semi-axes, and room beside the contact in lengths of the inlet."""


@dataclass(frozen=True)
class Film:
    """A full film: Moes numbers, radius across over radius along, law, nodes that put two cells into the
    inlet."""

    M: float
    L: float
    nodes: int = 65
    wide: float = 1.0
    law: str = "barus"

    @property
    def name(self):
        """In words."""
        shape = "" if self.wide == 1.0 else f", Ry/Rx {self.wide:g}"
        return f"M {self.M:g}, L {self.L:g}{shape}, {self.law}"

    def tables(self):
        """Tables of the contact alone."""
        return {
            "moes": {"M": self.M, "L": self.L},
            "contact": {"radius_x": RADIUS, "radius_y": self.wide * RADIUS},
            "lubricant": {"viscosity_law": self.law},
        }

    def domain(self):
        """x and y such that the first grid has two cells in the inlet."""
        contact = contact_from(config_from_tables(self.tables()))
        length = (self.nodes - 1) / CELLS[0] * contact.inlet_length
        outlet, half = (
            max(OUTLET, 0.25 * length),
            1.0 + max(0.3, BESIDE * contact.inlet_length * contact.k_e),
        )
        return {"x": [outlet - length, outlet], "y": [-half, half]}

    def grids(self):
        """Nodes of the grids on which all schemes are solved, and of one more grid for the limit."""
        grids = [self.nodes]
        while grids[-1] < LARGEST:
            grids.append(2 * grids[-1] - 1)
        return grids, 2 * grids[-1] - 1


FILMS = (
    Film(10, 2), Film(10, 10), Film(30, 5, law="roelands"), Film(100, 10), Film(100, 10, law="roelands"),
    Film(200, 5), Film(200, 15), Film(200, 10, wide=0.35), Film(200, 10, wide=8.5),
    Film(500, 10, wide=2.9, law="roelands"), Film(1000, 12, 129), Film(1000, 10, 129, law="roelands"),
    Film(2000, 7, 129), Film(13000, 2, 513),
)  # fmt: skip


def run(study):
    """Solve all; write the tables `films` and `summary`."""
    study.cases = sum(1 + len(SCHEMES) * len(film.grids()[0]) for film in FILMS)
    rows = [row for film in FILMS for row in _rows_of_film(study, film)]
    study.write_table("films", rows)
    study.write_table("summary", [_summary(rows, scheme, cells) for scheme in SCHEMES for cells in CELLS])


def _rows_of_film(study, film):
    """Every scheme on every grid beside the limit."""
    grids, finest = film.grids()
    solved = {scheme: [_solve(study, film, n, *scheme) for n in grids] for scheme in SCHEMES}
    limits = _limits([*solved[LIMITS_BY], _solve(study, film, finest, *LIMITS_BY)])
    return [
        _row(film, scheme, CELLS[k], solution, limits)
        for scheme, solutions in solved.items()
        for k, solution in enumerate(solutions)
    ]


def _solve(study, film, nodes, couette, mean):
    tables = merged(
        film.tables(),
        {
            "grid": film.domain() | {"nodes": nodes},
            "discretization": {"couette": couette, "face_mobility": mean},
        },
    )
    return study.solve(f"{film.name}, {couette}, {mean}, {nodes} nodes", tables, must_converge=False)


def _limits(solutions):
    """Central and minimum film for an infinite number of nodes, in nm."""
    results = [solution.result for solution in solutions]
    return [
        _limit([getattr(result, name) for result in results])
        for name in ("central_film_nm", "minimum_film_nm")
    ]


def _limit(values):
    """Richardson's limit; by second order where three grids do not show an order."""
    limit, order = richardson(values) if len(values) > 2 else (None, 0.0)
    return limit if plausible(order) else values[-1] + (values[-1] - values[-2]) / 3.0


def _row(film, scheme, cells, solution, limits):
    result = solution.result
    films = result.central_film_nm, result.minimum_film_nm
    errors = [100.0 * (value / limit - 1.0) for value, limit in zip(films, limits, strict=True)]
    tooth = saw_tooth(solution) if solution.fields else float("nan")
    return {
        "film": film.name,
        "couette": scheme[0],
        "mean": scheme[1],
        "cells": str(cells),
        "nodes": str(solution.mesh.nx),
        "converged": "yes" if result.converged else "no",
        "central nm": f"{films[0]:.3f}",
        "minimum nm": f"{films[1]:.3f}",
        "central error %": f"{errors[0]:+.2f}",
        "minimum error %": f"{errors[1]:+.2f}",
        "limit central nm": f"{limits[0]:.3f}",
        "limit minimum nm": f"{limits[1]:.3f}",
        "saw-tooth %": f"{100.0 * tooth / films[0]:+.3f}",
        "convolutions": f"{result.work.convolutions:.0f}",
    }


def _summary(rows, scheme, cells):
    """Errors of a scheme's films at so many cells, and the work that they took."""
    which = {"couette": scheme[0], "mean": scheme[1], "cells": str(cells)}
    own = [row for row in rows if which.items() <= row.items()]
    good = [row for row in own if row["converged"] == "yes"]
    summary = which | {"converged": f"{len(good)} of {len(own)}"}
    for film in ("central", "minimum"):
        errors = [abs(float(row[f"{film} error %"])) for row in good]
        summary[f"median {film} error %"] = f"{median(errors):.2f}"
        summary[f"largest {film} error %"] = f"{max(errors):.2f}"
    return summary | {"convolutions": f"{sum(float(row['convolutions']) for row in good):.0f}"}
