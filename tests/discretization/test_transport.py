import numpy as np
import pytest

from mgehl.discretization.transport import moved, passing


def carried(m, cells):
    along = passing(m, cells)
    return m + along[..., :-1] - along[..., 1:]


def sine_means(n, shift=0.0, tiles=3):
    """Means of 1 + sin(2 pi x)/2 over n cells of a period, moved along; repeated."""

    def integral(x):
        return x - np.cos(2.0 * np.pi * (x - shift)) / (4.0 * np.pi)

    faces = np.arange(n + 1) / n
    return np.tile(np.diff(integral(faces)) * n, tiles)


@pytest.mark.parametrize("cells", [1, 3, -2])
def test_whole_cells_are_exact(cells):
    m = np.random.default_rng(1).random((2, 20))
    inner = slice(4, -4)
    expected = np.roll(m, cells, axis=1)[:, inner]
    assert carried(m, float(cells))[:, inner] == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("cells", [0.3, 2.5, -0.7])
def test_any_shift_is_of_third_order(cells):
    def error(n):
        m, steps = sine_means(n), n // 4
        for _ in range(steps):
            m = carried(m, cells)
        exact = sine_means(n, steps * cells / n)
        return np.abs(m - exact)[n : 2 * n].max() if abs(cells) * steps < n else np.nan

    assert np.log2(error(32) / error(64)) > 2.7


@pytest.mark.parametrize("cells", [0.4, 1.7, -3.2])
def test_no_content_is_made_and_none_is_negative(cells):
    rng = np.random.default_rng(2)
    m = np.where(rng.random((3, 60)) > 0.5, rng.random((3, 60)), 0.0)
    m[:, :8] = m[:, -8:] = 0.0
    after = carried(m, cells)
    assert after.sum() == pytest.approx(m.sum(), rel=1e-14)
    assert after.min() >= -1e-15


def test_differences_stay_differences():
    G = np.random.default_rng(3).random((2, 30))
    after = moved(np.diff(G), 0.6)
    assert after[:, 3:-3] == pytest.approx(np.diff(moved(G, 0.6))[:, 3:-3], abs=1e-14)


def test_short_steps_carry_no_wave_of_two_cells_on():
    """By contents at the faces that both sides see alike it was left as it is: pressures went up and down
    from node to node in runs of short steps."""
    m, waves = np.ones(40), np.where(np.arange(40) % 2, 1e-3, -1e-3)
    after = m + waves
    for _ in range(40):
        after = carried(after, 0.05)
    assert np.abs(after[8:-8] - 1.0).max() < 0.2 * np.abs(waves).max()
