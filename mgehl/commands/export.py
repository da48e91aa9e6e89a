"""mgehl export: write a run's fields for other programs

Write the fields of a finished run (pressures, film, status, content, heights) in SI units: vts for
ParaView, nc (NetCDF-4, CF conventions, with the numbers of a sweep) for xarray, npz for NumPy, csv for
anything; pvd is a run in time for ParaView, instant by instant.

example: mgehl export runs/try --to vts,nc
"""

from mgehl.commands import several


def add(parser):
    parser.add_argument("run", metavar="RUN", help="run directory")
    parser.add_argument(
        "--to", required=True, metavar="FORMAT,...", help="vts, nc, npz, csv, pvd or several"
    )
    parser.add_argument("--out", metavar="FILE", help="file, its ending optional (default: RUN/fields)")
    parser.add_argument("--force", action="store_true", help="replace files that exist")


def execute(options):
    """Write the files and name them."""
    from mgehl.output.export.export import OF_FRAMES, WRITERS, export, targets
    from mgehl.output.stored import read_run

    formats = several("--to", WRITERS | OF_FRAMES)(options.to)
    paths = targets(formats, options.run, options.out)
    export(read_run(options.run), paths, options.force)
    for path in paths.values():
        print(path)
