"""Every differential scheme on the point contact at 1 m/s: films against grid, and their limit.

Where viscosity stops the Poiseuille flow central schemes couple every other node only: a saw-tooth along
the motion, which is listed and averaged out.
"""

from mgehl.discretization.couette import SCHEMES
from mgehl.output.pictures.style import COLOURS, MARKS, subplots
from mgehl.studies.columns import told
from mgehl.studies.limits import limit_said
from mgehl.studies.study import PAPER, merged, papers_grid

NODES = (65, 129, 257, 513)
BASE = merged(PAPER, {"motion": {"speed": 1.0}})


def run(study):
    """Solve all; write the table `films` with Richardson's limits and the picture `films`."""
    nodes = study.asked.nodes or NODES
    study.expected = len(SCHEMES) * len(nodes)
    rows, films = [], {}
    for couette in SCHEMES:
        solutions = [each for _, each in study.solved(_cases(couette, nodes))]
        if study.first:
            films[couette] = [_films(solution) for solution in solutions]
            rows += [_row(couette, *each) for each in zip(solutions, films[couette], strict=True)]
            if len(solutions) == len(nodes) >= 3:
                rows.append(_limit_row(couette, films[couette]))
    study.write_table("films", rows)
    study.draw("films", figure, nodes, films)


def _cases(couette, nodes):
    scheme = {"discretization": {"couette": couette}}
    return {f"{couette}, {n} nodes": merged(BASE, scheme, {"grid": papers_grid(n)}) for n in nodes}


def _films(solution):
    """Central film with its saw-tooth averaged out, and minimum film, in nm."""
    return solution.result.central_film_nm - 0.5 * saw_tooth(solution), solution.result.minimum_film_nm


def saw_tooth(solution):
    """Film of the central node above the mean of its neighbours along the motion, in nm."""
    i, j = solution.mesh.centre
    before, centre, after = solution.fields.H[j, i - 1 : i + 2]
    return 1e9 * solution.contact.film_scale * (centre - 0.5 * (before + after))


def _row(couette, solution, films):
    nodes = solution.mesh.nx
    finest = [row["linear_iterations"] for row in solution.rows if row["grid"] == nodes]
    return {
        "couette": couette,
        "nodes": str(nodes),
        **told(solution.result, "converged, central nm"),
        "saw-tooth nm": f"{saw_tooth(solution):.4f}",
        "central averaged nm": f"{films[0]:.4f}",
        "minimum nm": f"{films[1]:.4f}",
        **told(solution.result, "residual"),
        "most GMRES iterations": str(max(finest)),
        **told(solution.result, "convolutions:.0f"),
    }


def _limit_row(couette, films):
    """Richardson's limits from the three finest grids, where their differences show an order."""
    central, minimum = (limit_said(values, "{:.2f} (order {:.1f})") for values in zip(*films, strict=True))
    return {"couette": couette, "nodes": "limit", "central averaged nm": central, "minimum nm": minimum}


def figure(nodes, films):
    """Central and minimum film against the spacing, a line for each scheme."""
    figure, panels = subplots(1, 2, size=(10.5, 4.2))
    for panel, which, title in zip(panels, (0, 1), ("central film", "minimum film"), strict=True):
        for (scheme, values), colour, mark in zip(films.items(), COLOURS, MARKS, strict=False):
            heights = [value[which] for value in values]
            spacing = [1.0 / (n - 1) for n in nodes]
            panel.plot(spacing, heights, mark + "-", color=colour, label=scheme)
        panel.set(xlabel="spacing over length of the domain", ylabel="film, nm", title=title)
        panel.set_xlim(left=0.0)
    panels[1].legend()
    figure.suptitle("Point contact at 1 m/s by every differential scheme")
    return figure
