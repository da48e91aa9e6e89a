"""The picture that a run of a loaded contact leaves: centre lines, map of the status."""

from mgehl.output.pictures import lines, maps, style
from mgehl.output.pictures.titles import title_with_films

BLOCKS = 350
"""Blocks of nodes along a side of its small map, about as many as it has dots."""


def draw(path, solution):
    """Write the picture of a `Solution`'s whole-grid fields to `path`."""
    with style.applied():
        panels = 1 if solution.mesh.is_line else 3
        figure, axes = style.subplots(1, panels, size=(1.5 + 3.7 * panels, 4.2), squeeze=False)
        lines.draw_along(axes[0, 0], solution)
        if panels > 1:
            lines.draw_across(axes[0, 1], solution)
            maps.draw_status(axes[0, 2], solution, BLOCKS)
            axes[0, 2].set_title("status of the nodes")
        figure.suptitle(title_with_films(solution))
        style.save(figure, path)
