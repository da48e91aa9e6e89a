"""A Gaussian filter of heights that can be had anywhere, at the nodes of a grid.

A coarse grid that samples waves shorter than two of its cells sees long ones that are not there.
"""

from math import ceil, log, pi, sqrt

import numpy as np
from scipy.ndimage import correlate1d

ALPHA = sqrt(log(2.0) / pi)
"""The filter's width over the wavelength of which it leaves a half [ISO 16610-21]."""

REACH = 3.5
"""Standard deviations of the weights up to which they count: the rest is below 5e-4 of all."""


def deviation(wavelength):
    """Standard deviation of the Gaussian weights that leave half of a wave of this length."""
    return ALPHA * wavelength / sqrt(2.0 * pi)


def lines_of(x, y):
    """x (nx,), y (ny,) of points that are nodes of a grid, and whether x runs down the first axis. None of
    other points."""
    x, y = np.atleast_2d(x), np.atleast_2d(y)
    if x.shape[0] == 1 and y.shape[1] == 1:
        return x[0], y[:, 0], False
    if x.shape[1] == 1 and y.shape[0] == 1:
        return x[:, 0], y[0], True
    return None


def smoothed(height, x, y, wavelengths, steps, ends):
    """Heights at the nodes x and y of a grid, each a weighted mean of samples of `height(x, y)`.

    Samples are `steps` apart. Beyond `ends`, which are those of the whole grid, the last one goes on. A
    node's mean does not depend on which other nodes are asked for, so ranks may have parts of a grid.
    """
    x, y, turned = lines_of(x, y)
    along_x, weights_x, stride_x = _samples(x, wavelengths[0], steps[0])
    along_y, weights_y, stride_y = _samples(y, wavelengths[1], steps[1])
    found = height(np.clip(along_x, *ends[0])[None, :], np.clip(along_y, *ends[1])[:, None])
    found = np.broadcast_to(found, (len(along_y), len(along_x)))
    found = _means(_means(found, weights_x, stride_x).T, weights_y, stride_y)
    return found if turned else found.T


def _samples(nodes, wavelength, step):
    """Where samples are taken for a line of nodes, weights about a node, samples from node to node."""
    if step == 0.0:
        return nodes, np.ones(1), 1
    pitch = nodes[1] - nodes[0] if len(nodes) > 1 else step
    stride = max(1, round(abs(pitch) / step))
    apart = pitch / stride
    sigma = deviation(wavelength) / abs(apart)
    reach = ceil(REACH * sigma)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    count = (len(nodes) - 1) * stride + 2 * reach + 1
    return nodes[0] + apart * (np.arange(count) - reach), weights / weights.sum(), stride


def _means(samples, weights, stride):
    """Weighted means along the second axis about every node."""
    reach = len(weights) // 2
    means = correlate1d(samples, weights, axis=1, mode="nearest")
    return means[:, reach : means.shape[1] - reach : stride]
