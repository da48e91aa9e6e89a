"""The balance of the oil in every node, reckoned from the files of a run alone, in SI units.

Nothing of mgehl computes here: files are read by h5py and tomllib, laws and flows are written anew.
Contacts with layers, or with a linear gap, whose surfaces move along +x, by Barus's or Roelands' law and
Dowson's.

    python tests/tools/balance.py RUN ...
"""

import json
import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np

FILM, CAVITY, CONTACT = 1, 2, 3


def balance(run):
    """What the nodes of a run let out more than in, over what enters the Hertz ellipse: {name: share}.

    "leaves" is the share of what enters that leaves again, "node" the largest of a single node, whatever
    its sign, and "film", "cavity", "contact" the sums over nodes of one kind.
    """
    along, across, X, Y, status = flows(Path(run))
    inflow = np.zeros(status.shape)
    inflow[:, 1:] += along
    inflow[:, :-1] -= along
    inflow[1:] += across
    inflow[:-1] -= across
    inside = X**2 + Y[:, None] ** 2 <= 1.0
    into = np.concatenate([_into(inside, along), _into(inside.T, across.T)])
    enters, leaves = into[into > 0.0].sum(), -into[into < 0.0].sum()
    lines = slice(1, -1) if len(status) > 1 else slice(None)
    inner, kind_of = inflow[lines, 1:-1], status[lines, 1:-1]
    kinds = {"film": FILM, "cavity": CAVITY, "contact": CONTACT}
    made = {name: -inner[kind_of == kind].sum() / enters for name, kind in kinds.items()}
    return {"leaves": leaves / enters, "node": np.abs(inner).max() / enters, **made}


def _into(inside, flow):
    """Flow through the faces between columns at the edge of `inside`, positive into it."""
    enters, leaves = inside[:, 1:] & ~inside[:, :-1], inside[:, :-1] & ~inside[:, 1:]
    return np.concatenate([flow[enters], -flow[leaves]])


def flows(run):
    """Oil in m^3/s at ambient density through the faces of a run along x and along y, with X, Y, status."""
    with (run / "configuration.toml").open("rb") as file:
        config = tomllib.load(file)
    if config["motion"].get("angle"):
        raise SystemExit(f"{run}: here surfaces move along +x")
    scheme = json.loads((run / "result.json").read_text())["recipe"]["couette"]
    with h5py.File(run / "fields.h5") as file:
        names = "pressure", "P", "p", "film", "filling", "status", "x", "y", "X", "Y"
        pressure, P, p, film, filling, status, x, y, X, Y = (file[name][:] for name in names)
    fluid = p * (pressure.max() / P.max()) + config["contact"].get("ambient_pressure", 0.0)
    # Of a line contact a metre.
    dx, dy = (np.ptp(each) / (len(each) - 1) if len(each) > 1 else 1.0 for each in (x, y))
    layers = max(config["contact"]["boundary_film"], config["discretization"]["film_threshold"])
    oil = config["lubricant"]
    gap = np.where(status == CONTACT, layers, film)
    rho = 1.0 + 0.6e-9 * fluid / (1.0 + 1.7e-9 * fluid)
    eased = np.exp(-_thicker(oil, fluid))
    carried = config["motion"]["speed"] * _carried(scheme, rho * (gap - layers))
    # What a full cavity would send on, times its filling.
    carried *= np.where(status == CAVITY, filling, 1.0)[:, :-1]
    along, across = (
        (fluid[W] - fluid[E]) * 0.5 * (rho[W] + rho[E]) * _mobility(eased[W], eased[E], gap[W], gap[E])
        for W, E in (
            ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
            (slice(None, -1), slice(1, None)),
        )
    )
    eta = 12.0 * oil["viscosity"]
    return dy * (carried + along / (eta * dx)), dx * across / (eta * dy), X, Y, status


def _thicker(oil, p):
    """ln(eta/eta_0) by Barus's law or Roelands'."""
    law, alpha = oil.get("viscosity_law", "barus"), oil["pressure_viscosity"]
    if law == "barus":
        return alpha * p
    if law != "roelands":
        raise SystemExit(f"viscosity_law = {law}: here oils are of Barus's law or Roelands'")
    most = np.log(oil["viscosity"]) + 9.67
    return most * ((1.0 + 5.1e-9 * p) ** (alpha / (5.1e-9 * most)) - 1.0)


def _carried(scheme, content):
    """`content` of full gaps at the faces between columns, by 1B or 3L."""
    west, east = content[:, :-1], content[:, 1:]
    if scheme == "1B":
        return west.copy()
    face = 0.5 * (west + east)
    face[:, 1:] = east[:, 1:] / 3.0 + 5.0 / 6.0 * west[:, 1:] - west[:, :-1] / 6.0
    return np.clip(face, 0.5 * west, 1.5 * west)


def _mobility(a, b, g, h):
    """exp(-alpha p) h^3 of faces whose gap is linear from g to h, and the first from a to b."""
    d = np.log(b / a)
    near = np.abs(d) < 1e-4
    d = np.where(near, 1.0, d)
    mean = np.where(near, 0.5 * (a + b) - (b - a) ** 2 / (6.0 * (a + b)), (b - a) / d)
    return 2.0 * mean * (g * h) ** 2 / (g + h)


if __name__ == "__main__":
    for run in sys.argv[1:]:
        print(run, *(f"{name} {share:.1e}" for name, share in balance(run).items()))
