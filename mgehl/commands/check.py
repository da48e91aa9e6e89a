"""mgehl check: tell what a configuration means and what its run will take

Validate a configuration; print its groups, dry contact, film formulas and how well each grid resolves the
inlet, and estimate memory and time. Nothing is solved.

example: mgehl check --set grid.nodes=1025 --set motion.speed='7.5 mm/s' --ranks 2
"""

from itertools import groupby

from mgehl.commands import add_configuration, add_settings, shown, whole_number
from mgehl.config import config_from_tables, not_given, read_tables
from mgehl.config_file import chosen_config, naming_file
from mgehl.kinds.choice import given
from mgehl.kinds.cited import cited
from mgehl.kinds.lubricant import oil_words
from mgehl.kinds.plausible import implausible
from mgehl.kinds.time import begins_at_rest
from mgehl.model.sources import SOURCES
from mgehl.saying import columns, folded

GiB = 2**30

NAME = 11
"""Columns of what a line is about."""


def add(parser):
    add_configuration(parser)
    add_settings(parser)
    parser.add_argument("--ranks", type=whole_number("--ranks", 1), default=1, metavar="N",
                        help="ranks of the run (default: 1)")  # fmt: skip


def execute(options):
    """Print everything; raises UserError where the run would not begin."""
    file = chosen_config(options.config, options.settings)
    from mgehl.kinds import checked_case

    with naming_file(file, options.settings):
        tables = read_tables(file, options.settings)
        case = checked_case(config_from_tables(tables))
    config, contact, mesh = case.config, case.contact, case.mesh
    print(f"{options.config or shown(file)}: valid, a {config.kind.noun}\n")
    lines = [*_given(config, not_given(config, tables).values()), *_idle(config, tables)]
    lines += *_under("unusual", implausible(config, contact)), "", *_described(case)
    lines += *_estimate(config, contact, mesh, options.ranks), *_recipe(case), ""
    names = ", ".join(SOURCES[key].short for key in cited(config, contact))
    lines += (*_under("sources", [f"{names}; mgehl cite RUN has them in full"]),)
    width = columns()
    print(*(folded(line, " " * NAME, width) for line in lines), sep="\n")


def _given(config, missing):
    """Lines with all that makes the contact, by sections; what follows from what; and what is `missing`."""
    for section, keys in groupby(config.physical, lambda key: key.partition(".")[0]):
        words = (f"{key.partition('.')[2]} {config.said(key)}" for key in keys)
        yield f"{section:{NAME}}{'' if len(section) < NAME else ' '}{'   '.join(words)}"
    yield from _under(
        "follows", (f"{each.key} = {config.said(each.key)}: {each.how}" for each in config.derived)
    )
    yield from (f"{'oil':{NAME}}{words}" for words in oil_words(config))
    yield from _under("not given", missing)


def _idle(config, tables):
    """A line with the keys of `tables` that do nothing for this contact."""
    if idle := given(tables, sorted(config.unused)):
        yield f"{'not used':{NAME}}{', '.join(idle)}: nothing to a {config.kind.noun}"


def _under(head, lines):
    """Lines under a word, which the first of them has at its side."""
    for number, line in enumerate(lines):
        yield f"{'' if number else head:{NAME}}{line}"


def _described(case):
    """Lines about the contact and, of a loaded one, about its inlet."""
    config, contact, mesh = case.config, case.contact, case.mesh
    yield from config.kind.lines(config, contact, mesh)
    if contact.is_loaded:
        yield from () if config.is_dry else ("", *_inlet(case))
        yield from _surface(config, contact, mesh)


