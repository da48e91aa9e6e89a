"""A run in time: what is kept of each step, and series.nc, the same over time after CF.

It is written anew with every checkpoint and at the end. And the means over passages: what an engineer asks
of roughness that moves. A passage is the time in which all heights that move go the length of the Hertz
contact of the present load, and of smooth bodies the mean surface (`Scene.passage`). Beside a mean
stands by how much those of the last two passages differ; what grid and steps make of it is `time_error`'s.
"""

from itertools import pairwise
from math import nan

import numpy as np

from mgehl.output.netcdf import netcdf_file, put
from mgehl.output.result import Mean, TimeResult
from mgehl.output.whole_file import whole_file
from mgehl.solver.gaps import NARROW, loads, within_hertz
from mgehl.solver.shear import shear_of

COLUMNS = {
    "step": ("1", "number of the step"),
    "step_s": ("s", "length of the step"),
    "speed_mm_s": ("mm s-1", "entrainment speed"),
    "load_share": ("1", "load over that at the beginning"),
    "angle_deg": ("degree", "direction of the motion, from +x towards +y, where it changes"),
    "path_um": ("um", "way that the mean surface of a line contact has gone"),
    "path_x_um": ("um", "way that the mean surface of a point contact has gone along x"),
    "path_y_um": ("um", "way that it has gone along y"),
    "central_film_nm": ("nm", "film at the centre of the contact"),
    "minimum_film_nm": ("nm", "smallest film"),
    "mean_gap_nm": ("nm", "mean gap within the Hertz ellipse of the load"),
    "Sq_nm": ("nm", "rms of the heights within the Hertz ellipse of the load, of rough bodies"),
    "max_pressure_GPa": ("GPa", "largest pressure"),
    "pressure_crest": ("1", "what it may be larger between the nodes, over itself"),
    "load_on_contact": ("1", "part of the load on contact nodes"),
    "load_on_solids": ("1", "part of the load that solids carry"),
    "squeezed_beyond": ("1", "part of the load on oil that is squeezed out beyond the domain"),
    "friction": ("1", "shear of film and solids over the load"),
    "largest_shear_MPa": ("MPa", "largest shear stress of film and solids"),
    "rolling": ("1", "what drags a body against the motion, mean of both, over the load"),
    "contact_nodes": ("1", "nodes in contact"),
    "cavitated_nodes": ("1", "nodes of cavities"),
    "residual": ("1", "residual that the step leaves"),
    "load_error": ("1", "error of the load"),
    "stored_oil": ("1", "oil in the domain, in units of H, X and Y"),
    "closure": ("1", "what the account of the oil is off in the step, over what is stored"),
    "newton_steps": ("1", "Newton steps of the step"),
    "halvings": ("1", "times that the step was halved"),
    "convolutions": ("1", "fine-grid convolutions until then"),
    "seconds": ("s", "seconds of work until then"),
}
"""What history.csv and series.nc have of each step beside time_s: unit and meaning."""

PATH = "path_um", "path_x_um", "path_y_um"
"""Columns of the path: one or two."""

SETTLED = 0.01
"""Part of a mean that its band may be; of a load share that part of the load."""

SLOWEST = 0.95
"""Part of a change that the next passage has again, at the most that is thought of."""

ROUNDING = 1e-9
"""Part of a passage by which ways may be off."""

FEWEST = 3
"""Passages before means are asked whether they have settled: the first one begins."""

MEANS = (
    "mean_gap_nm", "central_film_nm", "minimum_film_nm", "max_pressure_GPa",
    "load_on_contact", "load_on_solids", "friction",
)  # fmt: skip
"""Columns of which there are means."""


