"""Every differential scheme on the point contact at 1 m/s: films against grid, and their limit."""

from mgehl.discretization.couette import SCHEMES
from mgehl.studies.study import merged, richardson

NODES = (65, 129, 257, 513)
BASE = {"motion": {"speed": 1.0}}


def run(study):
    """Solve all; write the table `films` with Richardson's limits and the picture `films`."""
    nodes = study.nodes or NODES
    study.cases = len(SCHEMES) * len(nodes)
    rows, films = [], {}
    for couette in SCHEMES:
        results = [_solve(study, couette, n) for n in nodes]
        films[couette] = [(result.central_film_nm, result.minimum_film_nm) for result, _ in results]
        rows += _rows(couette, nodes, results, films[couette])
    study.write_table("films", rows)
    from mgehl.studies import film_figures

    study.draw("films", film_figures.schemes, nodes, films)


def _solve(study, couette, nodes):
    tables = merged(BASE, {"grid": {"nodes": nodes}, "discretization": {"couette": couette}})
    solution = study.solve(f"{couette}, {nodes} nodes", tables)
    finest = [row for row in solution.rows if row["grid"] == nodes]
    return solution.result, max(row["linear_iterations"] for row in finest)


def _rows(couette, nodes, results, films):
    """A row for each grid and one for the limit."""
    rows = [
        {
            "couette": couette,
            "nodes": str(n),
            "converged": "yes" if result.converged else "no",
            "central nm": f"{result.central_film_nm:.4f}",
            "minimum nm": f"{result.minimum_film_nm:.4f}",
            "residual": f"{result.residual:.1e}",
            "most GMRES iterations": str(iterations),
            "convolutions": f"{result.work.convolutions:.0f}",
        }
        for n, (result, iterations) in zip(nodes, results, strict=True)
    ]
    if len(nodes) >= 3:
        limits = [richardson(values) for values in zip(*films, strict=True)]
        texts = [f"{limit:.2f} (order {order:.1f})" for limit, order in limits]
        last = dict.fromkeys(rows[0], "") | {"couette": couette, "nodes": "limit"}
        rows.append(last | {"central nm": texts[0], "minimum nm": texts[1]})
    return rows
