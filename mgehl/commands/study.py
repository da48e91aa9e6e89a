"""mgehl study: solve many cases and make tables and pictures of them

Solve the cases of a study; write its tables and pictures.

example: mgehl study wedge --nodes 65,129
"""

from argparse import ArgumentTypeError
from importlib import import_module
from itertools import pairwise
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED, add_results, add_settings, whole_number
from mgehl.config import load_config
from mgehl.config_file import nested
from mgehl.errors import ConfigError
from mgehl.studies.catalogue import STUDIES

_TAKES = {0: "has grids of its own", 1: "takes one grid"}


def add(parser):
    parser.description += "\n\n" + "\n".join(f"  {name:12}{study.what}" for name, study in STUDIES.items())
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
    parser.add_argument("--force", action="store_true", help="start anew in a directory that exists")
    add_results(parser, "runs/study-NAME")


def _name(text):
    """The name of a study."""
    if text not in STUDIES:
        raise ArgumentTypeError(f"{text}: there is no such study; there are {', '.join(STUDIES)}")
    return text


def execute(options, comm):
    """Solve all cases on all ranks; write tables, pictures and a page."""
    from mgehl.output.study_directory import StudyRecord
    from mgehl.output.surroundings import versions
    from mgehl.saying import complain
    from mgehl.studies.study import begun

    settings, directory = nested(options.settings), Path(options.out or f"runs/study-{options.study}")
    if "nodes" in settings.get("grid", ()):
        raise ConfigError("--set grid.nodes: a study has its grids from --nodes")
    record = StudyRecord(
        options.study, _checked_nodes(options), comm.size, versions(), options.direction or "both",
        tuple(options.settings), options.cases, options.seed,
    )  # fmt: skip
    how = {"speak": not options.quiet, "settings": settings}
    with begun(directory, comm, record, options.resume, options.force, **how) as study:
        import_module(f"mgehl.studies.{options.study}").run(study)
    if options.quiet and study.failures and comm.rank == 0:
        complain(f"{study.failures} cases of the study did not converge")
    return NOT_CONVERGED if study.failures else CONVERGED


def _checked_nodes(options):
    """The grids of --nodes. Raises ConfigError for options that the study does not take."""
    nodes, entry = _nodes(options.nodes), STUDIES[options.study]
    if entry.doubles:
        for coarse, fine in pairwise(nodes):
            if fine != 2 * coarse - 1:
                raise ConfigError(
                    f"--nodes {coarse},{fine}: {2 * coarse - 1} must follow {coarse} in this study"
                )
    if nodes and entry.grids not in (None, len(nodes)):
        raise ConfigError(f"--nodes {options.nodes}: study {options.study} {_TAKES[entry.grids]}")
    if options.direction and options.study != "transition":
        raise ConfigError(f"--direction: study {options.study} does not take it, study transition does")
    for name in ("cases", "seed"):
        given = getattr(options, name)
        if given is not None and not entry.draws:
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