def row_of(instant, standing, problem, scene, convolutions, seconds):
    """What is kept of an `Instant` of a `Scene` after which the run stands there (collective)."""
    state, contact, grid = standing.state, problem.contact, problem.grid
    nm, last = 1e9 * contact.film_scale, instant.newton.cycles[-1]
    carried = loads(problem, state)
    inside = within_hertz(grid.mesh, problem.hertz.reach)[grid.first : grid.last]
    return {
        "time_s": instant.t,
        "step": instant.number,
        "step_s": instant.step,
        "grid": grid.mesh.nx,
        "speed_mm_s": 1e3 * instant.speed,
        "load_share": instant.load,
        **_gone(instant, standing, scene),
        "central_film_nm": last.central * nm,
        "minimum_film_nm": last.minimum * nm,
        "mean_gap_nm": problem.mean(state.H, inside) * nm,
        **({"Sq_nm": _roughness(problem, inside) * nm} if scene.contact.surface else {}),
        "max_pressure_GPa": 1e-9 * contact.pressure_scale * carried.largest,
        "pressure_crest": carried.crest_share,
        "load_on_contact": carried.contact,
        "load_on_solids": carried.solids,
        "squeezed_beyond": problem.squeezed_beyond(state.H0) / problem.hertz.integral,
        **_resistance(instant, state, problem),
        "contact_nodes": last.contact_nodes,
        "cavitated_nodes": last.cavitated_nodes,
        "residual": last.residual,
        "load_error": last.load_error,
        "stored_oil": instant.stored,
        "closure": instant.closure,
        "newton_steps": len(instant.newton.cycles) - 1,
        "halvings": instant.halvings,
        "convolutions": convolutions,
        "seconds": seconds,
    }


def _roughness(problem, inside):
    """Rms of the heights of some nodes, in units of H (collective)."""
    grid = problem.grid
    heights = problem.contact.smooth_gap(*np.broadcast_arrays(grid.X, grid.Y)) - problem.undeformed
    return np.sqrt(problem.mean((heights - problem.mean(heights, inside)) ** 2, inside))


def _gone(instant, standing, scene):
    """The direction of the motion where it changes, and the path."""
    x, y = (1e6 * part for part in standing.path)
    path = {"path_um": x} if scene.contact.is_line else {"path_x_um": x, "path_y_um": y}
    return ({"angle_deg": scene.angle.value(instant.t)} if scene.turns else {}) | path


def _resistance(instant, state, problem):
    """What resists the motion at an instant, over its load (collective)."""
    shear, load = shear_of(problem.moving(instant.speed), state), instant.load * problem.contact.load
    return {
        "friction": shear.sliding_force / load,
        "largest_shear_MPa": 1e-6 * problem.grid.max(shear.stress),
        "rolling": shear.rolling_force / load,
    }


def title_of(config):
    """The title of files of a run in time."""
    return f"{config.kind.content} {config.kind.noun} over time"


def write_series(path, rows, title):
    """series.nc of the rows of a history. Raises OSError."""
    with whole_file(path) as part, netcdf_file(part, title) as file:
        file.dimensions = {"time": len(rows)}
        for name, (unit, meaning) in {"time_s": ("s", "time"), **COLUMNS}.items():
            if rows and name not in rows[0]:
                continue
            values = np.array([row[name] for row in rows], dtype=float)
            told = {"axis": "T"} if name == "time_s" else {}
            called = "time" if told else name
            put(file, called, ("time",), values, units=unit, long_name=meaning, **told)


def passed(rows, scene):
    """Passages that the rows of a history have gone through by the end of each, (rows,)."""
    path = np.array([[row[name] for name in PATH if name in row] for row in rows])
    loads = np.array([row["load_share"] for row in rows])
    angles = np.array([row["angle_deg"] for row in rows]) if scene.turns else None
    lengths = np.empty(len(rows))
    for share in np.unique(loads):
        here = loads == share
        lengths[here] = 1e6 * scene.passage(share, None if angles is None else angles[here])
    # The way goes on from that of another run, if this one started there.
    first = 1e6 * np.linalg.norm(scene.way(0.0, rows[0]["time_s"]))
    ways = np.append(first, np.linalg.norm(np.diff(path, axis=0), axis=1))
    return np.cumsum(ways / lengths)


