import numpy as np
import pytest

from mgehl.model.coating import Coating

E_REDUCED = 219.78e9
T = 30e-6
KT = np.array([0.01, 0.1, 0.5, 1.0, 2.0, 5.0])


def coating(modulus, poisson=0.3, substrate=None, substrate_poisson=0.3, thickness=T):
    return Coating(thickness, modulus, poisson, substrate, substrate_poisson, E_REDUCED)


class Stresses:
    """Plane strain, everything as exp(ix): Airy's function z^n exp(s z), n = 0 or 1, s = +-1.

    Columns of sigma_zz, sigma_xz, u_x and u_z at depth z, for a shear modulus mu; wave number 1.
    """

    def __init__(self, mu, nu):
        self.mu, self.nu = mu, nu

    def column(self, n, s, z):
        phi = z**n * np.exp(s * z)
        first = (s * z + 1.0) * np.exp(s * z) if n else s * phi
        second = (z + 2.0 * s) * np.exp(s * z) if n else phi
        integral = (z * s - 1.0) * np.exp(s * z) if n else s * phi
        szz, sxz, sxx = -phi, -1j * first, second
        ux = ((1.0 - self.nu) * sxx - self.nu * szz) / (2.0 * self.mu * 1j)
        uz = (-(1.0 - self.nu) * integral - self.nu * first) / (2.0 * self.mu)
        return np.array([szz, sxz, ux, uz])


def deflection_of_a_layer(kt, layer, substrate):
    """u_z of the surface under sigma_zz = -1, the layer bonded to the substrate at depth kt."""
    matrix = np.zeros((6, 6), complex)
    waves = [(0, -1.0), (1, -1.0), (0, 1.0), (1, 1.0)]
    for c, wave in enumerate(waves):
        matrix[:2, c] = layer.column(*wave, 0.0)[:2]
        matrix[2:, c] = layer.column(*wave, kt)
    for c, wave in enumerate(waves[:2]):
        matrix[2:, 4 + c] = -substrate.column(*wave, kt)
    amplitudes = np.linalg.solve(matrix, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    return sum(a * layer.column(*wave, 0.0)[3] for a, wave in zip(amplitudes[:4], waves, strict=True)).real


@pytest.mark.parametrize(
    "ratio, nu, substrate_nu", [(4.0, 0.25, 0.33), (0.25, 0.2, 0.45), (0.01, 0.49, 0.3), (30.0, 0.1, 0.2)]
)
def test_compliance_is_that_of_the_elastic_layer(ratio, nu, substrate_nu):
    """`ratio` of the shear moduli; a half-space of the layer's gives (1 - nu)/mu."""
    E = 200e9
    modulus = ratio * E * (1.0 + nu) / (1.0 + substrate_nu)
    layered = coating(modulus, nu, E, substrate_nu)
    for kt in KT:
        expected = deflection_of_a_layer(kt, Stresses(ratio, nu), Stresses(1.0, substrate_nu))
        expected /= (1.0 - nu) / ratio
        assert layered.layer_compliance(kt) == pytest.approx(expected, rel=1e-11)


def test_a_layer_of_the_substrate_s_material_is_none():
    same = coating(200e9, 0.3, 200e9, 0.3)
    np.testing.assert_allclose(same.compliance(KT / T), 1.0, rtol=0.0, atol=1e-14)


def test_a_substrate_that_is_softer_than_both_bodies_is_refused():
    coating(50e9, substrate=E_REDUCED * 0.91 / 2.0)  # the other body rigid
    with pytest.raises(ValueError, match="substrate's modulus is at least 1e"):
        coating(50e9, substrate=0.99 * E_REDUCED * 0.91 / 2.0)
