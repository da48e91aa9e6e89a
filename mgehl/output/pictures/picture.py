"""The picture that a run of a loaded contact leaves: centre lines, map of the film."""

from mgehl.output.pictures import lines, maps, style
from mgehl.output.pictures.titles import title_with_films

BLOCKS = 350
"""Blocks of nodes along a side of its small map, about as many as it has dots."""


def drawn(solution):
    """The picture of a `Solution`'s whole-grid fields, as the bytes of a PNG file."""
    with style.applied():
        panels = 1 if solution.mesh.is_line else 3
        figure, axes = style.subplots(1, panels, size=(1.5 + 4.1 * panels, 4.4), squeeze=False)
        lines.draw_along(axes[0, 0], solution)
        if panels > 1:
            lines.draw_across(axes[0, 1], solution)
            what = lines.film_words(solution.contact)[0]
            handles = maps.draw_film(axes[0, 2], solution, what, BLOCKS)
            axes[0, 2].set_title(what)
            style.legend_below(axes[0, 2], handles, columns=2)
        figure.suptitle(title_with_films(solution))
        return style.rendered(figure, "png")
