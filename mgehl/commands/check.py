"""mgehl check: what a configuration means and what its run will take, without solving anything."""

from dataclasses import asdict

from mgehl.commands import CONVERGED
from mgehl.config import default_config, load_config
from mgehl.errors import UserError

PARALLEL = False

NAMES = {"point": "point contact", "line": "line contact", "wedge": "wedge bearing"}

GiB = 2**30


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "check",
        help="tell what a configuration means and what its run will take",
        allow_abbrev=False,
        description="Validate a configuration; print its groups, dry contact, film formulas and how well "
        "each grid resolves the inlet, and estimate memory and time. Nothing is solved.",
        epilog="example: mgehl check --set grid.nodes=1025 --set motion.speed='7.5 mm/s' --ranks 2",
    )
    parser.add_argument(
        "config", nargs="?", metavar="CONFIG", help="TOML file (default: the point contact)"
    )
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                     help="set a key, such as grid.nodes=513; may be repeated")  # fmt: skip
    parser.add_argument("--ranks", type=int, default=1, metavar="N", help="ranks of the run (default: 1)")
    return parser


def execute(options):
    """Print everything; raises UserError where the run would not begin."""
    config = load_config(options.config, options.settings)
    if options.ranks < 1:
        raise UserError(f"--ranks {options.ranks}: must be at least 1")
    from mgehl.plausibility import check_contact
    from mgehl.solver.from_config import contact_from, mesh_from

    contact = contact_from(config)
    check_contact(config, contact)
    mesh = mesh_from(config, contact)
    print(f"{options.config or default_config()}: valid, a {NAMES[config.contact.kind]}\n")
    describe = _wedge if config.contact.kind == "wedge" else _loaded
    print(*describe(config, contact, mesh), *_estimate(config, contact, mesh, options.ranks), sep="\n")
    return CONVERGED


def _loaded(config, contact, mesh):
    """Lines about a point or a line contact."""
    hertz, line = contact.hertz, mesh.is_line
    groups = "   ".join(f"{name} {value:.4g}" for name, value in asdict(contact.groups).items())
    width = "" if line else f"   b {1e3 * hertz.b:.4g} mm"
    films = "   ".join(
        f"{name.replace('_', ' ')} {1e9 * film:.4g}" for name, film in asdict(contact.formulas).items()
    )
    return [
        f"groups     {groups}",
        f"regime     {contact.regime} (Moes)",
        f"Hertz      a {1e3 * hertz.a:.4g} mm{width}   p_h {1e-9 * hertz.p_h:.4g} GPa",
        f"films, nm  {films}",
        f"load       {contact.load:.6g} {'N/m' if line else 'N'}   speed {contact.speed:.6g} m/s",
        "",
        *_inlet(config, contact),
    ]


def _inlet(config, contact):
    """Lines about the inlet on every grid."""
    from mgehl.output.forecast import (
        LARGEST_NODES,
        RESOLVED_CELLS,
        expectation,
        inlet_grids,
        resolving_nodes,
    )

    grids = inlet_grids(config, contact)
    for grid in grids:
        at = "" if grid.speed is None else f"   solved at {1e3 * grid.speed:.4g} mm/s"
        yield f"grid {grid.nodes:5d}   {grid.cells:8.2f} cells in the inlet{at}"
    needed = resolving_nodes(config, contact)
    cells, start = grids[-1].cells, config.solver.start
    yield ""
    yield f"expected   from a {start} start, {expectation(cells, start)}"
    verdict = "this grid does" if needed <= config.grid.nodes else f"recommended: grid.nodes={needed}"
    if needed > LARGEST_NODES:
        verdict = f"no grid up to {LARGEST_NODES} does; a higher speed or a smaller domain helps"
    yield f"resolved   with {RESOLVED_CELLS:.0f} cells in the inlet, from {needed} nodes on: {verdict}"


def _wedge(config, bearing, mesh):
    """Lines about a wedge bearing."""
    section = config.wedge
    dx, dy = mesh.dX * bearing.x_scale, mesh.dY * bearing.y_scale
    lines = [
        f"gap        {1e6 * section.slope * section.exit:.4g} um at the exit, "
        f"{1e6 * section.slope * section.inlet:.4g} um at the inlet",
        f"scales     P 1/mm is {1e-6 * bearing.pressure_scale:.4g} MPa",
        f"cells      {1e3 * dx:.3g} mm by {1e3 * dy:.3g} mm, {section.exit / dx:.1f} from the exit to "
        "where the gap would end",
    ]
    if section.pillar != "none":
        lines.append(
            f"pillar     {section.pillar}, {section.pillar_size / dx:.1f} by "
            f"{section.pillar_size / dy:.1f} cells"
        )
    return lines


def _estimate(config, contact, mesh, ranks):
    """Lines about memory and time, and what they rest on."""
    from mgehl.output.forecast import forecast
    from mgehl.output.surroundings import memory_GiB

    found, have = forecast(config, contact, mesh, ranks), memory_GiB()
    need, on = found.memory / GiB, "1 rank" if ranks == 1 else f"{ranks} ranks"
    enough = f"this machine has {have:.1f}" if need <= have else f"MORE THAN THIS MACHINE'S {have:.1f}"
    yield ""
    yield f"memory     about {need:.1f} GiB on {on} ({enough})"
    yield f"time       about {_span(*map(_duration, found.seconds))} on {on}, an estimate:"
    if found.convolutions:
        low, high = found.convolutions
        yield f"           {_span(f'{low:.0f}', f'{high:.0f}')} convolutions expected: {found.measured};"
    else:
        yield f"           {found.measured};"
    cores = "1 core" if found.workers == 1 else f"{found.workers} cores"
    yield (
        f"           one takes {1e3 * found.convolution_seconds:.3g} ms, by n log n from "
        f"{found.timed_nodes} nodes timed just now; {cores} at work"
    )
    if found.convolutions:
        yield "           a run that does not settle takes longer, up to solver.max_steps steps a grid"


def _span(low, high):
    return low if low == high else f"{low} to {high}"


def _duration(seconds):
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400.0 else f"{seconds / 3600:.1f} h"
