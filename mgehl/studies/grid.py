"""Full contact and full film on ever finer grids  [Liu figs. 11-13].

What stays from grid to grid belongs to the problem; what changes belongs to the grid.
"""

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.model.hertz import hertz_pressure
from mgehl.output.pictures.style import COLOURS, MARKS, subplots
from mgehl.studies.columns import told
from mgehl.studies.limits import limit_said, order_of_errors
from mgehl.studies.study import PAPER, merged, papers_grid

NODES = (257, 513, 1025)
CONTACT_SPEED, FILM_SPEED = 5e-6, 7.5e-3
"""m/s: the paper's full contact and its full film."""

INSIDE = 0.9
"""Radius in a within which the contact pressure is compared: at the edge it is a square root."""


def run(study):
    """Solve both cases on every grid; write the tables `contact` and `film` and Figures 11 to 13."""
    nodes = study.asked.nodes or NODES
    dry = [each for _, each in study.solved(_cases(nodes, CONTACT_SPEED, "contact"), must_converge=False)]
    wet = [each for _, each in study.solved(_cases(nodes, FILM_SPEED, "film"), must_converge=False)]
    profiles = study.comm.bcast([Profile(each) for each in dry] if study.first else None)
    study.write_table("contact", _contact_rows(dry, profiles))
    study.write_table("film", _film_rows(wet))
    study.draw("figures-11-12", against_hertz, profiles)
    study.draw("figure-13", before_interface, profiles)


def _cases(nodes, speed, start):
    solver = {"start": start} | ({"squeeze": 3.0} if start == "film" else {})
    case = merged(PAPER, {"motion": {"speed": speed}, "solver": solver})
    return {
        f"{n} nodes, {1e3 * speed:g} mm/s, from {start}": merged(case, {"grid": papers_grid(n)})
        for n in nodes
    }


class Profile:
    """Centre lines of a solution in full contact, along X and along Y."""

    def __init__(self, solution):
        mesh, fields = solution.mesh, solution.fields
        i, j = mesh.centre
        self.nodes, self.X, self.Y = mesh.nx, mesh.X, mesh.Y
        nm = 1e9 * solution.contact.film_scale
        self.P = fields.P[j], fields.P[:, i]
        self.film = fields.H[j] * nm, fields.H[:, i] * nm
        self.status = fields.status[j], fields.status[:, i]
        difference = fields.P - hertz_pressure(mesh.X[None, :], mesh.Y[:, None])
        self.difference = difference[j], difference[:, i]
        inside = mesh.X[None, :] ** 2 + mesh.Y[:, None] ** 2 < INSIDE**2
        self.largest_inside = float(np.abs(difference[inside]).max())
        self.largest = float(np.abs(difference).max())

    @property
    def before_contact(self):
        """Fluid pressure at the last node before the contact on Y = 0."""
        contact = np.flatnonzero(self.status[0] == CONTACT)
        return self.P[0][contact[0] - 1] if len(contact) else float("nan")


def _contact_rows(solutions, profiles):
    before = None
    for solution, profile in zip(solutions, profiles, strict=True):
        order = f"{order_of_errors(before.largest_inside, profile.largest_inside):.2f}" if before else ""
        yield _common(solution) | {
            **told(solution.result, "contact on X, on Y, contact/Hertz area:.5f, load on contact:.6f"),
            "P - Hertz inside 0.9 a": f"{profile.largest_inside:.2e}",
            "order": order,
            "anywhere": f"{profile.largest:.2e}",
            "P before contact": f"{profile.before_contact:.2e}",
            **told(solution.result, "largest gap nm"),
        }
        before = profile


def _film_rows(solutions):
    results = [each.result for each in solutions]
    for k, solution in enumerate(solutions):
        yield _common(solution) | {
            **told(solution.result, "central nm, minimum nm, contact nodes"),
            "central: limit, order": _limit(results[: k + 1], "central_film_nm"),
            "minimum: limit, order": _limit(results[: k + 1], "minimum_film_nm"),
        }


def _common(solution):
    """Columns of both tables."""
    return {
        "grid": str(solution.mesh.nx),
        **told(solution.result, "settled, Eq. 2 broken, inlet cells"),
        "verdict": solution.result.resolution.verdict,
        **told(solution.result, "residual, convolutions, wall s"),
    }


def _limit(found, film):
    """Richardson's limit and order from the last three grids, if all have a full film and the order is
    one."""
    last = found[-3:]
    if len(last) < 3 or any(each.contact.nodes for each in last):
        return ""
    return limit_said([getattr(each, film) for each in last], "{:.3f}, {:.2f}")


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
    panels[0, 0].legend()
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
    panels[0].legend()
    return figure
