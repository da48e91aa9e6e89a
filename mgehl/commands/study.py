"""mgehl study: solve the cases of a study."""

from argparse import ArgumentTypeError, RawDescriptionHelpFormatter
from importlib import import_module
from itertools import pairwise
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED
from mgehl.config import load_config, read_setting
from mgehl.errors import ConfigError
from mgehl.studies.catalogue import REMOVED, STUDIES

PARALLEL = True

LARGEST_NUMBER = 2**31
"""Of --cases and --seed."""

_TAKES = {0: "has grids of its own", 1: "takes one grid"}


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "study",
        help="solve many cases and make tables and pictures of them",
        allow_abbrev=False,
        formatter_class=RawDescriptionHelpFormatter,
        description="Solve the cases of a study; write its tables and pictures.\n\n"
        + "\n".join(f"  {name:12}{study.what}" for name, study in STUDIES.items()),
        epilog="example: mpiexec -n 2 python -m mgehl study schemes --nodes 65,129",
    )
    parser.add_argument("study", type=_name, choices=tuple(STUDIES), metavar="NAME", help="of those above")
    parser.add_argument("--nodes", "--grid", metavar="N,N,...", help="grids instead of the study's own")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                        help="a key of all cases, as of mgehl run; may be repeated")  # fmt: skip
    parser.add_argument("--direction", choices=("down", "up", "both"),
                        help="branches of study transition (default: both)")  # fmt: skip
    parser.add_argument("--cases", metavar="N", help="how many cases chance draws")
    parser.add_argument("--seed", metavar="N", help="by which they are drawn")
    parser.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/study-NAME)")
    parser.add_argument("--force", action="store_true", help="start anew in a directory that exists")
    parser.add_argument("--resume", action="store_true", help="go on with the points that are finished")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return parser


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
    """Solve all cases on all ranks; write tables, pictures and a page."""
    from mgehl.output.study_directory import StudyRecord
    from mgehl.output.surroundings import versions
    from mgehl.saying import complain
    from mgehl.studies.study import begun

    settings, directory = _settings(options.settings), Path(options.out or f"runs/study-{options.study}")
    record = StudyRecord(
        options.study, _checked_nodes(options), comm.size, versions(), options.direction or "both",
        tuple(options.settings), _number(options, "cases", 1), _number(options, "seed", 0),
    )  # fmt: skip
    how = not options.quiet, options.resume, options.force
    with begun(directory, comm, record, *how, settings=settings) as study:
        import_module(f"mgehl.studies.{options.study}").run(study)
    if options.quiet and study.failures and comm.rank == 0:
        complain(f"{study.failures} cases of the study did not converge")
    return NOT_CONVERGED if study.failures else CONVERGED


def _settings(words):
    """Nested tables of the words of --set."""
    tables = {}
    for name, value in map(read_setting, words):
        section, _, key = name.partition(".")
        if name == "grid.nodes":
            raise ConfigError("--set grid.nodes: a study has its grids from --nodes")
        tables.setdefault(section, {})[key] = value
    return tables


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
    if options.force and options.resume:
        raise ConfigError("--force and --resume: one starts anew, the other goes on; give one of them")
    return nodes


def _number(options, name, low):
    """The whole number of an option of studies by chance, `low` or more; None for the study's own."""
    text = getattr(options, name)
    if text is None:
        return None
    if not STUDIES[options.study].draws:
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
