"""Roughness that moves: waves and a dimple that pass through full films, beside published numbers.

Small waves pass through a line contact at s times the mean speed: the amplitude with which the central film
swings, over theirs. Waves pass through a point contact in pure rolling [Venner and Lubrecht 2000, eq. 29],
and a dimple [Mourier et al., Tribol Int 39 (2006) 1745; Hansen et al., Tribol Lett 70 (2022) 80].
"""

from pathlib import Path

import numpy as np

from mgehl.output.pictures.style import GUIDE, subplots
from mgehl.studies import waviness
from mgehl.studies.columns import told
from mgehl.studies.study import merged

NODES = 1025
"""Of a line contact; waves of a half-width have 186 cells."""

ROELANDS, BARUS = waviness.LINES

REFERENCE = {
    (100.0, 1.0): {0.5: 0.1307, 0.75: 0.1574, 1.0: 0.1807, 1.25: 0.1928, 1.5: 0.2133, 2.0: 0.2485},
    (100.0, 0.5): {0.5: 0.2999, 0.75: 0.3407, 1.0: 0.3931, 1.25: 0.4178, 1.5: 0.4551, 2.0: 0.5135},
    (200.0, 1.0): {0.5: 0.0805, 1.0: 0.1091, 2.0: 0.1586},
    (200.0, 0.5): {0.5: 0.2025, 1.0: 0.2662, 2.0: 0.3646},
}
"""Swing of the film over the waves' amplitude, by M and length over the half-width, and by s: an
independent linear calculation on 2049 nodes."""

PUBLISHED = {4.0: 0.030, 2.0: 0.073, 1.0: 0.183, 0.5: 0.394}
"""The same of M = 100, L = 11 in pure rolling, by length [Venner et al. 1997, Table 1]."""

FRESH = 1.1
"""Lengths of the domain that film and waves go before the swing is looked at."""

POINT_NODES, POINT, POINT_LENGTHS = 257, (1007.6, 12.05), (1.0, 0.5, 0.25)
"""Of the point contact with waves: nodes; M and L, at which an amplitude is published; lengths over a."""

COMPUTED = {0.25: 0.739}
"""Amplitude left by length [Venner and Lubrecht 2000]."""

BALL = {
    "contact": {"load": 15.0, "radius_x": 12.5e-3, "radius_y": 12.5e-3, "reduced_modulus": 110e9},
    "lubricant": {"viscosity": 0.25, "viscosity_law": "roelands", "pressure_viscosity": 22e-9},
    "motion": {"speed": 0.09},
    "grid": {"nodes": 257, "x": [-3.0, 3.0], "y": [-3.0, 3.0]},
}

WITH_DIMPLE = {"contact": {"surface": f"{Path(__file__)}:dimple", "surface_body": "body_1"}}

WIDTH, DEPTH, FROM = 15.5e-6, 175e-9, -410.2e-6
"""Of the dimple in m, and where it begins: three radii of the contact before its centre."""

PLACES = {-102.4: (358, 381), -41.6: (354, 385), 19.2: (355, 390), 108.8: (354, 395)}
"""Where the dimple is, in um: its film in nm and the largest pressure in MPa [Hansen et al. 2022]."""


def dimple(x, y):
    """Heights of the dimple before it moves."""
    s = np.hypot(x - FROM, y)
    return -DEPTH * np.cos(np.pi * s / (2.4 * WIDTH)) * np.exp(-2.0 * (s / (1.2 * WIDTH)) ** 2)


def run(study):
    """Solve all; write the tables `waves`, `points` and `dimple`, and the picture `points`."""
    nodes = study.asked.nodes[0] if study.asked.nodes else NODES
    on_points = min(nodes, POINT_NODES)
    cases = [(ROELANDS, length, 1.0) for length in (4.0, 2.0)]
    cases += [(line, length, s) for line in (ROELANDS, BARUS) for length in (1.0, 0.5)
              for s in REFERENCE[line[0], length]]  # fmt: skip
    study.expected = len(cases) + len(POINT_LENGTHS) + len(PLACES) + 4
    smooth = {line: study.solve(f"smooth, M {line[0]:g}", _line(line, nodes)) for line in (ROELANDS, BARUS)}
    study.write_table("waves", [_wave(study, smooth[case[0]], *case, nodes) for case in cases])
    points = list(_points(study, on_points))
    study.write_table("points", points)
    study.draw("points", figure, points)
    study.write_table("dimple", list(_dimple(study)))


def _line(line, nodes):
    return merged(waviness.line_case(*line), {"grid": {"nodes": nodes}})


def _wave(study, smooth, line, length, s, nodes):
    """The row of one wave."""
    title = f"M {line[0]:g}, length {length:g}, s {s:g}"
    found, swing = passed(study, title, _line(line, nodes), smooth, {"wavelength_x": length}, s)
    published = PUBLISHED.get(length) if line is ROELANDS and s == 1.0 else None
    known = REFERENCE.get((line[0], length), {}).get(s)
    return {
        "M": f"{line[0]:g}", "L": f"{line[1]:g}", "fluid": line[2], "wavelength/b": f"{length:g}",
        "s": f"{s:g}", "swing/A": f"{swing:.4f}",
        "reference": "" if known is None else f"{known:.4f}",
        "apart %": "" if known is None else f"{100.0 * (swing / known - 1.0):+.1f}",
        "published": "" if published is None else f"{published:.3f}",
        **_ended(found.result),
    }  # fmt: skip


