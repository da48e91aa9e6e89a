"""mgehl study: solve the cases of a study."""

from importlib import import_module
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED
from mgehl.config import load_config
from mgehl.discretization.fluid import FACE_MOBILITIES
from mgehl.errors import ConfigError

PARALLEL = True

STUDIES = {
    "wedge": "the rigid wedge bearing, Figures 7 to 10, convergence to the exact series",
    "line": "line-contact films against the formulas",
    "inlet": "the line contact from under-resolved to resolved inlets, from both starts",
    "methods": "Newton with multigrid beside the paper's relaxation, interface conditions beside none",
    "transition": "from full film to full contact and back, Figure 14 and Table 1",
    "grid": "full contact and full film on ever finer grids, Figures 11 to 13",
    "onset": "the speeds at which contact appears and full contact is lost, against the grid",
    "bracket": "films by three means of the mobility, grid by grid",
    "schemes": "films of the point contact by every differential scheme",
    "error": "bands about films beside the limit, over contacts of every sort and three schemes",
    "accuracy": "errors of full films at 2, 4 and 8 cells in the inlet, by every scheme of a full film",
    "angle": "films of surfaces that move at an angle to the axes of the contact",
    "domain": "what a domain of twice the size changes in the film, and what was estimated of it",
    "soft": "soft bodies in thin oil: which films are found, beside Moes' formulas",
    "rough": "a rough ball from full film to nearly dry: load share, contact area, patches against lambda",
    "waviness": "waves that stand still in full films: a line contact beside published numbers, a ball",
    "peaks": "rough balls on three grids by two schemes: how much of film and contact is the grid's",
    "mixed": "rough balls drawn at random, from full film to boundary lubrication: verdicts and work",
    "machine": "rough contacts of machines drawn at random, with all else left to mgehl: verdicts and gaps",
    "rollers": "rough line contacts drawn at random: verdicts and gaps",
    "gaps": "bands about the mean gaps of rough balls drawn at random, beside a grid twice as fine",
    "dry": "dry contacts of smooth, wavy and rough balls beside a public code's numbers",
    "ranks": "messages, bytes, flops and time of an iteration on this run's ranks, and on many more",
}

DOUBLING = ("wedge", "schemes", "angle", "error", "peaks", "gaps")
"""Studies that need grids each of half the spacing of the one before: they tell orders and limits."""

GRIDS = {
    "line": (0, 1),
    "rough": (0, 1),
    "mixed": (0, 1),
    "machine": (0, 1),
    "rollers": (0, 1),
    "gaps": (0, 2),
} | dict.fromkeys(("methods", "accuracy", "domain", "soft"), (0,))
"""How many grids --nodes may name, where that is limited; 0 for the study's own."""

DRAW = ("mixed", "machine", "rollers", "error", "gaps")
"""Studies that draw cases at random, one of them where it is asked to."""

LARGEST_NUMBER = 2**31
"""Of --cases and --seed."""

DEFAULTS = {"direction": "both", "mean": "arithmetic"}
"""Defaults of options that only study transition takes."""

