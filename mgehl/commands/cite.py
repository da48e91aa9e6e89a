"""mgehl cite: the publications whose formulas and data a run used."""

from mgehl.commands import CONVERGED

PARALLEL = False


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "cite",
        help="print the publications that a run rests on",
        description="Print the papers, books and standards whose equations, laws, data and film "
        "formulas a run used, as BibTeX. CITATION.cff is that of this program.",
        epilog="example: mgehl cite runs/try > try.bib",
    )
    parser.add_argument("run", metavar="RUN", help="run directory")
    return parser


def execute(options):
    """Print the entries."""
    from mgehl.kinds.cited import cited
    from mgehl.model.sources import SOURCES
    from mgehl.output.stored import read_run

    solution = read_run(options.run)
    keys = cited(solution.config, solution.contact)
    print(*(SOURCES[key].bibtex(key) for key in keys), sep="\n\n")
    return CONVERGED
