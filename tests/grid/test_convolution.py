import numpy as np
import pyfftw
import pytest

from mgehl.discretization.influence import influence_coefficients


def double_sum(mesh, kernel, P):
    """Deflection of every node by the pressure at every node, without any transform."""
    K = influence_coefficients(mesh, kernel)
    j, i = np.arange(mesh.ny), np.arange(mesh.nx)
    along = np.abs(i[:, None] - i)
    deflection = np.zeros_like(P)
    for line in j:
        lines = K[np.abs(j - line)]
        deflection[line] = np.einsum("lik,lk->i", lines[:, along], P)
    return deflection


def random_pressure(mesh):
    P = np.zeros((mesh.ny, mesh.nx))
    P[1:-1, 1:-1] = np.random.default_rng(4).random((mesh.ny - 2, mesh.nx - 2))
    return P


@pytest.mark.parametrize(
    "ratio, grid",
    [(1.0, {"nodes": 33}), (2.0, {"nodes": 33}), (0.5, {"nodes": 33}),
     (1.0, {"nodes": 33, "x": (-4.5, 1.5), "y": (-1.5, 1.5)}),
     (2.0, {"nodes": 65, "ny": 33, "coarsest": 65})],
    ids=["circle", "wide", "long", "oblong-domain", "oblong-grid"],
)  # fmt: skip
def test_convolution_is_the_double_sum(paper_contact, make_hierarchy, ratio, grid):
    contact = paper_contact(radius_y=ratio * 12.7e-3)
    assert (contact.k_e == 1.0) == (ratio == 1.0)
    hierarchy = make_hierarchy(contact, **grid)
    mesh = hierarchy.grids[-1].mesh
    P = random_pressure(mesh)
    expected = double_sum(mesh, contact.kernel, P)
    deflection = hierarchy.deflections[-1](P)
    assert np.max(np.abs(deflection - expected)) < 1e-12 * np.max(np.abs(expected))


@pytest.mark.parametrize("nodes", [33, 257])
def test_convolution_on_one_line_is_the_dense_product(line_contact, make_line, nodes):
    """With the logarithmic kernel, which reaches from end to end of the line and changes sign."""
    hierarchy = make_line(nodes)
    K = influence_coefficients(hierarchy.grids[-1].mesh, line_contact.kernel)[0]
    i = np.arange(nodes)
    P = np.random.default_rng(4).random((1, nodes))
    P[:, [0, -1]] = 0.0
    expected = K[np.abs(np.subtract.outer(i, i))] @ P[0]
    assert K.min() < 0.0 < K.max()
    deflection = hierarchy.deflections[-1](P)
    assert deflection.shape == (1, nodes)
    assert np.max(np.abs(deflection[0] - expected)) < 1e-12 * np.max(np.abs(expected))


def test_a_long_line_is_convolved_by_the_same_plan_in_every_run(make_line):
    """A plan that is timed would be another one on a busy machine, with other last digits."""
    P = np.random.default_rng(4).random((1, 4097))
    found = []
    for _ in range(4):
        pyfftw.forget_wisdom()
        found.append(make_line(4097, coarsest=4097).deflections[-1](P).copy())
    for other in found[1:]:
        np.testing.assert_array_equal(other, found[0])


class TestInverse:
    """Of surfaces that repeat themselves; as a preconditioner it must be symmetric and positive."""

    @pytest.fixture
    def deflection(self, paper_contact, make_hierarchy):
        return make_hierarchy(paper_contact(radius_y=25.4e-3), 33).deflections[0]

    def test_it_inverts_the_sum_over_a_period(self, deflection, paper_contact):
        """The kernel between nodes that are at most half a period apart, as a dense matrix."""
        grid = deflection.grid
        K = influence_coefficients(grid.mesh, paper_contact(radius_y=25.4e-3).kernel)
        apart = np.abs(np.subtract.outer(np.arange(32), np.arange(32)))
        apart = np.minimum(apart, 32 - apart)
        P = random_pressure(grid.mesh)
        P[:-1, :-1] -= P[:-1, :-1].mean()
        D = np.zeros((33, 33))
        D[:-1, :-1] = np.einsum("jlik,lk->ji", K[apart][:, :, apart], P[:-1, :-1])
        np.testing.assert_allclose(deflection.inverted(D)[:-1, :-1], P[:-1, :-1], atol=1e-11)

    def test_it_is_symmetric_and_positive(self, deflection):
        random = np.random.default_rng(5)
        one, other = (random.random((33, 33)) * ~deflection.grid.boundary() for _ in range(2))
        of_one = deflection.inverted(one).copy()
        assert np.vdot(of_one, other) == pytest.approx(np.vdot(one, deflection.inverted(other)), rel=1e-12)
        assert np.vdot(one, of_one) > 0.0
