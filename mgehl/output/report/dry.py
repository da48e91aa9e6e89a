"""Sections that the page of a dry contact has besides those of every run."""

from mgehl.output.report.checks import CHECK_HEADS, CHECKS, absent, limited
from mgehl.output.report.loaded import PEAKS, work_section
from mgehl.output.report.page import Section, number, table
from mgehl.output.report.parts import span

__all__ = ["PICTURES", "alternatives", "answer_sections", "highlights", "work_section"]

PICTURES = {}
"""Titles of pictures that are not those of `pictures.figures`."""


def highlights(solution):
    """The numbers that most readers come for."""
    result = solution.result
    return (
        ("largest pressure", f"{number(result.max_pressure_GPa, 5)} GPa"),
        ("contact / Hertz area", number(result.contact.area_fraction, 5)),
        ("nodes in contact", str(result.contact.nodes)),
        ("approach", f"{number(result.approach_um, 6)} µm"),
    )


def answer_sections(solution):
    """Pressure and approach, checks, contact, scales."""
    return (
        Section("answer", "Pressure and approach", (_answer(solution.result),)),
        Section("checks", "Can it be trusted", (_checks(solution),)),
        Section("contact", "Contact", (_contact(solution.result),)),
        Section("scales", "The contact in numbers", (_scales(solution),)),
    )


def alternatives(result):
    """What a reader who does not see a picture is told besides its title, by kind of picture."""
    largest = f"{number(result.max_pressure_GPa, 5)} GPa"
    return {
        "lines": f"The largest pressure is {largest}.",
        "gap": f"{result.contact.nodes} nodes have none.",
        "pressure": f"Its maximum is {largest}.",
        "status": f"{result.contact.nodes} nodes are in contact.",
        "surface": f"{PEAKS}.",
        "history": f"It took {result.work.steps} sets of pressed nodes.",
    }


def _answer(result):
    hertz = result.hertz
    rows = [
        ("largest pressure, GPa", number(result.max_pressure_GPa, 7), number(hertz.max_pressure_GPa, 7)),
        ("approach of the bodies, µm", number(result.approach_um, 8), number(hertz.approach_um, 8)),
        ("contact area over that of Hertz", number(result.contact.area_fraction, 6), "1"),
    ]
    return table(
        "The dry contact beside that of smooth half-spaces", ("quantity", "computed", "Hertz"), rows
    )


def _checks(solution):
    result, tolerance = solution.result, solution.config.solver.tolerance
    rows = [
        limited("load error", result.load_error, tolerance),
        limited("complementarity: gap in contact, overlap, pull", result.complementarity_error, tolerance),
        absent("nodes where the bodies overlap", result.overlap.nodes),
        absent("nodes in contact at the domain's boundary", result.boundary_nodes),
    ]
    return table(CHECKS, CHECK_HEADS, rows)


def _contact(result):
    contact = result.contact
    rows = [
        ("nodes in contact", str(contact.nodes)),
        ("contact nodes on Y = 0, counted from 1", span(contact.x_nodes)),
        ("contact nodes on X = 0, counted from 1", span(contact.y_nodes)),
        ("largest |gap| in contact, nm", number(contact.largest_gap_nm, 3)),
        ("largest overlap outside of contact, nm", number(result.overlap.largest_nm, 3)),
    ]
    return table("Solid contact", ("quantity", "value"), rows)


def _scales(solution):
    contact, mesh, hertz = solution.contact, solution.mesh, solution.contact.hertz
    rows = [
        ("load", *solution.config.kind.load(contact)),
        ("Hertz semi-axis a, along x", number(1e6 * hertz.a), "µm"),
        ("largest Hertz pressure p_h", number(1e-9 * hertz.p_h), "GPa"),
        ("rms of the roughness within the semi-axes", number(solution.result.Sq_nm), "nm"),
        ("unit of the gap, a²/R_x", number(1e6 * contact.film_scale), "µm"),
        ("spacing of the grid along x", number(1e6 * mesh.dX * hertz.a), "µm"),
    ]
    if not mesh.is_line:
        rows.insert(2, ("Hertz semi-axis b, along y", number(1e6 * hertz.b), "µm"))
    return table("Scales of the contact and of the grid", ("quantity", "value", "unit"), rows)
