"""What a picture is of and what its axes show, in a line each."""

from mgehl.output.mixed_words import mixed_note
from mgehl.output.words import films_words


def title(solution):
    """Speed, load, nodes and verdict; of a wedge what stands in its film."""
    return f"{', '.join(_parts(solution))}: {verdict(solution.result)}"


def title_with_films(solution):
    """As `title`, with a second line for films that have bands and for film and contact of rough bodies."""
    result = solution.result
    films = "" if result.error.central_nm is None else films_words(result)
    return "\n".join(filter(None, (title(solution), films, mixed_note(result.mixed))))


def common_title(solutions):
    """What the titles of several runs have in common, and how many they are."""
    parts = [_parts(solution) for solution in solutions]
    common = [part for part in parts[0] if all(part in other for other in parts)]
    return ", ".join([*common, f"{len(solutions)} runs"])


def verdict(result):
    """Whether a run converged, in a word or two."""
    if result.converged:
        said = "converged"
    else:
        said = f"settled, but {result.doubt}" if result.settled else "NOT converged"
    return said + (", THE BODIES OVERLAP" if result.overlap.nodes else "")


def position_labels(solution):
    """What the axes along x and y show, with its unit."""
    return solution.config.kind.position_labels(solution.contact)


def map_labels(solution):
    """What the axes of a map show, which is drawn in mm."""
    return ("x, mm", "y, mm") if solution.contact.is_loaded else position_labels(solution)


def common_labels(solutions):
    """As `position_labels`, of loaded contacts: without the semi-axes where they differ."""
    found = {position_labels(solution) for solution in solutions}
    return found.pop() if len(found) == 1 else ("X = x/a", "Y = y/b")


def _parts(solution):
    return solution.config.kind.parts(solution)
