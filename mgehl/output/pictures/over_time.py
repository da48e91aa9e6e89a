"""A run in time in curves: what drives it, films, pressure, shares of the load."""

import numpy as np

from mgehl.kinds.kind import pressure_unit
from mgehl.output.pictures.history import column
from mgehl.output.pictures.style import COLOURS, CONTACT_COLOUR, FILM, PRESSURE, subplots
from mgehl.output.pictures.titles import title_of_all

PANELS = (
    ("direction, degrees", {"angle_deg": ("of the motion", COLOURS[1])}),
    ("film, nm", {"central_film_nm": ("central", FILM), "mean_gap_nm": ("mean within Hertz", COLOURS[4]),
                  "minimum_film_nm": ("minimum", COLOURS[3])}),
    ("largest pressure", {"max_pressure_GPa": ("largest pressure", PRESSURE)}),
    ("part of the load", {"load_on_contact": ("on contact", CONTACT_COLOUR),
                          "load_on_solids": ("on solids", COLOURS[6])}),
    ("friction", {"friction": ("over the load", COLOURS[1])}),
)  # fmt: skip
"""Axis of each panel, and its columns of history.csv with name and colour."""

DRIVEN = {"speed_mm_s": ("speed", COLOURS[1]), "load_share": ("load", COLOURS[5])}
"""What may be a course of time: drawn over its largest value, where it changes."""


def over_time(solution):
    """Figure of films, largest pressure and shares of the load against time, with speed, load and direction
    above them where they change."""
    rows = solution.rows
    t, units = column(rows, "time_s"), {"s": 1.0, "ms": 1e3, "us": 1e6}
    in_s = next((unit for unit, factor in units.items() if t[-1] * factor >= 1.0), "us")
    t = t * units[in_s]
    panels = [(label, _there(rows, columns)) for label, columns in PANELS]
    panels = [(label, columns) for label, columns in panels if columns]
    driven = {name: how for name, how in DRIVEN.items() if np.ptp(column(rows, name)) > 0.0}
    count = len(panels) + bool(driven)
    figure, axes = subplots(count, size=(8.4, 1.6 + 1.9 * count), sharex=True, squeeze=False)
    axes = axes[:, 0]
    panels = [("over the largest", driven)] * bool(driven) + panels
    for panel, (label, columns) in zip(axes, panels, strict=True):
        for name, (said, colour) in columns.items():
            values = column(rows, name)
            over = np.abs(values).max() if columns is driven else 1.0
            if name == "max_pressure_GPa":
                factor, unit = pressure_unit(values.max())
                label, over = f"{label}, {unit}", 1.0 / factor
            panel.plot(t, values / over, color=colour, label=said)
        panel.set_ylabel(label)
        if len(columns) > 1 or columns is driven:
            panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes[-1].set_xlabel(f"time, {in_s}")
    figure.suptitle(title_of_all(solution))
    return figure


def _there(rows, columns):
    """The columns that are there, and not nothing throughout."""
    return {name: how for name, how in columns.items() if name in rows[0] and np.any(column(rows, name))}
