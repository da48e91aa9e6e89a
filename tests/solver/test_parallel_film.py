"""Waves of roughness in a parallel film: exact by Hooke (Proc IMechE J 220 (2006) 259).

The film's contents are carried by the steps in time of a run; pressures are solved for in Fourier space.
"""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.discretization.axes import axes_of
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import LUBRICATED
from mgehl.discretization.transport import Shift
from mgehl.grid.grid import single_grid
from mgehl.model.scene import cells_a_step
from mgehl.solver.carry import Carried, Transport

TILES = 5


class Film:
    """One line of nodes over some periods of a film of thickness 1; the surfaces' mean velocity is 1."""

    def __init__(self, cells):
        self.cells, n = cells, TILES * cells
        mesh = Mesh(n, 1, (0.0, (n - 1) / cells), (0.0, 0.0))
        self.grid, self.axes = single_grid(mesh, MPI.COMM_SELF), axes_of(mesh, (0.0, 0.0))
        self.boundary = np.zeros((1, n), dtype=bool)


E = 1.0
"""Reduced modulus."""


def marched(cells, mobility, bulk, m, roughness, dT, steps):
    """Film and content over a period after some steps, from contents `m` over a period; and the time.

    `roughness(t)` are the heights over a period, 0 without any.
    """
    film = Film(cells)
    k = np.abs(np.fft.fftfreq(cells, 1.0 / cells)) * WAVE
    softness = np.divide(4.0, k * E, out=np.zeros(cells), where=k > 0.0)
    laplacian = -((2.0 * cells * np.sin(0.5 * k / cells)) ** 2)
    transport, status = Transport(film), np.full((1, TILES * cells), LUBRICATED)

    def tiled(values):
        return np.tile(values, TILES)[None, :]

    carried, t = Carried(tiled(m)), 0.0
    for _ in range(steps):
        t += dT
        leg, _ = transport.leg(carried, status, dT, Shift(dT * cells))
        rough = roughness(t)
        before = np.fft.fft(leg.before[0, 2 * cells : 3 * cells] - 1.0 - rough)
        # softness p + p/B = before + b dT mobility p''
        yielding = softness + 1.0 / bulk - leg.b * dT * mobility * laplacian
        p = np.divide(before, yielding, out=np.zeros(cells, complex), where=k > 0.0)
        flow = -mobility * np.diff(np.append(np.fft.ifft(p).real, np.fft.ifft(p).real[0])) * cells
        G = leg.b * dT * tiled(flow)[:, :-1] + (0.0 if leg.G is None else leg.G[0])
        m = 1.0 + rough + np.fft.ifft((softness + 1.0 / bulk) * p).real
        carried = Carried(tiled(m), np.pad(G, ((0, 0), (0, 1))), None, dT)
    return rough + np.fft.ifft(softness * p).real, m, t


WAVE, AMPLITUDE = 2.0 * np.pi, 1e-3


def first_wave(values, way):
    return np.fft.fft(values)[1] / (0.5 * len(values)) * np.exp(1j * WAVE * way) / AMPLITUDE


def bulk_of(C):
    return np.inf if C == 0.0 else E * WAVE / (4.0 * C)


def response(cells, Q, C, v, steps_a_cell=1.0):
    """Amplitude (complex) of the film by that of the roughness, which moves at v, when all has settled."""
    mobility, dT = 4.0 * (v - 1.0) / (Q * E * WAVE**2), steps_a_cell / cells
    x, steps = np.arange(cells) / cells, int(SETTLED * max(abs(Q), 1.0) / (dT * abs(v - 1.0)))

    def roughness(t):
        return AMPLITUDE * np.cos(WAVE * (x - v * t))

    gap, _, t = marched(cells, mobility, bulk_of(C), 1.0 + roughness(0.0), roughness, dT, steps)
    return first_wave(gap, v * t)


def film_wave(cells, Q_c, C_c, steps_a_cell=1.0):
    """What is left (complex) of a wave of the film that has gone its length, over what is left exactly."""
    mobility, dT = 4.0 / (Q_c * E * WAVE**2), steps_a_cell / cells
    m = 1.0 + AMPLITUDE * np.cos(WAVE * np.arange(cells) / cells)
    _, m, t = marched(cells, mobility, bulk_of(C_c), m, lambda t: 0.0, dT, round(1.0 / dT))
    return first_wave(m, t) / np.exp(-WAVE / (Q_c * (1.0 + C_c)))


SETTLED = 2.0
"""Waves by which roughness and film have moved past each other, for each unit of Q: what was there at the
beginning has fallen to e^(-2 pi SETTLED)."""


def exact(Q, C):
    return (1.0 - 1j * C * Q) / (1.0 - 1j * Q - 1j * C * Q)


CASES = [(0.1, 0.0, 2.0), (1.0, 0.0, 2.0), (1.0, 0.3, 0.5), (3.0, 0.1, 0.0), (10.0, 0.0, 2.0)]


@pytest.mark.parametrize("Q, C, v", [*CASES, (10.0, 0.3, 2.0)])
def test_amplitude_and_phase_to_a_percent(Q, C, v):
    """In steps as a run chooses them: of a cell, or half a cell of film and roughness past each other."""
    Q = Q if v > 1.0 else -Q
    assert response(32, Q, C, v, 1.0 / cells_a_step((v,))) == pytest.approx(exact(Q, C), rel=0.01)


@pytest.mark.parametrize("steps", [0.5, 0.75])
def test_second_order_in_space_and_time(steps):
    errors = [abs(response(cells, 1.0, 0.1, 2.0, steps) - exact(1.0, 0.1)) for cells in (32, 64)]
    assert np.log2(errors[0] / errors[1]) > 1.9


@pytest.mark.parametrize("C_c", [0.0, 0.3])
@pytest.mark.parametrize("Q_c", [3.0, 10.0, 100.0])
def test_film_waves_fall_as_they_flow_away_to_a_percent(Q_c, C_c):
    """In steps of a cell. Of the steepest, Q_c = 1, little is left: e^(-2 pi)."""
    assert film_wave(32, Q_c, C_c) == pytest.approx(1.0, abs=0.01)
    assert film_wave(64, 1.0, C_c) == pytest.approx(1.0, abs=0.01)


def test_film_that_goes_with_the_roughness_is_exact():
    """Where both move alike nothing is pressed, and a wave is carried for ever."""
    film = Film(32)
    transport, wave = Transport(film), np.sin(2.0 * np.pi * np.arange(32) / 32.0)
    carried = Carried(np.tile(1.0 + 0.1 * wave, TILES)[None, :])
    leg, _ = transport.leg(carried, np.full((1, 32 * TILES), LUBRICATED), 1.0 / 32.0, Shift(1.0))
    assert leg.before[0, 64:96] == pytest.approx(1.0 + 0.1 * np.roll(wave, 1), abs=1e-14)
