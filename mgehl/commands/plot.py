"""mgehl plot: draw finished runs, or compare several

Draw finished runs: centre lines against Hertz, maps of film, pressure and status, of shear stress and
flash temperatures where there are any, heights of a rough surface, history of the convergence; of several
runs one picture of their centre lines and one of their histories. Pictures of an earlier time are replaced.
A line contact has no maps, a wedge no map of its film, which is a plane, a dry contact one of its gap.

example: python -m mgehl plot runs/try --kind lines,film --format png,svg
"""

from pathlib import Path

from mgehl.commands import several, whole_number
from mgehl.errors import OutputError, UserError

KINDS = (
    "all", "time", "lines", "film", "pressure", "status", "gap", "surface", "history", "shear", "flash_1",
    "flash_2", "compare",
)  # fmt: skip
FORMATS = ("png", "svg", "pdf")
DEFAULT_FORMATS = ("png", "pdf")


def add(parser):
    parser.add_argument("runs", nargs="+", metavar="RUN", help="run directory")
    parser.add_argument(
        "--kind", action="extend", type=several("--kind", KINDS), metavar="K,K,...",
        help=f"pictures: {', '.join(KINDS)} (default: all; of several runs compare); may be repeated",
    )  # fmt: skip
    parser.add_argument("--against", metavar="KEY", help="one picture of films, load on solids, friction "
                     "and pressure of all runs against a key such as motion.speed")  # fmt: skip
    parser.add_argument("--out", metavar="DIR", help="directory of the pictures (default: RUN/plots, of "
                     "comparisons plots); with it each of several runs gets DIR/RUN")  # fmt: skip
    parser.add_argument("--format", action="extend", type=several("--format", FORMATS), metavar="F,F,...",
                     help="png, svg, pdf (default: png,pdf); may be repeated")  # fmt: skip
    parser.add_argument("--style", metavar="FILE", help="matplotlib style file laid over mgehl's own, "
                     "mgehl/output/pictures/mgehl.mplstyle, which says how")  # fmt: skip
    parser.add_argument("--movie", action="store_true", help="of a run in time: movie.mp4, or movie.gif "
                     "where ffmpeg is not there, and no other picture")  # fmt: skip
    parser.add_argument("--dpi", type=whole_number("--dpi", 30, 1200), metavar="N",
                     help="dots to the inch of bitmaps (default: 150)")  # fmt: skip


def execute(options):
    """Read all runs, then draw, then write."""
    if options.against and (options.kind or options.movie):
        raise UserError(f"--against {options.against}: is a picture of its own, without --kind and --movie")
    kinds = list(dict.fromkeys(options.kind or ["all" if len(options.runs) == 1 else "compare"]))
    formats = list(dict.fromkeys(options.format or DEFAULT_FORMATS))
    if "compare" in kinds and len(options.runs) == 1:
        raise UserError("--kind compare: needs more than one run")
    if options.movie:
        return _movies(options)
    from mgehl.output.pictures.figures import style, write

    with style.applied(options.style, options.dpi):
        for pictures, directory in _drawn(options, kinds):
            try:
                print(*write(pictures, directory, formats), sep="\n")
            except OSError as error:
                raise OutputError(f"{directory}: cannot be written: {error}") from None


def _movies(options):
    """Draw the movie of each run."""
    from mgehl.output.files import PLOTS
    from mgehl.output.pictures.movie import write_movie
    from mgehl.output.stored import read_run
    from mgehl.output.whole_file import writing

    for run in options.runs:
        folder = Path(options.out or Path(run) / PLOTS)
        with writing(folder):
            print(write_movie(read_run(run), folder))


def _curves(options):
    """The picture of all runs against a key."""
    from mgehl.config import checked_key
    from mgehl.output.pictures.curves import curves
    from mgehl.output.pictures.figures import Picture
    from mgehl.output.quantities import read_told

    key = checked_key("--against", options.against)
    figure = curves([read_told(run) for run in options.runs], key)
    return Picture(f"against-{key}", f"all runs against {key}", figure)


def _drawn(options, kinds):
    """Lists of pictures, each with its directory."""
    from mgehl.output.files import PLOTS

    if options.against:
        return [([_curves(options)], Path(options.out or PLOTS))]
    from mgehl.output.pictures.figures import compared, figures
    from mgehl.output.pictures.titles import run_names
    from mgehl.output.stored import read_run

    names, solutions = run_names(options.runs), [read_run(run) for run in options.runs]
    several, drawn = len(solutions) > 1, []
    own = None if "all" in kinds else [kind for kind in kinds if kind != "compare"]
    if own is None or own:
        for run, name, solution in zip(options.runs, names, solutions, strict=True):
            out = Path(options.out or Path(run) / PLOTS)
            drawn.append((figures(solution, own), out / name if several and options.out else out))
    if several and (own is None or "compare" in kinds):
        drawn.append((compared(solutions, names), Path(options.out or PLOTS)))
    return drawn
