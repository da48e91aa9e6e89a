"""A rough contact from full film to nearly dry: load share, contact area, patches and film by speed.

Each speed is solved from a film and from contact, and never from another speed. Where both lead to the same
state, that state does not depend on the start.
"""

import numpy as np

from mgehl.model.load_share import aihara, error_function, zhou_hoeprich
from mgehl.output.pictures.style import COLOURS, applied, save, subplots
from mgehl.studies.chance import BALL
from mgehl.studies.study import merged, verdict

NODES = 257
FASTEST, SLOWEST, COUNT = 1.0, 1e-5, 20
"""m/s."""

BOUNDARY_FILM = 2e-9
"""m: that of adsorbed layers."""

STARTS = {"film": {"marker": "o", "markerfacecolor": "none"}, "contact": {"marker": "x"}}
"""How the points of a start are drawn: both are seen where one covers the other."""

WITHOUT = {"film": 0.985, "contact": 0.96}
"""Height in a panel, from 0 to 1, at which points are marked that did not converge, by start."""

CASE = merged(
    BALL,
    {
        "contact": {"load": 100.0},
        "surface": {"rms": 100e-9, "hurst": 0.8, "shortest_wavelength": 30e-6, "seed": 1},
    },
)

FITS = {"Aihara": aihara, "Zhou-Hoeprich": zhou_hoeprich, "1 - erf": error_function}


def run(study):
    """Solve all; write the table `rough` and the picture `load-share`."""
    (nodes,) = study.nodes or (NODES,)
    asked = {f"{u:g} m/s from {start}": (u, start) for u in speeds() for start in STARTS}
    cases = {name: case(nodes, *how) for name, how in asked.items()}
    points = {asked[name]: found.result for name, found in study.solved(cases, with_fields=False)}
    study.write_table("rough", [row(speed, start, points) for speed, start in points])
    study.draw("load-share", load_share, points)


def speeds():
    """Fast to slow, m/s."""
    return [float(f"{speed:.4g}") for speed in np.geomspace(FASTEST, SLOWEST, COUNT)]


def case(nodes, speed, start, boundary_film=BOUNDARY_FILM):
    """The tables of a point."""
    own = {
        "contact": {"boundary_film": boundary_film},
        "grid": {"nodes": nodes},
        "motion": {"speed": speed},
        "solver": {"start": start},
    }
    return merged(CASE, own)


def row(speed, start, points):
    """Text of one of the points, {(m/s, start): `Result`}; numbers of what converged only."""
    result = points[speed, start]
    ratio, numbers = result.mixed.lambda_ratio, _numbers(result.mixed)
    return {
        "speed mm/s": f"{1e3 * speed:.4g}",
        "start": start,
        "lambda": f"{ratio:.4g}",
        **(numbers if result.converged else dict.fromkeys(numbers, "")),
        "load on contact apart from the other start": _difference(speed, points),
        **{name: f"{fit(ratio):.4f}" for name, fit in FITS.items()},
        "nodes in the shortest wave": f"{result.resolution.surface_nodes:.1f}",
        "made": f"{result.mass.made_share:.1e}",
        "convolutions": f"{result.work.convolutions:.0f}",
        "steps": str(result.work.steps),
        "verdict": verdict(result),
    }


def _numbers(mixed):
    return {
        "load on contact": f"{mixed.contact_load_share:.4g}",
        "load on solids": f"{mixed.solid_load_fraction:.4g}",
        "contact/Hertz area": f"{mixed.contact_area_over_hertz:.4g}",
        "contact area um^2": f"{1e12 * mixed.contact_area_m2:.1f}",
        "patches": str(mixed.patches),
        "largest patch um^2": f"{1e12 * mixed.largest_patch_m2:.1f}",
        "minimum film nm": _film(mixed.minimum_film_nm),
        "mean film nm": _film(mixed.mean_film_nm),
        "film in valleys nm": _film(mixed.valley_film_nm),
        "mean gap nm": f"{mixed.mean_gap_nm:.4f}",
        "gap by pressure nm": f"{mixed.loaded_gap_nm:.4f}",
        "torn": f"{mixed.torn_share:.4f}",
    }


def _film(nm):
    return "none" if nm is None else f"{nm:.3f}"


def _difference(speed, points):
    """How far apart the load shares of both starts are; empty unless both converged."""
    both = [points[speed, start] for start in STARTS if (speed, start) in points]
    shares = [result.mixed.contact_load_share for result in both if result.converged]
    return f"{abs(shares[0] - shares[1]):.1e}" if len(shares) == len(STARTS) else ""


def load_share(path, points):
    """Part of the load and of the Hertz area on contact against lambda, with the fits.

    Of points that did not converge only the lambda is marked, on the upper edge.
    """
    with applied():
        figure, (load, area) = subplots(1, 2, size=(10.5, 4.6))
        for (start, style), colour in zip(STARTS.items(), COLOURS, strict=False):
            own = [result for (_, each), result in points.items() if each == start]
            look = style | {"color": colour, "label": f"from {start}"}
            for axes, number in ((load, "contact_load_share"), (area, "contact_area_over_hertz")):
                _draw_start(axes, own, number, look, WITHOUT[start])
        ratios = [result.mixed.lambda_ratio for result in points.values()]
        ratio = np.geomspace(min(ratios), max(ratios), 200)
        for (name, fit), style in zip(FITS.items(), ("--", "-.", ":"), strict=False):
            load.plot(ratio, [fit(each) for each in ratio], style, color="0.4", lw=1.0, label=name)
        load.set(ylabel="part of the load on contact", ylim=(-0.03, 1.03))
        area.set(ylabel="contact area over Hertz area", ylim=(0.0, None))
        for axes in (load, area):
            axes.set(xscale="log", xlabel="lambda: film of smooth bodies over Sq")
            axes.legend(frameon=False)
        without = sum(not result.converged for result in points.values())
        note = f"; {without} of {len(points)} did not converge (ticks above)" if without else ""
        figure.suptitle(f"Rough ball on flat from full film to nearly dry{note}")
        save(figure, path)


def _draw_start(axes, results, number, look, above):
    """A number of the `MixedResult` of what converged; where the others are, a mark at height `above`."""
    good = [result.mixed for result in results if result.converged]
    numbers = [getattr(mixed, number) for mixed in good]
    axes.plot([mixed.lambda_ratio for mixed in good], numbers, linestyle="none", **look)
    bad = [result.mixed.lambda_ratio for result in results if not result.converged]
    place = axes.get_xaxis_transform()
    axes.plot(bad, len(bad) * [above], linestyle="none", marker="|", color=look["color"], transform=place)
