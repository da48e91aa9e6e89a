"""The pictures of a run's page, with words for readers who do not see them."""

from mgehl.output.pictures import style
from mgehl.output.pictures.figures import drawn_by, figures
from mgehl.output.report.doubt import mark_of
from mgehl.output.report.family import family
from mgehl.output.report.page import picture


def pictures(solution):
    """Every picture of the run as SVG, by kind."""
    kinds = [kind for kind in drawn_by(solution) if solution.rows or kind != "history"]
    drawn = figures(solution, kinds)
    with style.applied():
        return {each.name: _picture(each, solution) for each in drawn}


def _picture(drawn, solution):
    own = family(solution)
    title = own.PICTURES.get(drawn.name, drawn.title)
    caption = title[0].upper() + title[1:]
    mark = mark_of(solution.result)
    numbers = own.alternatives(solution.result)[drawn.name]
    said = [f"{caption}.", f"{mark.capitalize()}:" if mark else "", numbers]
    content = style.rendered(drawn.figure, "svg")
    size = drawn.figure.get_size_inches()
    return picture(f"{caption}.", " ".join(filter(None, said)), content, "image/svg+xml", size)
