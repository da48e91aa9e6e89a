import numpy as np
import pytest
from handmade import flows, ghosted, walled

from mgehl.discretization.axes import axes_of
from mgehl.discretization.flow import E, W
from mgehl.discretization.fluid import Fluid
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, LUBRICATED


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
