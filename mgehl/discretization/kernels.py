"""The few loops that numpy cannot fuse, compiled by numba and cached."""

import numpy as np

from mgehl.discretization.compiled import compiled
from mgehl.discretization.mesh import HALO


@compiled()
def apply_jacobian(offsets, A, B, dP, dH, dH0, out):
    """out = A dP + B (dH + dH0); stencils (offsets, lines, nx), `dP` and `dH` ghosted."""
    lines, nx = out.shape
    for j in range(lines):
        out[j] = 0.0
        for k in range(len(offsets)):
            line, node = j + HALO + offsets[k, 0], offsets[k, 1]
            first, end = max(0, -node), min(nx, nx - node)
            here, there = slice(first, end), slice(first + node, end + node)
            _add(A[k, j, here], B[k, j, here], dP[line, there], dH[line, there], dH0, out[j, here])


@compiled()
def _add(a, b, p, h, h0, out):
    """out += a p + b (h + h0): of whole arrays, for a loop that runs on vectors."""
    for i in range(out.size):
        out[i] += a[i] * p[i] + b[i] * (h[i] + h0)


@compiled()
def distribute(w, distributive, share, omega, out, along_x=True, along_y=True):
    """out = omega Q w; `w` and `distributive` ghosted, `out` (lines, nx). Q as in
    `band_kernels.build_bands`; others take what is handed over along X and along Y, or one."""
    lines, nx = out.shape
    for j in range(lines):
        for i in range(nx):
            g = j + HALO
            spread = 0.0
            if along_y or distributive[g, i]:
                spread = w[g - 1, i] * distributive[g - 1, i] + w[g + 1, i] * distributive[g + 1, i]
            if along_x or distributive[g, i]:
                if i > 0:
                    spread += w[g, i - 1] * distributive[g, i - 1]
                if i < nx - 1:
                    spread += w[g, i + 1] * distributive[g, i + 1]
            out[j, i] = omega * (w[g, i] - share * spread)


@compiled()
def deflect_nearby(K, p, out):
    """out = deflection by the pressure `p`, ghosted, of a node and the eight around it; `out` (lines, nx).
    `K` holds the influence coefficients [line, node] of a node on itself and on those beside it, (2, 2)."""
    for j in range(len(out)):
        _deflect_line(K, p[j + HALO - 1], p[j + HALO], p[j + HALO + 1], out[j])


@compiled()
def _deflect_line(K, before, here, behind, out):
    """One line of it: a function of its own, for a loop that runs on vectors."""
    last = out.size - 1
    for i in range(1, last):
        corners = before[i - 1] + before[i + 1] + behind[i - 1] + behind[i + 1]
        out[i] = K[0, 0] * here[i] + K[0, 1] * (here[i - 1] + here[i + 1])
        out[i] += K[1, 0] * (before[i] + behind[i]) + K[1, 1] * corners
    for i, beside in ((0, 1), (last, last - 1)):
        out[i] = K[0, 0] * here[i] + K[0, 1] * here[beside] + K[1, 0] * (before[i] + behind[i])
        out[i] += K[1, 1] * (before[beside] + behind[beside])


@compiled()
def add_poiseuille(sides, P, conductance, flow):
    """flow -= conductance (P_E - P_W) through faces along an axis. `P` is ghosted, `sides` as of an
    `Axis`."""
    line_w, line_e, node_e = sides
    lines, faces = flow.shape
    for j in range(lines):
        west, east = P[j + line_w, :faces], P[j + line_e, node_e : node_e + faces]
        _subtract_flow(conductance[j], west, east, flow[j])


@compiled()
def _subtract_flow(conductance, west, east, flow):
    for i in range(flow.size):
        flow[i] -= conductance[i] * (east[i] - west[i])


@compiled()
def add_poiseuille_slopes(sides, P, closeness, by_eps_w, by_eps_e, eps_by, by_w, by_e):
    """What that flow changes by as the mobilities of W and E change, added to `by_w` and `by_e`.

    Nodes' mobilities rise by `eps_by`, ghosted, the face's with each of them by `by_eps_w`, `by_eps_e`: as
    the faces, or one line for all. `closeness` is 1/distance of the pressures, for each face of a line.
    """
    line_w, line_e, node_e = sides
    lines, faces = by_w.shape
    gradient = np.empty(faces)
    for j in range(lines):
        w, e, end = j + line_w, j + line_e, node_e + faces
        _gradient(P[w, :faces], P[e, node_e:end], closeness, gradient)
        share = j if len(by_eps_w) > 1 else 0
        _subtract_slopes(gradient, by_eps_w[share], eps_by[w, :faces], by_w[j])
        _subtract_slopes(gradient, by_eps_e[share], eps_by[e, node_e:end], by_e[j])


