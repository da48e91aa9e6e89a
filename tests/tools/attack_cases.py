"""Extreme configurations made up by chance, and what must hold of an answer that says "converged".

An answer is tested in SI units, from its fields alone. The gap is that of paraboloids and of the
deflection by Love's formula, or a plane's, summed node by node without a Fourier transform. The pressure
carries the load. Pressure and gap exclude each other. The contact lies within its domain.
"""

import json
import signal
from math import pi

import numpy as np
from attack_ground import LIMIT

FILM_TOLERANCE = 1e-6
"""Breach of a gap that a converged answer may have, in units of H; of a pressure, in p_h."""


def anywhere(chance, low, high):
    """A number of a range, its logarithm by chance."""
    return float(f"{10 ** chance.uniform(np.log10(low), np.log10(high)):.4g}")


def extreme(chance):
    """Tables of a configuration whose numbers are anywhere in their ranges, and beyond what is sensible."""
    kind = chance.choice(["point", "point", "point", "line"])
    contact, grid = _contact(chance, kind)
    tables = {
        "contact": contact,
        "lubricant": {
            "viscosity": anywhere(chance, 1e-4, 1e2),
            "pressure_viscosity": anywhere(chance, 1e-10, 1e-7),
        },
        "motion": {"speed": anywhere(chance, 1e-9, 1e2)},
        "grid": grid,
        "discretization": _discretization(chance),
        "solver": {"start": chance.choice(["film", "contact"]), "error": False, "max_steps": 20},
    }
    if kind == "point":
        tables["motion"]["angle"] = chance.uniform(0, 360)
        if chance.random() < 0.1:
            contact["deformation"] = "coated"
            tables["coating"] = _coating(chance)
    if chance.random() < 0.2:
        contact["boundary_film"] = anywhere(chance, 1e-11, 1e-8)
    if chance.random() < 0.35:
        tables["surface"] = _surface(chance)
    return tables


def _contact(chance, kind):
    """Tables of the bodies and of a domain that may cut them."""

    def ends():
        sides = [1.01, 1.05, 1.3, 2.0, 10.0, 60.0]
        return chance.choice(["auto", [-chance.choice(sides), chance.choice(sides)]])

    contact = {
        "kind": kind,
        "radius_x": anywhere(chance, 1e-4, 1.0),
        "reduced_modulus": anywhere(chance, 1e8, 1e12),
    }
    grid = {"nodes": 65, "x": ends()}
    if kind == "point":
        contact |= {
            "load": anywhere(chance, 1e-3, 1e5),
            "radius_y": contact["radius_x"] * anywhere(chance, 0.05, 20.0),
        }
        grid["y"] = ends()
    else:
        contact["load_per_length"] = anywhere(chance, 1e2, 1e7)
    return contact, grid


def _discretization(chance):
    found = {"contact_model": chance.choice(["lcic", "lcic", "lcic", "unified", "dry"])}
    if chance.random() < 0.5:
        means = ["arithmetic", "logarithmic", "linear-gap", "geometric"]
        found["face_mobility"] = chance.choice(means)
    if chance.random() < 0.2:
        found["couette"] = chance.choice(["1B", "2B", "3B", "3L", "2C"])
    if chance.random() < 0.2 and found["contact_model"] != "dry":
        found["cavitation"] = False
    return found


def _coating(chance):
    return {
        "thickness": anywhere(chance, 1e-8, 1e-3),
        "modulus": anywhere(chance, 1e8, 1e12),
        "poisson": chance.uniform(0.0, 0.5),
    }


def _surface(chance):
    kind = chance.choice(["waviness", "self-affine", "dent", "ridge"])
    height = anywhere(chance, 1e-10, 1e-5)
    body = chance.choice(["still", "still", "still", "moving"])
    if kind == "waviness":
        return {
            "kind": kind,
            "amplitude": height,
            "wavelength_x": anywhere(chance, 1e-6, 1e-2),
            "body": body,
        }
    if kind == "self-affine":
        short = anywhere(chance, 1e-6, 1e-3)
        waves = {"shortest_wavelength": short, "longest_wavelength": short * anywhere(chance, 1.0, 50.0)}
        return {"kind": kind, "rms": height, "seed": chance.randrange(1000), "body": body} | waves
    return {"kind": kind, "amplitude": height, "width": anywhere(chance, 1e-6, 1e-2), "body": body}