def _inlet(case):
    """Lines about the inlet on every grid."""
    from mgehl.kinds.loaded import speed_words
    from mgehl.output import resolution
    from mgehl.output.forecast import LARGEST_NODES, inlet_grids
    from mgehl.solver.from_config import scheme_from

    config, contact, mesh = case.config, case.contact, case.mesh
    scene = case.scene if config.is_in_time else None
    found = resolution.resolution(contact, mesh, scene)
    if found.verdict == resolution.STANDS:
        yield "inlet      none: the surfaces stand still throughout"
        yield f"domain     {resolution.room_words(mesh)}"
        return
    if words := resolution.inlet_speed_words(found):
        yield f"inlet      {words}{resolution.near_rest(found)}"
    grids = inlet_grids(case)
    for grid in grids:
        at = "" if grid.speed is None else f"   solved at {speed_words(grid.speed)}"
        yield f"grid {grid.nodes:5d}   {grid.cells:8.2f} cells in the inlet{at}"
    yield ""
    solver, shuts = config.solver, scheme_from(config, contact).contact_law.closes_faces
    expected = resolution.expectation(grids[-1].cells, solver.from_film, contact.is_mixed, shuts)
    yield f"expected   from a {solver.start} start, {expected}"
    on_domain = resolution.domain_words(found)
    peaks = resolution.peaks_words(contact, mesh)
    yield from _under("domain", [resolution.room_words(mesh), on_domain, *peaks])
    beyond = resolution.beyond_words(found.load_beyond_percent, at_most=scene is not None)
    yield from (f"load       {words}" for words in beyond)
    needed = resolution.resolving_nodes(contact, mesh, scene)
    verdict = "this grid does" if needed <= config.grid.nodes else f"recommended: grid.nodes={needed}"
    if needed > LARGEST_NODES:
        verdict = f"no grid up to {LARGEST_NODES} does; a higher speed or a smaller domain helps"
    enough = f"with {resolution.RESOLVED_CELLS:.0f} cells in the inlet"
    yield f"resolved   {enough}, from {needed} nodes on: {verdict}"


def _recipe(case):
    """Lines with all that is chosen for the solve of a loaded contact with a fluid."""
    if not case.contact.is_loaded or case.config.is_dry:
        return
    from mgehl.solver.from_config import set_up
    from mgehl.solver.recipe_words import recipe_words

    yield ""
    words = recipe_words(set_up(case).recipe(), case.contact.is_line, begins_at_rest(case.config))
    yield from _under("recipe", words)


def _surface(config, contact, mesh):
    """Lines about what is on the bodies."""
    from mgehl.output.surface import surface_lines

    lines = list(surface_lines(config, contact, mesh))
    yield from ("", *lines) if lines else ()


def _estimate(config, contact, mesh, ranks):
    """Lines about memory and time, and what these estimates are made from."""
    from mgehl.output.forecast import forecast
    from mgehl.output.surroundings import memory_GiB

    found, have = forecast(config, contact, mesh, ranks), memory_GiB()
    on, most = "1 rank" if ranks == 1 else f"{ranks} ranks", found.most_memory / GiB
    enough = f"this machine has {have:.1f}" if most <= have else f"MORE THAN THIS MACHINE'S {have:.1f}"
    more = f", up to {most:.1f} where the linear systems are hard" if most > found.memory / GiB else ""
    yield ""
    yield f"memory     about {found.memory / GiB:.1f} GiB on {on}{more} ({enough})"
    yield f"time       about {_duration(found.seconds)} on {on}, half or twice as much is usual:"
    if found.convolutions:
        yield f"           about {float(f'{found.convolutions:.2g}'):g} convolutions: {found.measured};"
    else:
        yield f"           {found.measured};"
    cores = "1 core" if found.workers == 1 else f"{found.workers} cores"
    one = "one" if found.convolutions else "a convolution"
    yield (
        f"           {one} takes {1e3 * found.convolution_seconds:.3g} ms, by n log n from "
        f"{found.timed_nodes} nodes timed just now; {cores} at work"
    )
    if found.convolutions:
        yield "           a run that does not settle may take longer, up to solver.max_steps steps a grid"


def _duration(seconds):
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400.0 else f"{seconds / 3600:.1f} h"
