"""mgehl study: solve many cases and make tables and pictures of them

Solve the cases of a study; write its tables and pictures.

example: mpiexec -n 2 python -m mgehl study schemes --nodes 65,129
"""

from argparse import ArgumentTypeError
from importlib import import_module
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED, add_settings, whole_number
from mgehl.config import load_config
from mgehl.config_file import nested
from mgehl.errors import ConfigError

STUDIES = {
    "wedge": "the rigid wedge bearing: Figures 7 to 10, exact series, a pocket",
    "grid": "full contact and full film on ever finer grids: Figures 11 to 13",
    "transition": "from full film to full contact and back: Figure 14, Table 1",
    "methods": "Newton beside relaxation, interface conditions beside none",
    "schemes": "a film by every differential scheme",
    "error": "do the bands about films hold? Point contacts by chance",
    "gaps": "do the bands about mean gaps hold? Rough balls by chance",
    "mixed": "rough balls by chance: verdicts and work",
    "machine": "rough contacts of machines by chance: verdicts and gaps",
    "rollers": "rough line contacts by chance: verdicts and gaps",
    "rough": "a rough ball from full film to nearly dry",
    "stribeck": "friction of a rough ball over speed, three oils",
    "waviness": "waves in the film of a line contact, beside published numbers",
    "moving": "waves and a dimple that pass through full films",
    "dry": "dry contacts beside a public code's numbers",
}

REMOVED = ("line", "inlet", "onset", "bracket", "accuracy", "angle", "domain", "soft", "peaks", "ranks")
"""What they found is in runs/README.md."""

DOUBLING = ("wedge", "schemes", "error", "gaps")
"""Studies that need grids each of half the spacing of the one before: they tell orders and limits."""

GRIDS = dict.fromkeys(("rough", "stribeck", "mixed", "machine", "rollers", "moving"), 1) | {
    "gaps": 2,
    "methods": 0,
    "waviness": 0,
}
"""How many grids --nodes must name, where that is limited; 0 where a study has its own."""

DRAW = ("error", "gaps", "mixed", "machine", "rollers")
"""Studies whose cases chance draws."""

_TAKES = {0: "has grids of its own", 1: "takes one grid", 2: "takes two grids"}


def add(parser):
    parser.description += "\n\n" + "\n".join(f"  {name:12}{text}" for name, text in STUDIES.items())
    parser.add_argument("study", type=_name, choices=tuple(STUDIES), metavar="NAME", help="of those above")
    parser.add_argument("--nodes", "--grid", metavar="N,N,...", help="grids instead of the study's own")
    add_settings(parser, "a key of all cases, as of mgehl run; may be repeated")
    parser.add_argument("--direction", choices=("down", "up", "both"),
                        help="branches of study transition (default: both)")  # fmt: skip
    parser.add_argument(
        "--cases", type=whole_number("--cases", 1, 2**31), metavar="N", help="how many cases chance draws"
    )
    parser.add_argument(
        "--seed", type=whole_number("--seed", 0, 2**31), metavar="N", help="by which they are drawn"
    )
    parser.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/study-NAME)")
    parser.add_argument("--force", action="store_true", help="start anew in a directory that exists")
    parser.add_argument("--resume", action="store_true", help="go on with the points that are finished")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def _name(text):
    """The name of a study."""
    if text in REMOVED:
        raise ArgumentTypeError(
            f"study {text} is no longer part of mgehl; runs/README.md has what it found"
        )
    if text not in STUDIES:
        raise ArgumentTypeError(f"{text}: there is no such study; there are {', '.join(STUDIES)}")
    return text


def execute(options, comm):
    """Solve all cases on all ranks; write tables and pictures."""
    from mgehl.output.directory import make_directory
    from mgehl.output.files import on_first_rank
    from mgehl.output.lock import locked
    from mgehl.output.report.study_record import StudyRecord
    from mgehl.output.surroundings import versions
    from mgehl.saying import complain

    settings = nested(options.settings)
    if "nodes" in settings.get("grid", ()):
        raise ConfigError("--set grid.nodes: a study has its grids from --nodes")
    record = StudyRecord(
        options.study, _checked_nodes(options), comm.size, versions(), options.direction or "both",
        tuple(options.settings), options.cases, options.seed,
    )  # fmt: skip
    directory = Path(options.out or Path("runs") / f"study-{options.study}")
    on_first_rank(comm, make_directory, directory, options.force or options.resume)
    with locked(comm, directory):
        study = _solve(options, comm, directory, record, settings)
    if options.quiet and study.failures and comm.rank == 0:
        complain(f"{study.failures} cases of the study did not converge")
    return NOT_CONVERGED if study.failures else CONVERGED


def _solve(options, comm, directory, record, settings):
    """Solve all cases in the directory, which is locked; return the `Study`."""
    from mgehl.output.files import on_first_rank
    from mgehl.output.study_directory import begin_study, finish_study
    from mgehl.saying import say
    from mgehl.studies.study import Study

    stage = comm.bcast(on_first_rank(comm, begin_study, directory, record, options.resume))
    asked = {"branch": record.branch, "wanted": record.cases, "seed": record.seed, "settings": settings}
    asked["resume"] = options.resume
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
    nodes, most = _nodes(options.nodes), GRIDS.get(options.study)
    if options.study in DOUBLING:
        for coarse, fine in zip(nodes[:-1], nodes[1:], strict=True):
            if fine != 2 * coarse - 1:
                raise ConfigError(
                    f"--nodes {coarse},{fine}: {2 * coarse - 1} must follow {coarse} in this study"
                )
    if nodes and most is not None and len(nodes) != most:
        raise ConfigError(f"--nodes {options.nodes}: study {options.study} {_TAKES[most]}")
    if options.direction and options.study != "transition":
        raise ConfigError(f"--direction: study {options.study} does not take it, study transition does")
    for name in ("cases", "seed"):
        given = getattr(options, name)
        if given is not None and options.study not in DRAW:
            raise ConfigError(f"--{name} {given}: means nothing to study {options.study}")
    if options.force and options.resume:
        raise ConfigError("--force and --resume: one starts anew, the other goes on; give one of them")
    return nodes


def _nodes(text):
    """The grids of --nodes, coarsest first, by the rules of grid.nodes."""
    if text is None:
        return ()
    return tuple(
        sorted({load_config(settings=[f"grid.nodes={each}"]).grid.nodes for each in text.split(",")})
    )
