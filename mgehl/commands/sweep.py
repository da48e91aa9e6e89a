"""mgehl sweep: solve a contact at many values of a key, each from its neighbour

Solve a contact at many values of one key, or of several, each point from its neighbours; write a run
directory for each, one table (sweep.csv), the same as arrays (sweep.nc), curves and a page. A point
without an answer is said and passed. Values are a list, '50,100,200 N', in SI units where it names none,
or so many in a range, '1e-4..1 m/s:20', which names its unit. These are of equal ratio where both ends are
above 0 and more than a decade apart, and else of equal distance; 'log(1..5 m/s:9)' and
'lin(1..50 m/s:9)' choose. The first key changes fastest.

example: mgehl sweep --set grid.nodes=65 --set solver.start=film --over motion.speed='0.5,1 m/s' --out
    runs/speeds
"""

import re
from contextlib import suppress
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED, add_configuration, add_results, add_settings
from mgehl.config import load_config, not_given, read_tables
from mgehl.config_file import chosen_config, naming_file
from mgehl.errors import ConfigError, OutputError


def add(parser):
    add_configuration(parser)
    parser.add_argument("--over", action="append", required=True, metavar="KEY=VALUES",
                        help="a key with a number and its values; may be repeated")  # fmt: skip
    add_settings(parser)
    parser.add_argument(
        "--both-ways", action="store_true", help="go back along all points, too, from the last"
    )
    add_results(parser, "runs/sweep-NAME")


def execute(options, comm):
    """Solve all points on all ranks."""
    from mgehl.run import Watch
    from mgehl.stopping import StopWhenTold
    from mgehl.studies.points import axis_of, points_of
    from mgehl.studies.sweep import swept

    file = chosen_config(options.config, options.settings)
    over = [_split(word) for word in options.over]
    with naming_file(file, options.settings):
        config = _to_be_swept(file, options.settings, over)
    axes = [axis_of(config, *each) for each in over]
    points = points_of(config, axes, options.both_ways)
    directory = Path(options.out or Path("runs") / f"sweep-{file.stem}")
    if comm.bcast(directory.exists()) and not options.resume:
        raise OutputError(f"{directory} exists: add --resume to go on, or choose another with --out")
    if comm.rank == 0 and not options.quiet:
        _say_what(points, read_tables(file, options.settings), [axis.key for axis in axes])
    asked = (*(f"--over {word}" for word in options.over), *options.settings)
    with StopWhenTold("go on with the same command and --resume") as stop:
        study = swept(directory, comm, axes, points, Watch(stop=stop), not options.quiet, asked)
    return NOT_CONVERGED if study.failures else CONVERGED


def _to_be_swept(file, settings, over):
    """The configuration of a file with the first values of what is swept, which it may need to be one;
    without them where they are no values, which `axis_of` tells."""
    from mgehl.studies.points import first_of

    with suppress(ConfigError):
        return load_config(file, [*settings, *(f"{key}={first_of(values)}" for key, values in over)])
    return load_config(file, settings)


def _say_what(points, tables, swept):
    """Say what the `tables` do not give and nothing goes over, which heights of the first point may be
    errors, and what is unusual in the input, each once, at the first point that has it."""
    from mgehl.commands.run import doubts
    from mgehl.kinds import contact_from
    from mgehl.kinds.plausible import implausible
    from mgehl.saying import complain, mention

    first, found = points[0].config, {}
    for words in doubts(first, contact_from(first)):
        complain(words)
    for key, words in not_given(first, tables).items():
        if key not in swept:
            mention(f"not given: {words}")
    for point in points:
        for words in implausible(point.config, contact_from(point.config)):
            found.setdefault(words.split()[0], f"unusual from point {point.run} on: {words}")
    for words in found.values():
        mention(words)


def _split(word):
    """Key and values of a word of --over."""
    key, equals, values = (part.strip() for part in word.partition("="))
    if not (equals and values):
        raise ConfigError(
            f"--over {word}: must be section.key=VALUES, such as motion.speed='1e-4..1 m/s:20'"
        )
    quoted = re.fullmatch(r"([\"'])(.*)\1", values)
    return key, quoted[2] if quoted else values
