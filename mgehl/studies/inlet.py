"""The line contact from far under-resolved to resolved inlets, from both starts.

A contact that blocks the inlet is a solution as long as the fluid pressure that builds up before it stays
below the contact pressure beside it [Liu eq. 25]. The fluid pressure depends on the last gap before the
contact, and so on the grid: the study shows down to which spacing contact survives.
"""

from mgehl.studies.study import merged

NODES = (129, 257, 513, 1025, 2049, 4097, 8193, 16385)
SPEEDS = (7.5e-3, 1e-3)
"""m/s: the paper's full-film case, and a slower one whose film needs a finer grid."""

BASE = {
    "contact": {
        "kind": "line",
        "load_per_length": 1859e3,
        "radius_x": 12.7e-3,
        "reduced_modulus": 219.78e9,
    },
    # No grid has a node on the Hertz edge, where contact pressure and gap both vanish.
    "grid": {"x": [-2.5, 1.6]},
}


def run(study):
    """Solve all; write the table `inlet` and the picture `inlet`."""
    nodes = study.nodes or NODES
    study.cases = 2 * len(nodes) * len(SPEEDS)
    rows = [_solve(study, speed, n) for speed in SPEEDS for n in nodes]
    study.write_table("inlet", rows)
    from mgehl.studies import film_figures

    study.draw("inlet", film_figures.inlet, rows)


def _solve(study, speed, nodes):
    """A row: one grid from both starts."""
    case = merged(BASE, {"motion": {"speed": speed}, "grid": {"nodes": nodes}})
    title = f"{1e3 * speed:g} mm/s, {nodes} nodes"
    film = study.solve(f"{title}, from film", case, must_converge=False)
    start = {"solver": {"start": "contact"}}
    contact = study.solve(f"{title}, from contact", merged(case, start), must_converge=False)
    return {
        "speed mm/s": f"{1e3 * speed:g}",
        "nodes": str(nodes),
        "dX": f"{film.mesh.dX:.3e}",
        "inlet cells": f"{film.result.resolution.inlet_cells:.2f}",
        **_ending("film", film.result),
        **_ending("contact", contact.result),
    }


def _ending(start, result):
    """What a start led to; numbers of an answer only."""
    found = "not converged"
    if result.converged:
        found = "contact" if result.contact.nodes else "film"
    numbers = {
        "central nm": f"{result.central_film_nm:.4f}",
        "minimum nm": f"{result.minimum_film_nm:.4f}",
        "contact nodes": str(result.contact.nodes),
        "p_f/p_d": f"{result.other_inequality.largest_ratio:.3f}" if result.contact.nodes else "",
    }
    if not result.converged:
        numbers = dict.fromkeys(numbers, "")
    return {f"from {start}": found, **{f"{name} from {start}": text for name, text in numbers.items()}}
