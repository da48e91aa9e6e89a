"""mgehl cite: print the publications that a run rests on

Print the papers, books and standards whose equations, laws, data and film formulas a run used, as BibTeX.
CITATION.cff is that of this program.

example: mgehl cite runs/try
"""


def add(parser):
    parser.add_argument("run", metavar="RUN", help="run directory")


def execute(options):
    """Print the entries."""
    from mgehl.kinds.cited import cited
    from mgehl.model.sources import SOURCES
    from mgehl.output.stored import read_run

    solution = read_run(options.run)
    keys = cited(solution.config, solution.contact)
    print(*(SOURCES[key].bibtex(key) for key in keys), sep="\n\n")
