"""Sections that the page of a wedge bearing has besides those of every run."""

from mgehl.output.report.checks import CARE, CHECK_HEADS, CHECKS, absent, informing, limited
from mgehl.output.report.page import Section, number, table

PICTURES = {"lines": "pressure on the centre line", "pressure": "pressure, the solid in grey"}
"""Titles of pictures that are not those of `pictures.figures`."""


def highlights(solution):
    """The numbers that most readers come for."""
    result = solution.result
    return (
        ("load", f"{number(result.load_N, 4)} N"),
        ("largest pressure", f"{number(result.max_pressure_MPa, 4)} MPa"),
        ("solid nodes", str(result.solid_nodes)),
        ("cavitated nodes", str(result.cavitated_nodes)),
    )


def answer_sections(solution):
    """Load and pressure, and their checks."""
    return (
        Section("answer", "Load and pressure", (_answer(solution),)),
        Section("checks", "Can it be trusted", (_checks(solution),)),
    )


def alternatives(result):
    """What a reader who does not see a picture is told besides its title, by kind of picture."""
    largest = f"{number(result.max_pressure_MPa, 4)} MPa"
    return {
        "lines": f"The largest pressure is {largest}.",
        "pressure": f"Its maximum is {largest}.",
        "status": f"{result.solid_nodes} nodes are solid, {result.cavitated_nodes} are cavitated.",
        "history": f"The last residual is {number(result.residual, 2)}.",
    }


def _answer(solution):
    result, bearing = solution.result, solution.contact
    rows = [
        ("load, integral of P over the pad", number(result.load), "mm"),
        ("load", number(result.load_N), "N"),
        ("largest P = m²p/(ηu)", number(result.max_P), "1/mm"),
        ("smallest P", number(result.min_P), "1/mm"),
        ("largest pressure", number(result.max_pressure_MPa), "MPa"),
        ("pressure where P is 1/mm", number(1e-6 * bearing.pressure_scale), "MPa"),
        ("solid nodes", str(result.solid_nodes), ""),
        ("cavitated nodes", str(result.cavitated_nodes), ""),
    ]
    return table("Load and pressure, as in Eq. 44 and in SI units", ("quantity", "value", "unit"), rows)


def _checks(solution):
    result = solution.result
    leak = result.closed_face_flow
    rows = [
        limited("residual of the equation, rms", result.residual, solution.config.solver.tolerance),
        absent(
            "largest flow through a face that contact closes", leak, found=number(leak, 2), otherwise=CARE
        ),
        informing("imbalance of the flux", result.flux_imbalance),
        *([informing("part of the oil that nodes make", result.mass.made_share)] if result.mass else []),
    ]
    return table(CHECKS, CHECK_HEADS, rows)


def work_section(solution):
    """What the run took."""
    result = solution.result
    rows = [
        ("iterations of the linear solver", str(result.linear_iterations)),
        ("wall time, s", number(result.wall_s, 4)),
        ("ranks", str(result.ranks)),
    ]
    return Section("work", "Work and time", (table("What the run took", ("quantity", "value"), rows),))
