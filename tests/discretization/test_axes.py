"""Faces and nodes along X and along Y by the same words."""

from mgehl.discretization.axes import axes_of
from mgehl.discretization.mesh import Mesh


def test_axes_of_a_plane_mesh():
    """Couette flow k_e rho H and Poiseuille flow k_e^2 eps dP/dY cross a line [Liu eq. 26]."""
    mesh = Mesh(5, 9, (0.0, 2.0), (0.0, 2.0), k_e=0.5)
    x, y = axes_of(mesh, (0.6, 0.8))
    assert (x.number, x.cell, x.distance, x.couette) == (1, 0.5, 0.5, 0.6)
    assert (y.number, y.cell, y.distance, y.couette) == (0, 0.25, 0.25 / 0.25, 0.4)


def test_a_single_line_has_one_axis_and_edges_are_its_distances():
    (x,) = axes_of(Mesh(3, 1, (0.0, 2.0), (0.0, 0.0), edges=(0.5, 1.75)), (1.0, 0.0))
    assert x.cell == 1.0 and x.distance.tolist() == [0.5, 0.75]
