"""The picture that a run leaves: centre lines and map of the film; of a wedge those of the pressure."""

import numpy as np
from matplotlib.figure import Figure

from mgehl.output.pictures import lines, maps, style, wedge_picture
from mgehl.output.pictures.titles import gap_words, title_with_films


def drawn(solution):
    """The picture of a `Solution`'s whole-grid fields, as the bytes of a PNG file."""
    with style.applied():
        figure = _loaded(solution) if solution.contact.is_loaded else wedge_picture.picture(solution)
        return style.rendered(figure, "png")


def _loaded(solution):
    panels = 1 if solution.mesh.is_line else 3
    figure = Figure(figsize=(1.5 + 4.1 * panels, 5.2), layout="constrained")
    above, below = ["p along", "p across"], ["h along", "h across"]
    axes = figure.subplot_mosaic([[*above, "map"][:panels], [*below, "map"][:panels]])
    rows = np.array([[axes[name] for name in row if name in axes] for row in (above, below)])
    handles = lines.draw_lines(rows, solution)
    if "map" in axes:
        handles += maps.draw_film(axes["map"], solution, style.SMALL)
        axes["map"].set_title(gap_words(solution.contact)[0])
    style.legend_under_all(figure, handles)
    figure.suptitle(title_with_films(solution))
    return figure
