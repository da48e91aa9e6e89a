"""The page of one run: verdict, configuration, answer, checks, pictures, history, versions."""

from mgehl.kinds.own import naming_keys
from mgehl.output.report.doubt import mark_of, marked_numbers, marked_sections
from mgehl.output.report.family import family
from mgehl.output.report.page import BAD, DOUBTFUL, GOOD, Page, Section, Verdict
from mgehl.output.report.parts import (
    configuration_section,
    history_section,
    record_section,
    versions_section,
)
from mgehl.output.report.pictures import pictures


def report(solution, name):
    """The `Page` of a `Solution` on rank 0; `name` is the run's, such as its directory's."""
    parts, mark = family(solution), mark_of(solution.result)
    with naming_keys(solution.contact):  # some numbers ask the user's own laws again
        answer = marked_sections(parts.answer_sections(solution), mark)
    drawn = pictures(solution)
    maps_and_lines = [each for kind, each in drawn.items() if kind != "history"]
    of_history = [each for kind, each in drawn.items() if kind == "history"]
    sections = (
        *answer,
        Section("pictures", "Pictures", tuple(maps_and_lines)),
        history_section(solution.rows, of_history),
        parts.work_section(solution),
        configuration_section(solution.config),
        versions_section(solution.result.versions),
        record_section(solution.result),
    )
    heading, judged = solution.config.kind.heading(solution), verdict(solution.result)
    numbers = marked_numbers(parts.highlights(solution), mark)
    return Page(heading, f"Run {name}", sections, judged, numbers)


def verdict(result):
    """The judgement of a `Result` or `WedgeResult`."""
    if not result.converged:
        if result.settled:
            return Verdict(DOUBTFUL, f"Settled, but {result.doubt}", result.reason)
        return Verdict(BAD, "Not converged", result.reason)
    if result.overlap.nodes:
        return Verdict(DOUBTFUL, "Converged, but the bodies overlap", result.reason)
    return Verdict(GOOD, "Converged", result.reason)
