"""What a picture is of, what its axes show, and what tells runs apart that are shown together."""

from pathlib import Path

from mgehl.config import KEYS
from mgehl.errors import UserError
from mgehl.kinds import KINDS
from mgehl.kinds.loaded import speed_words
from mgehl.kinds.time import of_first_load
from mgehl.output.films_in_words import films_words
from mgehl.output.laws import portable
from mgehl.output.mixed_words import mixed_note

MOST_KEYS = 3
"""Keys that a label may name; runs that differ in more are called by their directories."""
DOMAIN = "grid.x", "grid.y"
"""Keys that follow from others."""
_SHORT = {
    "grid.nodes": lambda nodes: f"{nodes} nodes",
    "motion.speed": speed_words,
    "discretization.face_mobility": lambda mean: f"{mean} mean",
    "discretization.couette": lambda scheme: f"scheme {scheme}",
    "solver.start": lambda start: f"from {start}",
    "solver.method": str,
} | {key: words for kind in KINDS.values() for key, words in kind.short.items()}
"""Keys whose values speak for themselves."""


def title(solution):
    """As `title_of_all`; of a run in time with a second line for the instant that is shown."""
    return "\n".join([title_of_all(solution), *_instant(solution)])


def title_of_all(solution):
    """Speed, load, nodes and verdict; of a wedge what stands in its film."""
    return f"{', '.join(solution.config.kind.parts(solution))}: {verdict(solution.result)}"


def _instant(solution):
    """Line with the time of the fields of a run in time, and what changes of speed, direction and load."""
    if not (last := solution.last):
        return []
    config = solution.config
    there = [f"at {1e3 * last['time_s']:.6g} ms"]
    if isinstance(config.motion.speed, str):
        there.append(speed_words(1e-3 * last["speed_mm_s"]))
    if "angle_deg" in last:
        there.append(f"motion at {last['angle_deg']:.4g}°")
    if of_first_load(config):
        there.append(" ".join(config.kind.load(solution.at_the_end)))
    return [", ".join(there)]


def title_with_films(solution):
    """As `title`, with a line for films that have bands and one for film and contact of rough bodies."""
    result = solution.result
    films = "" if result.error.central_nm is None else films_words(result)
    return "\n".join(filter(None, (title(solution), films, mixed_note(result.mixed))))


def common_title(solutions):
    """What the titles of several runs have in common, and how many they are."""
    parts = [solution.config.kind.parts(solution) for solution in solutions]
    common = [part for part in parts[0] if all(part in other for other in parts)]
    return ", ".join([*common, f"{len(solutions)} runs"])


def verdict(result):
    """Whether a run converged, in a word or two."""
    said = result.verdict if result.settled else "NOT converged"
    return said + (", THE BODIES OVERLAP" if result.overlap.nodes else "")


def gap_words(contact):
    """What is between the bodies: its name, and what an axis shows."""
    return ("gap", "gap, nm") if contact.is_at_rest else ("film", "film thickness, nm")


def position_labels(solution):
    """What the axes along x and y show, with its unit."""
    first = of_first_load(solution.config) if solution.contact.is_loaded else ""
    labels = solution.config.kind.position_labels(solution.contact)
    return tuple(f"{label}{first}" for label in labels)


def map_labels(solution):
    """What the axes of a map show, which is drawn in mm."""
    return ("x, mm", "y, mm") if solution.contact.is_loaded else position_labels(solution)


def common_labels(solutions):
    """As `position_labels`, of loaded contacts: without the semi-axes where they differ."""
    found = {position_labels(solution) for solution in solutions}
    return found.pop() if len(found) == 1 else ("X = x/a", "Y = y/b")


def run_names(directories):
    """The last part of each run directory's path, or as many as tell them apart. Raises UserError where a
    directory is given twice."""
    parts = [Path(directory).resolve().parts for directory in directories]
    for each, directory in zip(parts, directories, strict=True):
        if parts.count(each) > 1:
            raise UserError(f"{directory}: is given twice")
    depth = 1
    while len({each[-depth:] for each in parts}) < len(parts):
        depth += 1
    return ["/".join(each[-depth:]) for each in parts]


def labels(solutions, names):
    """A label for each run: what differs of its configuration, or its name where that says too much. A run
    that did not converge says so."""
    tables = [portable(each.config) for each in solutions]
    keys = differing(tables)
    keys = [key for key in keys if key not in DOMAIN] or keys
    said = [
        ", ".join(key_words(key, each[key]) for key in keys if key in each) for each in map(_flat, tables)
    ]
    if not keys or len(keys) > MOST_KEYS or len(set(said)) < len(said):
        said = names
    return [
        text if each.result.converged else f"{text} ({verdict(each.result)})"
        for text, each in zip(said, solutions, strict=True)
    ]


def differing(tables):
    """The keys, "section.key", that are not the same in all configurations, nested tables."""
    flat = [_flat(each) for each in tables]
    known = dict.fromkeys(key for each in flat for key in each)
    return [key for key in known if any(each.get(key) != flat[0].get(key) for each in flat)]


def _flat(tables):
    return {f"{section}.{key}": value for section, table in tables.items() for key, value in table.items()}


def key_words(name, value):
    """A key and its value, in a few words with the unit; of a course of time its name."""
    if KEYS[name].metadata["kind"] is float and isinstance(value, str):
        return f"{name} {Path(value).name}"
    if name in _SHORT:
        return _SHORT[name](value)
    unit, is_switch = KEYS[name].metadata["unit"] or "", isinstance(value, bool)
    text = f"{value:.6g}" if isinstance(value, float) else str(value).lower() if is_switch else value
    return f"{name} {text} {unit}".rstrip()
