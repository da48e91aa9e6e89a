import numpy as np
import pytest

from mgehl.model.surface import Dent, Ridge, SelfAffine, Surface, Waviness, summed

ROUGH = SelfAffine(1e-7, 10e-6, 200e-6, hurst=0.8, seed=3)
HEIGHTS = [-4.740181670e-08, 8.682899262e-08, -1.219055291e-07]


def on_nodes(surface, x, y):
    return surface.height(x[None, :], y[:, None])


class TestWaviness:
    def test_it_is_the_product_of_cosines_in_its_own_axes(self):
        waves = Waviness(2e-7, 1e-4, 3e-4, angle=30.0, x=1e-5, y=-2e-5)
        x, y = np.array([0.0, 3e-5, -8e-5]), np.array([1e-5, 0.0, 2e-4])
        c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
        along, across = c * (x - 1e-5) + s * (y + 2e-5), c * (y + 2e-5) - s * (x - 1e-5)
        expected = 2e-7 * np.cos(2 * np.pi * along / 1e-4) * np.cos(2 * np.pi * across / 3e-4)
        np.testing.assert_allclose(waves.height(x, y), expected, rtol=0, atol=1e-21)

    def test_without_one_length_nothing_changes_that_way(self):
        ridges = Waviness(2e-7, None, 1e-4)
        assert (ridges.height(0.0, 0.0), ridges.height(5e-5, 5e-5)) == pytest.approx((2e-7, -2e-7))
        assert not ridges.varies_along((1.0, 0.0)) and ridges.varies_along((0.6, 0.8))


class TestDentAndRidge:
    def test_a_dent_is_deepest_in_its_middle_and_has_a_shoulder(self):
        dent = Dent(1e-6, 1e-4, x=2e-5, y=-1e-5)
        assert dent.height(2e-5, -1e-5) == -1e-6
        assert dent.height(6e-5, -1e-5) > 0.0
        half = -1e-6 * 10.0**-0.4 * np.cos(0.4 * np.pi)
        assert dent.height(2e-5, 1e-5) == pytest.approx(half)

    def test_a_ridge_is_a_peak_and_the_same_along_itself(self):
        ridge, c, s = Ridge(1e-6, 1e-4, angle=30.0), np.cos(np.pi / 6), 0.5
        assert ridge.height(-s, c) == pytest.approx(1e-6) and abs(ridge.height(c * 1e-4, s * 1e-4)) < 1e-15
        assert not ridge.varies_along((-s, c)) and ridge.varies_along((c, s))

    @pytest.mark.parametrize("surface", [Dent(1e-6, 1e-4), Ridge(1e-6, 1e-4, angle=90.0)])
    def test_the_shortest_wave_bends_as_the_middle_does(self, surface):
        h, y = 1e-8, np.array([-1e-8, 0.0, 1e-8])
        below, middle, above = surface.height(0.0, y)
        bend = abs(below - 2.0 * middle + above) / h**2
        assert 2.0 * np.pi * np.sqrt(1e-6 / bend) == pytest.approx(surface.shortest(y, y), rel=1e-4)


class TestSelfAffine:
    @pytest.mark.parametrize("nodes", [180, 256])
    def test_rms_over_a_period_is_exact(self, nodes):
        line = ROUGH.period / nodes * np.arange(nodes)
        heights = on_nodes(ROUGH, line, line)
        assert heights.std() == pytest.approx(1e-7, rel=1e-12)
        assert abs(heights.mean()) < 1e-20

    def test_heights_are_the_same_on_129_and_257_nodes(self):
        coarse, fine = (np.linspace(-4e-4, 3e-4, nodes) for nodes in (129, 257))
        np.testing.assert_allclose(
            on_nodes(ROUGH, coarse, coarse), on_nodes(ROUGH, fine, fine)[::2, ::2], rtol=0, atol=1e-19
        )

    def test_heights_are_those_of_this_seed_on_every_machine(self):
        x = np.array([0.0, 1e-4, 2e-4])
        np.testing.assert_allclose(ROUGH.height(x, 0.5 * x), HEIGHTS, rtol=1e-6)
        other = SelfAffine(1e-7, 10e-6, 200e-6, seed=4)
        assert abs(other.height(0.0, 0.0) - HEIGHTS[0]) > 1e-9

    def test_its_spectrum_is_the_power_law_between_the_cut_offs(self):
        nodes = 256
        line = ROUGH.period / nodes * np.arange(nodes)
        power = np.abs(np.fft.fft2(on_nodes(ROUGH, line, line))) ** 2
        m = np.fft.fftfreq(nodes, 1.0 / nodes)
        q = np.hypot(m[None, :], m[:, None])
        inside = (q >= 4.0) & (q <= 80.0)
        assert power[~inside].max() < 1e-20 * power.max()
        even = power[inside] * q[inside] ** 3.6 / 4.0**3.6
        np.testing.assert_allclose(even / power[0, 4], 1.0, rtol=1e-6)

    def test_filtered_it_has_the_long_waves_alone(self):
        nodes = 256
        line = ROUGH.period / nodes * np.arange(nodes)
        seen = np.fft.fft2(on_nodes(ROUGH.filtered((4e-5, 2e-5), line, line), line, line))
        full = np.fft.fft2(on_nodes(ROUGH, line, line))
        m = np.abs(np.fft.fftfreq(nodes, 1.0 / nodes))
        kept = (m[None, :] <= 20.0) & (m[:, None] <= 40.0)
        np.testing.assert_allclose(seen, np.where(kept, full, 0.0), rtol=0, atol=1e-12 * np.abs(full).max())

    @pytest.mark.parametrize("angle, along, across", [(0.0, 1, 0), (90.0, 0, 1)])
    def test_features_are_longer_along_the_angle(self, angle, along, across):
        grooves = SelfAffine(1e-7, 20e-6, 100e-6, aspect=6.0, angle=angle)
        line = grooves.period / 240 * np.arange(240)
        heights = on_nodes(grooves, line, line)
        steps = [np.diff(heights, axis=axis).std() for axis in (0, 1)]
        assert heights.std() == pytest.approx(1e-7, rel=1e-12)
        assert steps[across] > 4.0 * steps[along]