def passed(study, title, case, smooth, lengths, s=1.0):
    """The run in which small waves pass at s times the mean speed, and the swing of the film over their
    amplitude. `lengths` are keys of the surface, over the Hertz radius of the `smooth` solution."""
    contact, mesh = smooth.contact, smooth.mesh
    amplitude, unit = waviness.SMALL * 1e-9 * smooth.result.central_film_nm, contact.x_scale / contact.speed
    period = lengths["wavelength_x"] / s
    end = FRESH * (mesh.x[1] - mesh.x[0]) / min(s, 1.0) + period
    waves = {name: length * contact.x_scale for name, length in lengths.items()}
    tables = {
        "surface": {"kind": "waviness", "amplitude": amplitude, "body": "body_1", **waves},
        "motion": {"slide_to_roll": 2.0 * (s - 1.0)},
        "time": {"end": end * unit},
    }
    found = study.solve(title, merged(case, tables))
    return found, swing_of(found.rows, period * unit) / (1e9 * amplitude)


def point_case(M, L):
    """The tables of a point contact of these Moes numbers, by Roelands' law."""
    return {
        "moes": {"M": M, "L": L},
        "contact": waviness.BODIES | {"radius_y": waviness.RADIUS},
        "lubricant": waviness.oil(ROELANDS[2]),
        "grid": {"x": [-2.5, 1.5], "y": [-2.0, 2.0]},
    }


def _points(study, nodes):
    """Rows of the waves through a point contact."""
    M, L = POINT
    case = merged(point_case(M, L), {"grid": {"nodes": nodes}})
    smooth = study.solve(f"smooth point, M {M:g}", case)
    for length in POINT_LENGTHS:
        lengths = {"wavelength_x": length, "wavelength_y": length}
        found, swing = passed(study, f"point, M {M:g}, length {length:g}", case, smooth, lengths)
        n = length * (M / L) ** 0.5
        yield {
            "M": f"{M:g}", "L": f"{L:g}", "wavelength/a": f"{length:g}", "n": f"{n:.2f}",
            "swing/A": f"{swing:.3f}",
            "master curve": f"{master_curve(n):.3f}",
            "computed there": f"{COMPUTED[length]:.3f}" if length in COMPUTED else "",
            **_ended(found.result),
        }  # fmt: skip


def master_curve(n):
    """Amplitude that is left of waves in pure rolling  [Venner and Lubrecht 2000, eq. 29]."""
    return 1.0 / (1.0 + 0.15 * n + 0.015 * n**2)


def figure(points):
    """The rows of a point contact beside the master curve."""
    drawn, axis = subplots(size=(5.6, 3.8))
    n = np.geomspace(0.3, 30.0, 200)
    axis.plot(n, master_curve(n), color=GUIDE, label="Venner and Lubrecht")
    solved = np.array([[float(row["n"]), float(row["swing/A"])] for row in points]).T
    axis.plot(*solved, "o", label="solved")
    axis.set(xscale="log", xlabel="n = (wavelength/a) sqrt(M/L)", ylabel="amplitude left", ylim=(0.0, 1.05))
    axis.legend()
    return drawn


def _ended(result):
    """What the steps in time took, where the first state was found, and whether it converged."""
    steps, time = {}, result.time
    if time:
        steps = {"steps": str(time.steps), "convolutions a step": f"{time.convolutions_a_step:.1f}"}
    return steps | told(result, "converged")


def swing_of(rows, period):
    """Amplitude of the central film in nm over the last period in s."""
    t, h = (np.array([row[name] for row in rows]) for name in ("time_s", "central_film_nm"))
    last = t > t[-1] - period * (1.0 + 1e-9)
    turn = 2.0 * np.pi * t[last] / period
    parts = np.stack([np.cos(turn), np.sin(turn), np.ones(turn.size)], axis=1)
    return float(np.hypot(*np.linalg.lstsq(parts, h[last], rcond=None)[0][:2]))


def _dimple(study):
    """Rows of the dimple at its places."""
    smooth = study.solve("smooth ball", BALL)
    for place, (film, pressure) in PLACES.items():
        end = (1e-6 * place - FROM) / BALL["motion"]["speed"]
        found = study.solve(f"dimple at {place:g} um", merged(BALL, WITH_DIMPLE, {"time": {"end": end}}))
        yield {
            "dimple at um": f"{place:g}",
            "film in it nm": f"{_film_at(found, 1e-6 * place):.0f}", "published nm": f"{film}",
            "largest pressure MPa": f"{1e3 * found.result.max_pressure_GPa:.0f}",
            "published MPa": f"{pressure}",
            "smooth film nm": f"{smooth.result.central_film_nm:.1f}",
            **_ended(found.result),
        }  # fmt: skip


def _film_at(solution, x):
    """Film in nm on the line through the centre at x in m, on rank 0."""
    line = waviness.central_line(solution)
    return 0.0 if line is None else 1e9 * float(np.interp(x, solution.x, line))
