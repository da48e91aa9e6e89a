import numpy as np
import pytest
from handmade import ghosted, walled

from mgehl.discretization.axes import axes_of
from mgehl.discretization.couette import E, W
from mgehl.discretization.faces import flows
from mgehl.discretization.fluid import Fluid
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, LUBRICATED


def test_one_line_is_a_slice_of_unit_width():
    line = Mesh(9, 1, (-4.0, 2.0), (0.0, 0.0))
    assert line.is_line
    assert (line.dX, line.dY, line.nodes) == (0.75, 1.0, 9)
    assert line.Y.tolist() == [0.0]
    assert line.nearest(0.1, 0.0) == (5, 0)


@pytest.mark.parametrize("ny, coarse", [(1, 1), (9, 5)])
def test_coarsened_takes_every_other_node_and_stays_one_line(ny, coarse):
    mesh = Mesh(17, ny, (-4.0, 2.0), (0.0, 0.0 if ny == 1 else 3.0), 0.7, (-3.9, 1.8))
    coarsened = mesh.coarsened()
    assert (coarsened.nx, coarsened.ny) == (9, coarse)
    assert coarsened.is_line == mesh.is_line
    assert (coarsened.x, coarsened.y, coarsened.k_e, coarsened.edges) == (mesh.x, mesh.y, 0.7, mesh.edges)
    np.testing.assert_allclose(coarsened.X, mesh.X[::2], rtol=1e-15)


def dirichlet_error(cells, half_cells, edges):
    """Largest error of P at inner nodes of H - (1 + X) P' = const, P = 0 at 0 and 1, by the flows.

    H = (1 + X) P' of P = sin(pi X). `half_cells` of the two ends lie outside, (first, last).
    """
    dX = 1.0 / (cells - 0.5 * sum(half_cells))
    x = (-0.5 * dX * half_cells[0], 1.0 + 0.5 * dX * half_cells[1])
    nx = cells + 1
    mesh = Mesh(nx, 1, x, (0.0, 0.0), edges=(0.0, 1.0) if edges else None)
    X = mesh.X[None, :]
    assert mesh.dX == pytest.approx(dX, rel=1e-12)
    eps = ghosted(1.0 + X)
    zero = np.zeros_like(eps)
    gap = eps * np.pi * np.cos(np.pi * mesh.X)
    fluid = Fluid(zero, gap, gap, zero + 1.0, zero, eps, zero, zero)
    status = np.full((1, nx), LUBRICATED)
    status[:, [0, -1]] = BOUNDARY
    (axis,), scheme = axes_of(mesh, (1.0, 0.0)), Scheme("2C")
    flow, _ = flows(fluid, walled(status), axis, scheme, linearised=True)
    # Flow in less flow out of the inner nodes, linear in their pressures.
    faces, matrix = np.arange(nx - 1), np.zeros((nx - 1, nx))
    matrix[faces, faces], matrix[faces, faces + 1] = flow.by_P[W][0], flow.by_P[E][0]
    inflow = -np.diff(matrix, axis=0)[:, 1:-1]
    P = np.linalg.solve(inflow, np.diff(flow.value[0]))
    return np.abs(P - np.sin(np.pi * mesh.X[1:-1])).max()


@pytest.mark.parametrize("half_cells", [(0, 0), (1, 0), (1, 1)], ids=["nodes", "first half", "both half"])
def test_pressure_at_an_edge_between_nodes_is_of_second_order(half_cells):
    errors = [dirichlet_error(cells, half_cells, edges=True) for cells in (32, 64, 128)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.05)


def test_axes_of_a_plane_mesh():
    """Couette flow k_e rho H and Poiseuille flow k_e^2 eps dP/dY cross a line [Liu eq. 26]."""
    mesh = Mesh(5, 9, (0.0, 2.0), (0.0, 2.0), k_e=0.5)
    x, y = axes_of(mesh, (0.6, 0.8))
    assert (x.number, x.cell, x.distance, x.couette) == (1, 0.5, 0.5, 0.6)
    assert (y.number, y.cell, y.distance, y.couette) == (0, 0.25, 0.25 / 0.25, 0.4)


def test_a_single_line_has_one_axis_and_edges_are_its_distances():
    (x,) = axes_of(Mesh(3, 1, (0.0, 2.0), (0.0, 0.0), edges=(0.5, 1.75)), (1.0, 0.0))
    assert x.cell == 1.0 and x.distance.tolist() == [0.5, 0.75]