def test_surfaces_add_up():
    parts = Waviness(2e-7, 1e-4, None), Ridge(1e-6, 2e-4)
    both, x = summed(parts), np.linspace(-1e-4, 1e-4, 7)
    np.testing.assert_array_equal(both.height(x, 0.0), parts[0].height(x, 0.0) + parts[1].height(x, 0.0))
    assert both.shortest(x, x) == parts[0].shortest(x, x) < parts[1].shortest(x, x)
    turned = summed((parts[0], Ridge(1e-6, 2e-4, angle=90.0)))
    assert turned.varies_along((0.0, 1.0)) and not both.varies_along((0.0, 1.0))
    assert summed([ROUGH]) is ROUGH and summed([]) is None


class Plain(Surface):
    def __init__(self, function):
        self._function = function

    def height(self, x, y):
        return self._function(x, y)


class TestWhatIsNotKnown:
    nodes = np.linspace(-3e-4, 3e-4, 257)

    @pytest.mark.parametrize("wave", [2e-5, 1e-4])
    def test_the_shortest_wave_is_told_from_the_heights(self, wave):
        plain = Plain(lambda x, y: 1e-7 * np.cos(2 * np.pi * x / wave) + 0.1 * x + 0.0 * y)
        assert plain.shortest(self.nodes, self.nodes) == pytest.approx(wave, rel=0.08)

    @pytest.mark.parametrize("seed", [1, 2])
    def test_of_many_waves_it_is_near_the_cut_off(self, seed):
        rough = SelfAffine(1e-7, 20e-6, 400e-6, seed=seed)
        found = Surface.shortest(rough, self.nodes, self.nodes)
        assert 0.9 * 20e-6 < found < 1.25 * 20e-6

    def test_noise_has_waves_of_two_nodes_and_a_plane_none(self):
        noise = np.random.default_rng(0).standard_normal((257, 257))
        step = self.nodes[1] - self.nodes[0]
        noisy, plane = Plain(lambda x, y: noise), Plain(lambda x, y: 1.0 + x + y)
        assert 2.0 * step < noisy.shortest(self.nodes, self.nodes) < 2.3 * step
        assert plane.shortest(self.nodes, self.nodes) == np.inf

    def test_heights_whose_squares_are_nothing_have_no_waves(self):
        """Such as the far tail of a dimple beyond the domain."""
        tail = Plain(lambda x, y: 1e-200 * np.cos(2 * np.pi * x / 1e-4) + 0.0 * y)
        assert tail.shortest(self.nodes, self.nodes) == np.inf

    def test_a_coarse_grid_sees_it_smoothed_and_not_sampled(self):
        """Samples of a wave of two thirds of a coarse cell would be a wave of two cells."""
        coarse = self.nodes[::32]
        cell = coarse[1] - coarse[0]
        short = Plain(lambda x, y: np.cos(2 * np.pi * x / (2.0 / 3.0 * cell)) + 0.0 * y)
        assert np.ptp(on_nodes(short, coarse, coarse)) > 1.9
        smooth = short.filtered((4.0 * cell, 4.0 * cell), self.nodes, self.nodes)
        assert np.abs(on_nodes(smooth, coarse, coarse)[:, 2:-2]).max() < 0.01

    def test_parts_of_a_grid_get_what_the_whole_gets(self):
        """Ranks have lines of their own, down to a single one, and axes may be turned."""
        coarse = self.nodes[::16]
        plain = Plain(lambda x, y: np.cos(1e5 * x + 2e5 * y) + 1e3 * x)
        smooth = plain.filtered((1e-4, 1e-4), self.nodes, self.nodes)
        whole = on_nodes(smooth, coarse, coarse)
        for lines in (slice(0, 5), slice(5, 6), slice(6, None)):
            part = on_nodes(smooth, coarse, coarse[lines])
            np.testing.assert_allclose(part, whole[lines], rtol=0, atol=1e-12)
        np.testing.assert_allclose(smooth.height(coarse[:, None], coarse[None, :]), whole.T, atol=1e-14)
        np.testing.assert_allclose(on_nodes(smooth, coarse[::-1], coarse), whole[:, ::-1], atol=1e-12)
        ramp, wave = Plain(lambda x, y: 1e3 * x + 0.0 * y), Plain(lambda x, y: np.cos(1e5 * x + 2e5 * y))
        parts = summed((ramp, wave)).filtered((1e-4, 1e-4), self.nodes, self.nodes)
        np.testing.assert_allclose(on_nodes(parts, coarse, coarse), whole, rtol=0, atol=1e-12)
