"""The pictures of a run's page, with words for readers who do not see them."""

from mgehl.output.pictures import style
from mgehl.output.pictures.figures import drawn_by, figures
from mgehl.output.report.page import number, picture
from mgehl.output.wedge_result import WedgeResult


def pictures(solution):
    """Every picture of the run as SVG, by kind."""
    kinds = [kind for kind in drawn_by(solution) if solution.rows or kind != "history"]
    drawn = figures(solution, kinds)
    with style.applied():
        return {each.name: _picture(each, solution) for each in drawn}


def _picture(drawn, solution):
    title = _OF_A_WEDGE.get(drawn.name, drawn.title) if _is_wedge(solution.result) else drawn.title
    caption = title[0].upper() + title[1:]
    alt = f"{caption}. {ALTERNATIVES[drawn.name](solution.result)}"
    content = style.rendered(drawn.figure, "svg")
    return picture(f"{caption}.", alt, content, "image/svg+xml", wide=drawn.name in ("lines", "history"))


_OF_A_WEDGE = {"lines": "pressure on the centre line", "pressure": "pressure, the solid in grey"}

ALTERNATIVES = {
    "lines": lambda result: f"The largest pressure is {_largest(result)}.",
    "film": lambda result: (
        f"The film is {number(result.central_film_nm, 4)} nm in the centre and "
        f"{number(result.minimum_film_nm, 4)} nm at its thinnest."
    ),
    "pressure": lambda result: f"Its maximum is {_largest(result)}.",
    "status": lambda result: f"{_solid(result)} nodes are solid, {result.cavitated_nodes} are cavitated.",
    "history": lambda result: f"The last residual is {number(result.residual, 2)}.",
}
"""What a reader who does not see a picture is told besides its title, by kind of picture."""


def _largest(result):
    if _is_wedge(result):
        return f"{number(result.max_pressure_MPa, 4)} MPa"
    return f"{number(result.max_pressure_GPa, 4)} GPa"


def _solid(result):
    return result.solid_nodes if _is_wedge(result) else result.contact.nodes


def _is_wedge(result):
    return isinstance(result, WedgeResult)