_TAKES = {0: "has grids of its own", 1: "takes one grid", 2: "takes two grids"}


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "study",
        help="solve many cases and make tables and pictures of them",
        allow_abbrev=False,
        description="Solve the cases of a study; write its tables (CSV, Markdown) and pictures. "
        + "; ".join(f"{name}: {text}" for name, text in STUDIES.items()),
        epilog="example: python -m mgehl study inlet --nodes 129",
    )
    parser.add_argument("study", choices=tuple(STUDIES), metavar="NAME", help=", ".join(STUDIES))
    parser.add_argument("--nodes", "--grid", metavar="N,N,...", help="grids instead of the study's own")
    parser.add_argument("--direction", choices=("down", "up", "both"),
                       help="branches that study transition follows (default: both)")  # fmt: skip
    parser.add_argument("--mean", choices=FACE_MOBILITIES, metavar="MEAN",
                       help="mean of the mobility that study transition follows: "
                       f"{', '.join(FACE_MOBILITIES)} (default: arithmetic)")  # fmt: skip
    parser.add_argument("--boundary-film", metavar="LENGTH",
                       help="film of adsorbed layers in study rough (default: 2 nm)")  # fmt: skip
    parser.add_argument("--cases", metavar="N", help=f"random cases that a study ({', '.join(DRAW)}) "
                       "solves instead of its own")  # fmt: skip
    parser.add_argument("--seed", metavar="N", help="by which they are drawn (default: the study's own)")
    parser.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/study-NAME)")
    parser.add_argument("--force", action="store_true", help="start anew in a directory that exists")
    parser.add_argument(
        "--resume", action="store_true", help="go on with the points that are finished there"
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return parser


def execute(options, comm):
    """Solve all cases on all ranks; write tables and pictures."""
    from mgehl.output.directory import make_directory
    from mgehl.output.files import on_first_rank
    from mgehl.output.lock import locked
    from mgehl.output.report.study_record import StudyRecord
    from mgehl.output.surroundings import versions
    from mgehl.saying import complain

    nodes = _checked_nodes(options)
    directory = Path(options.out or Path("runs") / f"study-{options.study}")
    mean, direction = options.mean or DEFAULTS["mean"], options.direction or DEFAULTS["direction"]
    asked = options.study, nodes, direction, mean
    drawn = _number(options, "cases", 1), _number(options, "seed", 0)
    record = StudyRecord(*asked, comm.size, versions(), _boundary_film(options), *drawn)
    on_first_rank(comm, make_directory, directory, options.force or options.resume)
    with locked(comm, directory):
        study = _solve(options, comm, directory, record)
    if options.quiet and study.failures and comm.rank == 0:
        complain(f"{study.failures} cases of the study did not converge")
    return NOT_CONVERGED if study.failures else CONVERGED


def _solve(options, comm, directory, record):
    """Solve all cases in the directory, which is locked; return the `Study`."""
    from mgehl.output.files import on_first_rank
    from mgehl.output.study_directory import begin_study, finish_study
    from mgehl.saying import say
    from mgehl.studies.study import Study

    stage = comm.bcast(on_first_rank(comm, begin_study, directory, record, options.resume))
    asked = {"branch": record.branch, "mean": record.mean, "boundary_film": record.boundary_film}
    asked |= {"wanted": record.cases, "seed": record.seed}
    study = Study(stage, comm, record.nodes, not options.quiet, home=directory, **asked)
    if not options.resume:
        on_first_rank(comm, study.cache.clear)
    import_module(f"mgehl.studies.{options.study}").run(study)
    on_first_rank(comm, finish_study, directory, stage, options.resume)
    if study.first and study.speak:
        say(f"results in {directory}")
    return study


def _checked_nodes(options):
    """The grids of --nodes. Raises ConfigError for options that the study does not take."""
    nodes = _nodes(options.nodes)
    if options.study in DOUBLING:
        _check_doubling(nodes)
    allowed = GRIDS.get(options.study, (len(nodes),))
    if len(nodes) not in allowed:
        raise ConfigError(f"--nodes {options.nodes}: study {options.study} {_TAKES[max(allowed)]}")
    for name in DEFAULTS:
        if getattr(options, name) is not None and options.study != "transition":
            raise ConfigError(f"--{name}: study {options.study} does not take it, study transition does")
    if options.force and options.resume:
        raise ConfigError("--force and --resume: one starts anew, the other goes on; give one of them")
    return nodes


def _check_doubling(nodes):
    for coarse, fine in zip(nodes[:-1], nodes[1:], strict=True):
        if fine != 2 * coarse - 1:
            raise ConfigError(
                f"--nodes {coarse},{fine}: {2 * coarse - 1} must follow {coarse} in this study"
            )


def _boundary_film(options):
    """The film of --boundary-film in m, by the rules of contact.boundary_film; None for the study's own."""
    text = options.boundary_film
    if text is None:
        return None
    if options.study != "rough":
        raise ConfigError(f"--boundary-film {text}: means nothing to study {options.study}")
    return load_config(settings=[f"contact.boundary_film={text}"]).contact.boundary_film


def _number(options, name, low):
    """The whole number of an option of studies that `DRAW`, `low` or more; None for the study's own."""
    text = getattr(options, name)
    if text is None:
        return None
    if options.study not in DRAW:
        raise ConfigError(f"--{name} {text}: means nothing to study {options.study}")
    if not (text.isascii() and text.isdecimal() and low <= int(text) <= LARGEST_NUMBER):
        raise ConfigError(f"--{name} {text}: must be a whole number from {low} to {LARGEST_NUMBER}")
    return int(text)


def _nodes(text):
    """The grids of --nodes, coarsest first, by the rules of grid.nodes."""
    if text is None:
        return ()
    return tuple(
        sorted({load_config(settings=[f"grid.nodes={each}"]).grid.nodes for each in text.split(",")})
    )