def wrong(solution):
    """What is wrong with a solution that says "converged", in a few words; "" where nothing is."""
    P, H = solution.fields.P, solution.fields.H
    if not (np.isfinite(P).all() and np.isfinite(H).all()):
        return "not finite"
    return _wrong_gap(solution) or _wrong_load(solution) or _wrong_pair(solution) or _wrong_place(solution)


def _wrong_gap(solution):
    nodes = np.random.default_rng(1).integers(0, solution.film.size, 12)
    scale = max(solution.contact.film_scale, np.abs(solution.film).max())
    if solution.config.contact.deformation == "half-space":
        off = solution.film.ravel()[nodes] - physical_gap(solution, nodes)
    else:
        off = (solution.fields.H.ravel()[nodes] - kernel_gap(solution, nodes)) * solution.contact.film_scale
    # The approach is free: sums of images, fitted in the axes of the solve, tell it to some 1e-6.
    off -= off.mean()
    return f"gap off by {np.abs(off).max() / scale:.1e}" if np.abs(off).max() > 1e-7 * scale else ""


def physical_gap(solution, nodes):
    """The gap of bare bodies at some nodes, in m, but for the approach."""
    section, x, y, p = solution.config.contact, solution.x, solution.y, solution.pressure
    dx, dy = np.diff(x).mean(), np.diff(y).mean() if len(y) > 1 else 1.0
    found = []
    for node in nodes:
        j, i = divmod(int(node), len(x))
        gap = x[i] ** 2 / (2.0 * section.radius_x)
        if len(y) > 1:
            gap += y[j] ** 2 / (2.0 * section.radius_y)
            cells = _cells(x - x[i], dx)[None, :], _cells(y - y[j], dy)[:, None]
            gap += 2.0 / (pi * section.reduced_modulus) * (p * _over_cells(_love, *cells)).sum()
        else:
            strips = np.diff(_logarithm(np.append(x - x[i] - dx / 2.0, x[-1] - x[i] + dx / 2.0)))
            gap -= 4.0 / (pi * section.reduced_modulus) * (p[0] * strips).sum()
        if solution.contact.surface is not None:
            gap -= float(np.squeeze(solution.contact.surface.height(x[i : i + 1], y[j : j + 1])))
        found.append(gap)
    return np.array(found)


def _cells(distance, width):
    """Ends of the cells about nodes at these distances: one more than there are nodes."""
    return np.append(distance - width / 2.0, distance[-1] + width / 2.0)


def _over_cells(integral, x, y):
    corner = integral(x, y)
    return corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]


def _love(x, y):
    """Integral of 1/r over [0, x] x [0, y]."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def _logarithm(x):
    """Integral of ln|x| from 0."""
    return x * (np.log(np.abs(x)) - 1.0)


def kernel_gap(solution, nodes):
    """The gap of layered bodies at some nodes, in units of H, by the program's own coefficients."""
    from mgehl.discretization.influence import influence_coefficients

    mesh, contact, P = solution.mesh, solution.contact, solution.fields.P
    K = influence_coefficients(mesh, contact.kernel, 0, mesh.ny)
    rows, columns = np.indices(P.shape)
    found = []
    for node in nodes:
        j, i = divmod(int(node), mesh.nx)
        deflection = (K[np.abs(rows - j), np.abs(columns - i)] * P).sum()
        bodies = np.squeeze(contact.undeformed_gap(mesh.X[i : i + 1], mesh.Y[j : j + 1]))
        found.append(deflection + bodies + solution.H0)
    return np.array(found)


