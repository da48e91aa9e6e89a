"""Whether the domain that "auto" chooses is large enough, and whether a starved film is recognised.

Each case is solved on a domain and on one of twice the size, with equal cells. The change of the film is
compared with the estimate. `auto` has the domains that mgehl chooses, `starved` smaller ones.
"""

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from, settled
from mgehl.model.room import interval_on_nodes
from mgehl.output.domain import domain_verdict
from mgehl.studies.study import BEST, merged

PARTS = (0.3, 0.5)
"""Parts of the room that "auto" leaves around the contact: the smaller domains."""

NEAREST = 1.15
"""End of the nearest domain, in semi-axes."""

CONSTANT = {"lubricant": {"density_law": "constant"}}
MY_CASE = {"contact": {"load": 250.0, "radius_x": 10e-3, "radius_y": 15e-3}}
"""A steel ellipsoid in the paper's oil."""
BALL_BEARING = {
    "contact": {"load": 300.0, "radius_x": 3.8e-3, "radius_y": 124e-3, "reduced_modulus": 226e9},
    "lubricant": {"viscosity": 0.02, "pressure_viscosity": 20e-9},
    "motion": {"speed": 3.0},
}
"""configs/ball_bearing.toml."""
ELLIPSE = {"contact": {"load": 300.0, "radius_x": 10e-3, "radius_y": 83e-3}, "motion": {"speed": 0.5}}


def moes(M, L, **contact):
    """A point contact by Moes' numbers, incompressible."""
    return merged(CONSTANT, {"moes": {"M": M, "L": L}, "contact": contact})


def line(load, speed):
    """A line contact of the paper's body."""
    return {"contact": {"kind": "line", "load_per_length": load}, "motion": {"speed": speed}}


CASES = {
    "my.toml, 0.4 m/s": (merged(MY_CASE, {"motion": {"speed": 0.4}}), 257),
    "my.toml, 3 m/s": (merged(MY_CASE, {"motion": {"speed": 3.0}}), 129),
    "my.toml, 3 m/s, Roelands": (
        merged(MY_CASE, {"motion": {"speed": 3.0}, "lubricant": {"viscosity_law": "roelands"}}), 129,
    ),
    "ball bearing": (BALL_BEARING, 129),
    "M 5, L 5": (moes(5.0, 5.0), 257),
    "M 5, L 5, fewer nodes": (moes(5.0, 5.0), 65),
    "M 2, L 4": (moes(2.0, 4.0), 257),
    "M 3, L 2": (moes(3.0, 2.0), 257),
    "M 5, L 5, 10:1": (moes(5.0, 5.0, radius_x=5e-3, radius_y=50e-3), 257),
    "M 8, L 3": (moes(8.0, 3.0), 129),
    "M 12, L 8": (moes(12.0, 8.0), 129),
    "M 20, L 10": (moes(20.0, 10.0), 129),
    "M 60, L 2": (moes(60.0, 2.0), 129),
    "M 200, L 14": (moes(200.0, 14.0), 129),
    "M 1000, L 6": (moes(1000.0, 6.0), 129),
    "M 5000, L 10": (moes(5000.0, 10.0), 257),
    "M 100, L 8, 1:4": (moes(100.0, 8.0, radius_x=20e-3, radius_y=5e-3), 129),
    "M 100, L 8, 8:1": (moes(100.0, 8.0, radius_x=5e-3, radius_y=40e-3), 129),
    "ball at 45 degrees": ({"motion": {"speed": 1.0, "angle": 45.0}}, 129),
    "ellipse at 30 degrees": (merged(ELLIPSE, {"motion": {"angle": 30.0}}), 129),
    "ellipse at 110 degrees": (merged(ELLIPSE, {"motion": {"angle": 110.0}}), 129),
    "line, 50 N/mm, 1 m/s": (line(50e3, 1.0), 257),
    "line, 20 N/mm, 1 m/s": (line(20e3, 1.0), 257),
    "line, 1859 N/mm, 3 m/s": (line(1859e3, 3.0), 513),
}  # fmt: skip
"""Tables and nodes of each; the larger domains have twice the cells."""


def run(study):
    """Solve all; write the tables `auto` and `starved`."""
    study.cases = 2 * (1 + len(PARTS)) * len(CASES)
    auto, near = [], []
    for name, (tables, nodes) in CASES.items():
        tables = merged({"discretization": BEST}, tables, {"grid": {"nodes": nodes}})
        config = config_from_tables(tables)
        grid = settled(config, contact_from(config)).grid
        ends = (grid.x, None if config.contact.kind == "line" else grid.y)
        auto.append(_row(study, name, tables, ends))
        near += [_row(study, name, tables, [_nearer(each, part) for each in ends]) for part in PARTS]
    study.write_table("auto", auto)
    study.write_table("starved", near)


def _nearer(ends, part):
    """An interval with a `part` of another one's room beside the contact; None of None."""
    if ends is None:
        return None
    return interval_on_nodes(*(max(1.0 + part * (abs(end) - 1.0), NEAREST) for end in ends))


def _row(study, name, tables, ends):
    """Films on a domain beside those on another of twice its size."""
    nodes = tables["grid"]["nodes"]
    small = study.solve(name, _on(tables, nodes, ends, 1.0))
    large = study.solve(f"{name}, twice the size", _on(tables, 2 * nodes - 1, ends, 2.0))
    resolution, films, more = small.result.resolution, small.result, large.result
    central = 100.0 * (more.central_film_nm / films.central_film_nm - 1.0)
    minimum = 100.0 * (more.minimum_film_nm / films.minimum_film_nm - 1.0)
    return {
        "case": name,
        "nodes": str(nodes),
        "x": _words(small.config.grid.x),
        "y": "" if ends[1] is None else _words(small.config.grid.y),
        "converged": "yes" if films.converged and more.converged else "no",
        "inlet cells": f"{resolution.inlet_cells:.2f}",
        "central nm": f"{films.central_film_nm:.4f}",
        "minimum nm": f"{films.minimum_film_nm:.4f}",
        "central more, %": f"{central:+.2f}",
        "minimum more, %": f"{minimum:+.2f}",
        "estimated, %": f"{resolution.domain_loss_percent:.2f}",
        "verdict": resolution.domain,
        "right": _judged(max(abs(central), abs(minimum)), resolution.domain),
    }


def _judged(lost, verdict):
    """Whether a verdict may stand: above 2 % starved, below 0.5 % sufficient, in between either."""
    right = {domain_verdict(lost)} if lost > 2.0 or lost < 0.5 else {verdict}
    return "yes" if verdict in right else "NO"


def _on(tables, nodes, ends, scale):
    names = [name for name, each in zip("xy", ends, strict=True) if each]
    domain = {name: [scale * end for end in each] for name, each in zip(names, ends, strict=False)}
    return merged(tables, {"grid": {"nodes": nodes, **domain}})


def _words(ends):
    return f"{ends[0]:g} to {ends[1]:g}"
