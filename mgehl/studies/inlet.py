"""The line contact from far under-resolved to resolved inlets, from both starts.

A contact that blocks the inlet is a solution as long as the fluid pressure that piles up before
it stays below the contact pressure beside it [Liu eq. 25]. That pressure depends on the last gap
before the contact, and so on the grid: the study shows up to which spacing contact survives.
"""

from mgehl.studies.study import merged

NODES = (129, 257, 513, 1025, 2049, 4097, 8193, 16385)
SPEED = 7.5e-3
"""m/s: the paper's full-film case."""

BASE = {
    "contact": {
        "kind": "line",
        "load_per_length": 1859e3,
        "radius_x": 12.7e-3,
        "reduced_modulus": 219.78e9,
    },
    "motion": {"speed": SPEED},
    "grid": {"x": [-2.5, 1.5]},
}


def run(study):
    """Solve all; write the table `inlet` and the picture `inlet`."""
    nodes = study.nodes or NODES
    study.cases = 2 * len(nodes)
    rows = []
    for n in nodes:
        grid = {"grid": {"nodes": n}}
        film = study.solve(f"film start, {n} nodes", merged(BASE, grid)).result
        # Without releases the contact stays where it is, and Eq. 25 is what is looked at.
        start = {"solver": {"start": "contact", "release_budget": 0}}
        solution = study.solve(f"contact start, {n} nodes", merged(BASE, grid, start))
        rows.append(_row(n, solution.mesh.dX, film, solution.result))
    study.write_table("inlet", rows)
    from mgehl.studies import film_figures

    study.draw("inlet", film_figures.inlet, rows)


def _row(nodes, dX, film, contact):
    return {
        "nodes": str(nodes),
        "dX": f"{dX:.3e}",
        "inlet cells": f"{film.resolution.inlet_cells:.2f}",
        "film start": _ending(film),
        "central nm": f"{film.central_film_nm:.4f}",
        "minimum nm": f"{film.minimum_film_nm:.4f}",
        "contact start": _ending(contact),
        "central nm from contact": f"{contact.central_film_nm:.4f}",
        "contact nodes": str(contact.contact.nodes),
        "p_f/p_d": f"{contact.pressure_inequality.largest_ratio:.3e}",
        "residual from contact": f"{contact.residual:.1e}",
    }


def _ending(result):
    """What a start led to."""
    if result.converged:
        return "contact" if result.contact.nodes else "film"
    broken = result.pressure_inequality.violations and result.residual <= 1e-8
    return "contact, Eq. 25 broken" if broken else "not converged"