@compiled()
def _gradient(west, east, closeness, gradient):
    for i in range(gradient.size):
        gradient[i] = (east[i] - west[i]) * closeness[i]


@compiled()
def _subtract_slopes(gradient, by_eps, eps_by, slope):
    for i in range(slope.size):
        slope[i] -= gradient[i] * by_eps[i] * eps_by[i]


@compiled()
def add_of_faces(number, which, flow, cell, inflow):
    """Add flow/cell of the face before (`which` 0) or behind (1) each node along an axis of that `number`.
    Along X `flow` is (lines, nx - 1) and the ends of lines are left alone, along Y (lines + 1, nx)."""
    (lines, nx), factor = inflow.shape, 1.0 / cell
    for j in range(lines):
        if number:
            _add_product(flow[j, which : which + nx - 2], factor, inflow[j, 1 : nx - 1])
        else:
            _add_product(flow[j + which], factor, inflow[j])


@compiled()
def _add_product(flow, factor, inflow):
    for i in range(inflow.size):
        inflow[i] += flow[i] * factor


@compiled()
def flow_sources(inflow, P, along, across, source):
    """source = inflow - L P: the net inflow of a node without its Poiseuille flow L P; ends of lines are
    left. `P` is ghosted; `along` (lines, nx - 1) and `across` (lines + 1, nx) are `conductances`."""
    lines, nx = source.shape
    for j in range(lines):
        for i in range(1, nx - 1):
            g = j + HALO
            centre = P[g, i]
            source[j, i] = inflow[j, i] - (
                along[j, i - 1] * (P[g, i - 1] - centre)
                + along[j, i] * (P[g, i + 1] - centre)
                + across[j, i] * (P[g - 1, i] - centre)
                + across[j + 1, i] * (P[g + 1, i] - centre)
            )


@compiled()
def relax_cavitation(first, w, film, movable, source, conductances, carried, passes):
    """Solve the flow balance by `w`, ghosted: pressure of film, minus what is empty of a cavity; every
    other line from `first`. `source` is what flows into full gaps without the Poiseuille flow.

    Pairs of faces along X, (lines, nx - 1), and Y, (lines + 1, nx), are their `conductances` and what full
    gaps have `carried` through them; a cavity that nothing is carried out of counts as full. `movable`
    nodes take part, which are `film` or cavities by the sign of w. A line's set is iterated `passes` times:
    solve all nodes, then turn those of the other sign, which begin at 0. Returns how many did.
    """
    lines, nx = source.shape
    upper, changes = np.zeros(nx), 0
    for j in range(first, lines, 2):
        changed = 1
        for _ in range(passes):
            if changed:
                _solve_line(j, w, film, movable, source, conductances, carried, upper)
                changed = _turn_line(w[j + HALO], film[j], movable[j])
        changes += changed
    return changes


@compiled()
def _solve_line(j, w, film, movable, source, conductances, carried, upper):
    """Balance the movable nodes of a line by their w: a tridiagonal system."""
    along, across, along_x, along_y = conductances[0][j], conductances[1], carried[0][j], carried[1]
    before, here, behind = w[j + HALO - 1], w[j + HALO], w[j + HALO + 1]
    nx = here.size
    for i in range(1, nx - 1):
        upper[i] = 0.0
        if not movable[j, i]:
            continue
        west, east, south, north = along[i - 1], along[i], across[j, i], across[j + 1, i]
        by_w = west if film[j, i - 1] else along_x[i - 1]
        by_before = south if before[i] > 0.0 else along_y[j, i]
        net = source[j, i] + by_w * here[i - 1] + by_before * before[i] + north * max(behind[i], 0.0)
        leaves = west + east + south + north if film[j, i] else along_x[i] + along_y[j + 1, i]
        leaves -= by_w * upper[i - 1]
        if leaves > 0.0:
            here[i] = net / leaves
            upper[i] = east / leaves if film[j, i + 1] else 0.0
        else:  # shut in on all sides: its pressure stays 0; or a cavity that nothing leaves
            here[i] = 0.0 if film[j, i] else net + east * max(here[i + 1], 0.0)
    for i in range(nx - 2, 0, -1):
        here[i] += upper[i] * here[i + 1]


@compiled()
def _turn_line(w, film, movable):
    """Turn the movable nodes of a line whose w has the other's sign; return how many."""
    turned = 0
    for i in range(1, w.size - 1):
        if movable[i] and (w[i] < 0.0 if film[i] else w[i] > 0.0):
            film[i] = not film[i]
            w[i] = 0.0
            turned += 1
        elif movable[i]:
            w[i] = max(w[i], -1.0)
    return turned