def means(rows, gone):
    """{name: `Mean`} of the last passage, `gone` as `passed` says; empty before the end of the first."""
    if gone[-1] < 1.0:
        return {}
    found = {}
    for name in MEANS:
        before, last = _of_passages(rows, gone, name, 2)
        two = gone[-1] >= 2.0 and np.isfinite(before)
        found[name] = Mean(last, abs(last - before) if two else None)
    return found


def _of_passages(rows, gone, name, count):
    """Means of a column over that many passages, the last one the last; nan of one without a step."""
    weights, values = (np.array([row[each] for row in rows]) for each in ("step_s", name))
    ago = np.floor(gone[-1] - gone + ROUNDING)
    passages = (ago == k for k in reversed(range(count)))
    return [float(np.average(values[one], weights=weights[one])) if one.any() else nan for one in passages]


def passing_Sq_nm(rows, gone):
    """Rms of the heights over the last passage, or all steps before its end; None of smooth bodies."""
    if "Sq_nm" not in rows[0]:
        return None
    last = gone > gone[-1] - 1.0 + ROUNDING
    weights, Sq = (np.array([row[name] for row in rows])[last] for name in ("step_s", "Sq_nm"))
    return float(np.sqrt(np.average(Sq**2, weights=weights)))


def has_whole(scene):
    """Whether a mean over the whole run is asked for: where speed or load of a `Scene` change."""
    least, most = scene.load.range(scene.end)
    return not scene.is_steady or least != most


def over_all(rows, scene):
    """{name: mean over all steps}, where they are asked for; else nothing."""
    if not has_whole(scene):
        return {}
    weights = [row["step_s"] for row in rows]
    return {name: float(np.average([row[name] for row in rows], weights=weights)) for name in MEANS}


def have_settled(rows, scene):
    """Whether the means of gap and load on solids have settled after `FEWEST` passages in which speed, load
    and direction stay: what they still change by, if they go on as in the last three, is little."""
    gone = passed(rows, scene)
    times = [row["time_s"] for row in rows]
    if gone[-1] - np.interp(scene.stays_from, [0.0, *times], [0.0, *gone]) < FEWEST:
        return False
    gap, solids = (_of_passages(rows, gone, name, 3) for name in ("mean_gap_nm", "load_on_solids"))
    return _left(*gap) <= SETTLED * gap[-1] and _left(*solids) <= SETTLED


def _left(first, second, third):
    """What is left to change after three values: the rest of a geometric series where they go one way.

    A light ball's film changed by 0.9 % in a passage, and 10 % were left.
    """
    before, last = second - first, third - second
    ratio = last / before if before else 0.0
    return abs(last) / (1.0 - min(max(ratio, 0.0), SLOWEST))


def time_result(rows, scene, work, largest_node):
    """The `TimeResult` of the rows of a history of a `Scene`."""
    each = [after["convolutions"] - before["convolutions"] for before, after in pairwise(rows)]
    gone = passed(rows, scene)
    return TimeResult(
        end_s=rows[-1]["time_s"],
        steps=len(rows),
        halved=sum(row["halvings"] > 0 for row in rows),
        largest_closure=max(abs(row["closure"]) for row in rows),
        largest_node=largest_node,
        convolutions_a_step=sorted(each)[len(each) // 2] if each else work.convolutions,
        passages=float(gone[-1]),
        means=means(rows, gone),
        whole=over_all(rows, scene),
        Sq_nm=passing_Sq_nm(rows, gone),
        largest_shear_MPa=max(row["largest_shear_MPa"] for row in rows),
        most_pressure_GPa=max(row["max_pressure_GPa"] for row in rows),
        least_film_nm=min(row["minimum_film_nm"] for row in rows),
        spikes=sum(row["pressure_crest"] > NARROW for row in rows),
        squeezed_beyond=max((row.get("squeezed_beyond", 0.0) for row in rows), key=abs),
    )
