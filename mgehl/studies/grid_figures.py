"""Pictures of the grid study: Figures 11, 12 and 13."""

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.output.pictures.style import COLOURS, MARKS, subplots


def against_hertz(profiles):
    """Pressure minus Hertz and the residual gap in the contact, along X and along Y."""
    figure, panels = subplots(2, 2, size=(10.5, 6.4), sharex="col")
    for line, name in enumerate(("X = x/a, at Y = 0", "Y = y/b, at X = 0")):
        difference, gap = panels[:, line]
        for profile, colour in zip(profiles, COLOURS, strict=False):
            position = (profile.X, profile.Y)[line]
            contact = profile.status[line] == CONTACT
            label = f"{profile.nodes} nodes"
            values = np.where(contact, profile.difference[line], np.nan)
            difference.plot(position, values, color=colour, lw=0.9, label=label)
            gap.plot(position, np.where(contact, profile.film[line], np.nan), color=colour, lw=0.7)
        difference.set_yscale("symlog", linthresh=1e-4)
        gap.set_xlabel(name)
    panels[0, 0].set_ylabel("(p - p$_{Hertz}$)/p$_h$")
    panels[1, 0].set_ylabel("gap left in contact, nm")
    panels[0, 0].legend(frameon=False)
    figure.suptitle("0.005 mm/s: contact pressure against Hertz, and the residual gap")
    return figure


def before_interface(profiles):
    """Pressure and gap before the contact on Y = 0, pressure on linear and logarithmic axes."""
    figure, panels = subplots(1, 3, size=(13.0, 4.2))
    for profile, colour, mark in zip(profiles, COLOURS, MARKS, strict=False):
        contact = np.flatnonzero(profile.status[0] == CONTACT)
        shown = slice(0, contact[0] + 1)
        X, P, film = profile.X[shown], profile.P[0][shown], profile.film[0][shown]
        style = {"color": colour, "marker": mark, "ms": 3, "lw": 0.8, "label": f"{profile.nodes} nodes"}
        panels[0].plot(X[:-1], P[:-1], **style)
        panels[1].plot(X, film, **style)
        panels[2].semilogy(X, np.maximum(P, 1e-12), **style)
    for panel in panels:
        panel.set(xlim=(-1.25, -0.98), xlabel="X = x/a")
    panels[0].set(ylabel="P = p/p$_h$", title="a  fluid pressure")
    panels[1].set(ylim=(-5.0, 400.0), ylabel="gap, nm", title="b  gap")
    panels[2].set(ylim=(1e-7, 1.0), ylabel="P = p/p$_h$", title="c  with one node in contact")
    panels[0].legend(frameon=False)
    return figure
