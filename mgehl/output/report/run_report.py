"""The page of one run: verdict, configuration, answer, checks, pictures, history, versions."""

from mgehl.output.report import loaded as report_loaded
from mgehl.output.report import wedge as report_wedge
from mgehl.output.report.page import BAD, DOUBTFUL, GOOD, Page, Section, Verdict
from mgehl.output.report.parts import (
    configuration_section,
    history_section,
    record_section,
    versions_section,
)
from mgehl.output.report.pictures import pictures
from mgehl.output.result import Result


def report(solution, name):
    """The `Page` of a `Solution` on rank 0; `name` is the run's, such as its directory's."""
    parts = report_loaded if isinstance(solution.result, Result) else report_wedge
    drawn = pictures(solution)
    maps_and_lines = [each for kind, each in drawn.items() if kind != "history"]
    of_history = [each for kind, each in drawn.items() if kind == "history"]
    sections = (
        *parts.answer_sections(solution),
        Section("pictures", "Pictures", tuple(maps_and_lines)),
        history_section(solution.rows, of_history),
        parts.work_section(solution),
        configuration_section(solution.config),
        versions_section(solution.result.versions),
        record_section(solution.result),
    )
    highlights = parts.highlights(solution)
    return Page(parts.title(solution), f"Run {name}", sections, verdict(solution.result), highlights)


def verdict(result):
    """The judgement of a `Result` or `WedgeResult`."""
    if not result.converged:
        if getattr(result, "settled", False):
            return Verdict(DOUBTFUL, "Settled, but Eq. 2 is broken", result.reason)
        return Verdict(BAD, "Not converged", result.reason)
    if isinstance(result, Result) and result.overlap.nodes:
        return Verdict(DOUBTFUL, "Converged, but the bodies overlap", result.reason)
    return Verdict(GOOD, "Converged", result.reason)
