"""mgehl bench: time fixed cases, part by part

Solve fixed cases and print their convolutions, memory, and seconds in every part of a run. A fixed FFT is
timed beside each case; --compare divides by it, so that the load of the machine matters less.

example: mgehl bench --case wedge-257 --repeat 1 --json now.json
"""

from mgehl.commands import CONVERGED, NOT_CONVERGED, whole_number
from mgehl.errors import UserError


def add(parser):
    parser.add_argument("--case", action="append", metavar="NAME", dest="cases",
                        help="time this case only; may be repeated")  # fmt: skip
    parser.add_argument("--large", action="store_true", help="time cases of 513 and 1025 nodes, too")
    parser.add_argument("--repeat", type=whole_number("--repeat", 1), default=2, metavar="N",
                        help="times each case is solved; the median counts (default: 2)")  # fmt: skip
    parser.add_argument("--json", metavar="FILE", help="write everything as JSON, too")
    parser.add_argument("--compare", metavar="FILE", help="JSON of another commit: print what has changed")


def execute(options, comm):
    """Time the cases on all ranks; print, write, compare."""
    from mgehl.studies.benchmark import measure, ratios, read_benchmark, write_benchmark

    names = _names(options)
    old = read_benchmark(options.compare) if options.compare else None
    if old and old.ranks != comm.size:
        raise UserError(f"--compare {options.compare}: is of {old.ranks} ranks, and these are {comm.size}")
    speaks = comm.rank == 0
    found = measure(names, options.repeat, comm, _tell if speaks else lambda timing: None)
    if speaks:
        _print(_columns(found))
        if old:
            print(f"times those of {options.compare}:")
            _print(ratios(old, found))
        if options.json:
            write_benchmark(options.json, found)
    return CONVERGED if all(timing.converged for timing in found.timings) else NOT_CONVERGED


def _names(options):
    """The cases asked for, each once. Raises UserError."""
    from mgehl.studies.benchmark import CASES, LARGE

    known = CASES | LARGE
    for name in options.cases or ():
        if name not in known:
            raise UserError(f"--case {name}: known are {', '.join(known)}")
    return list(dict.fromkeys(options.cases or (known if options.large else CASES)))


def _tell(timing):
    print(
        f"{timing.case:13} {timing.time.wall:7.2f} s, on the processor {timing.time.cpu:7.2f} s or "
        f"{timing.relative.cpu:5.0f} reference FFTs{'' if timing.converged else ', NOT CONVERGED'}",
        flush=True,
    )


def _columns(benchmark):
    """What is printed of every case; the times of parts are wall times."""
    numbers = {}
    for each in benchmark.timings:
        work = {"convolutions": each.convolutions, "steps": each.steps, "memory MiB": each.memory_MiB}
        numbers[each.case] = work | {"cpu s": each.time.cpu, "wall s": each.time.wall} | each.parts
    return numbers


def _print(columns):
    """Numbers by {column: {row: number}}; rows in the order of their first mention."""
    from mgehl.output.table import drawn
    from mgehl.saying import columns as terminal_columns

    rows = [
        {"": name} | {case: _cell(column.get(name)) for case, column in columns.items()}
        for name in dict.fromkeys(name for column in columns.values() for name in column)
    ]
    print(f"\n{drawn(rows, ['', *columns], terminal_columns())}\n")


def _cell(number):
    if number is None:
        return ""
    return f"{number:.0f}" if number >= 1000.0 else f"{number:.3g}" if number >= 100.0 else f"{number:.2f}"