def _wrong_load(solution):
    section, x, y = solution.config.contact, solution.x, solution.y
    load = solution.pressure.sum() * np.diff(x).mean()
    asked = section.load_per_length
    if len(y) > 1:
        load, asked = load * np.diff(y).mean(), section.load
    return f"load off by {load / asked - 1.0:.1e}" if not abs(load / asked - 1.0) <= 1e-6 else ""


def _wrong_pair(solution):
    """Pressure and gap: where there is one of them, and how large it may be."""
    from mgehl.discretization.status import CAVITATED, CONTACT

    section, status = solution.config.discretization, solution.fields.status
    P, film, scale = solution.fields.P, solution.film, solution.contact.film_scale
    layers = solution.config.contact.boundary_film
    contact = P > 0.0 if solution.is_dry else status == CONTACT
    kept, room = (0.0, 0.0) if solution.is_dry else (layers, 0.0 if layers else section.film_threshold)
    tears = section.cavitation is not False
    if (tears and P.min() < -FILM_TOLERANCE) or P[contact].min(initial=0.0) < -FILM_TOLERANCE:
        return f"tension {P.min():.1e}"
    if np.abs(P[status == CAVITATED]).max(initial=0.0) > 0.0:
        return "pressure in a cavity"
    if section.contact_model == "unified":
        return ""
    if film.min() < kept - FILM_TOLERANCE * scale:
        return f"overlap {film.min() / scale:.1e}"
    off = np.abs(film[contact] - kept).max(initial=0.0)
    return f"contact with a gap of {off / scale:.1e}" if off > room + FILM_TOLERANCE * scale else ""


def _wrong_place(solution):
    """The contact must lie within its domain, on four nodes at the least."""
    P, H, is_line = solution.fields.P, solution.fields.H, solution.mesh.is_line
    ring, beside, edge = (P[0, [0, -1]], P[0, [1, -2]], H[0, [0, -1]]) if is_line else (
        np.r_[P[0], P[-1], P[:, 0], P[:, -1]],
        np.r_[P[1], P[-2], P[:, 1], P[:, -2]],
        np.r_[H[0], H[-1], H[:, 0], H[:, -1]],
    )  # fmt: skip
    if np.abs(ring).max() > 0.0 or beside.max() > 0.0101 * P.max() or edge.min() < 0.0:
        return f"cut by the domain: {beside.max() / P.max():.2g} of the pressure, gap {edge.min():.2g}"
    loaded = P > 0.0 if solution.is_dry else 0.1 * P.max() <= P
    if loaded.any(axis=0).sum() < 4 or (not is_line and loaded.any(axis=1).sum() < 4):
        return "too few nodes"
    return ""


def attack_cases(count, chance, _folder, findings):
    """Extreme configurations; a verdict "converged" must stand an independent test.

    `count` of them are solved; those that are refused come besides.
    """

    def alarm(*_):
        raise TimeoutError

    signal.signal(signal.SIGALRM, alarm)
    solved = 0
    for _ in findings.rounds(20 * count):
        tables = extreme(chance)
        signal.alarm(int(LIMIT))
        try:
            solved += _attack(tables, findings)
        except TimeoutError:
            solved += 1
            findings.tried(f"more than {LIMIT:.0f} s")
            print("SLOW", json.dumps(tables), flush=True)
        except Exception as error:
            findings.say(f"{type(error).__name__}: {error}: {json.dumps(tables)}")
        finally:
            signal.alarm(0)
        if solved == count:
            return


def _attack(tables, findings):
    """Solve one; whether it was not refused."""
    import mgehl
    from mgehl.config import config_from_tables

    try:
        solution = mgehl.solve(config_from_tables(tables))
    except mgehl.UserError as error:
        findings.tried("refused")
        if "\n" in str(error):
            findings.say(f"lines: {error}: {json.dumps(tables)}")
        return False
    result = solution.result
    model = "dry, " if solution.is_dry else ""
    said = "converged" if result.converged else "settled" if result.settled else "not converged"
    findings.tried(model + said)
    if result.converged and (found := wrong(solution)):
        findings.say(f"false: {found}: {json.dumps(tables)}")
    return True
