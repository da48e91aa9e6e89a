"""Speed, direction and load that change.

The paper's ball, whose speed, direction or load changes, and films on the way. Where squeeze is weak, the
film at x is the steady one at the speed at which the oil there entered [Sugimura et al., Tribol Int 32
(1999) 117]: a softer ball's.
"""

from math import pi, sin
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from mgehl.output.film_error import FILMS
from mgehl.output.pictures.style import COLOURS, subplots
from mgehl.studies.columns import told
from mgehl.studies.moving import BALL
from mgehl.studies.study import merged

NODES, SPEED, TIME = 129, 0.3, 1.37e-3
"""Of the paper's ball: nodes, m/s, and the time in s in which its surfaces go the contact's radius."""

LOAD = 800.0

PAPERS_BALL = {
    "contact": {"load": LOAD},
    "motion": {"speed": SPEED},
    "grid": {"x": [-2.5, 2.5], "y": [-2.0, 2.0]},
}
"""What is not told is the paper's in every configuration."""

BEGINS, LASTS = TIME, 8.0 * TIME
"""When a course begins to change, and when a run ends."""

COURSES = {
    "start from rest": ("motion", "speed", "start"),
    "stop": ("motion", "speed", "stop"),
    "reversal": ("motion", "speed", "reversal"),
    "turn by 90 degrees": ("motion", "angle", "turn"),
    "load up by half in 1 ms": ("contact", "load", "heavier"),
}
"""Table and key that change, and the function of this file by which they do."""

SWING, PERIOD, MEAN = 0.5, 0.1, 0.09
"""Of the speed that swings: part of the mean, s, m/s."""

STEADY = tuple(MEAN * each for each in (0.4, 0.55, 0.7, 0.85, 1.0, 1.25, 1.6))


def start(t):
    """m/s after t s: from rest within two radii."""
    return SPEED * min(t / (2.0 * TIME), 1.0)


def stop(t):
    """m/s: to rest within two radii."""
    return SPEED * (1.0 - _gone(t, 2.0 * TIME))


def reversal(t):
    """m/s: turned round within two radii."""
    return SPEED * (1.0 - 2.0 * _gone(t, 2.0 * TIME))


def turn(t):
    """Degrees: by a right angle within two radii."""
    return 90.0 * _gone(t, 2.0 * TIME)


def heavier(t):
    """N: half more within a millisecond."""
    return LOAD * (1.0 + 0.5 * _gone(t, 1e-3))


def _gone(t, length):
    """Part of a change of this length in s that has passed."""
    return min(max((t - BEGINS) / length, 0.0), 1.0)


def swinging(t):
    """m/s."""
    return MEAN * (1.0 + SWING * sin(2.0 * pi * t / PERIOD))


def run(study):
    """Solve all; write the tables `courses` and `courses-slow`, and the picture `courses`."""
    (nodes,) = study.asked.nodes or (NODES,)
    study.expected = len(COURSES) + len(STEADY) + 1
    runs = {title: study.solve(title, case(nodes, *how)) for title, how in COURSES.items()}
    study.write_table("courses", [_row(title, found) for title, found in runs.items()])
    study.draw("courses", figure, {title: found.rows for title, found in runs.items()})
    study.write_table("courses-slow", [_slow(study, nodes)])


def case(nodes, section, key, function):
    """The tables of a course."""
    changes = {section: {key: f"{Path(__file__)}:{function}"}, "time": {"end": LASTS}}
    return merged(PAPERS_BALL, {"grid": {"nodes": nodes}}, changes)


def _row(title, found):
    """Films on the way."""
    rows, time = found.rows or [{}], found.result.time
    films = {name: np.array([row.get(f"{name}_film_nm", np.nan) for row in rows]) for name in FILMS}
    cells = {
        f"{name} film first / least / last nm": f"{film[0]:.1f} / {film.min():z.1f} / {film[-1]:.1f}"
        for name, film in films.items()
    }
    return {"course": title, "steps": f"{time.steps if time else 0}", **cells, **_closes(found)}


def _closes(found):
    time = found.result.time
    if not time:
        return told(found.result, "converged")
    return {
        "halved": f"{time.halved}",
        "convolutions a step": f"{time.convolutions_a_step:.1f}",
        "account off by": f"{time.largest_closure:.1e}",
        **told(found.result, "converged"),
    }


def _slow(study, nodes):
    """The film of a speed that swings, beside steady films at the speed of the time before."""
    ball = merged(BALL, {"grid": {"nodes": nodes}})
    steady = [study.solve(f"steady, {u:.4g} m/s", merged(ball, {"motion": {"speed": u}})) for u in STEADY]
    course = {"motion": {"speed": f"{Path(__file__)}:swinging"}, "time": {"end": PERIOD}}
    found = study.solve("swinging", merged(ball, course))
    films = np.array([each.result.central_film_nm for each in steady])
    radius = found.contact.x_scale
    before, now = (off(found.rows, films, way) for way in (radius, 0.0))
    return {
        "speed m/s": f"{MEAN:g} (1 + {SWING:g} sin(2 pi t/{PERIOD:g} s))",
        "off the steady film of the time before %": f"{100.0 * before:.1f}",
        "off that of the same time %": f"{100.0 * now:.1f}",
        "steps": f"{found.result.time.steps if found.result.time else 0}",
        **_closes(found),
    }


def off(rows, films, way):
    """The most by which central films are off the steady `films` at the speed that the surfaces had before
    they went the last `way` in m; of rows after the first four such ways."""
    if not rows:
        return np.nan
    t, h = (np.array([row[name] for row in rows]) for name in ("time_s", "central_film_nm"))
    fine = np.linspace(0.0, PERIOD, 20001)
    gone = MEAN * (fine + SWING * PERIOD / (2.0 * pi) * (1.0 - np.cos(2.0 * pi * fine / PERIOD)))
    path = np.interp(t, fine, gone)
    speed = np.array([swinging(each) for each in np.interp(path - way, gone, fine)])
    steady = np.exp(CubicSpline(np.log(STEADY), np.log(films))(np.log(speed)))
    later = path > 4.0 * way
    return float(np.abs(h / steady - 1.0)[later].max())


def figure(courses):
    """A matplotlib figure: films over time, a panel for each course."""
    drawn, panels = subplots(1, len(courses), size=(2.75 * len(courses), 3.4), sharey=True)
    for panel, (title, rows) in zip(panels, courses.items(), strict=True):
        t = [1e3 * row["time_s"] for row in rows or ()]
        for name, colour in zip(FILMS, COLOURS, strict=False):
            films = [row[f"{name}_film_nm"] for row in rows or ()]
            panel.plot(t, films, color=colour, label=f"{name} film")
        panel.set(title=title, xlabel="time, ms", yscale="log")
    panels[0].set_ylabel("nm")
    panels[0].legend()
    return drawn
