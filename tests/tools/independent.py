"""What must hold of an answer that says "converged", asked in SI units of its fields alone.

The gap is that of paraboloids and of the deflection by Love's formula, or a plane's, summed node by node
without a Fourier transform. The pressure carries the load. Pressure and gap exclude each other. The contact
lies within its domain.
"""

from math import pi

import numpy as np

FILM_TOLERANCE = 1e-6
"""Breach of a gap that a converged answer may have, in units of H; of a pressure, in p_h."""


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
