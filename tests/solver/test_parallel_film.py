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


def response(cells, Q, C, v, steps_a_cell=1.0, wave=2.0 * np.pi):
    """Amplitude (complex) of the film by that of the roughness, which moves at v, when all has settled."""
    film, E = Film(cells), 1.0
    mobility = 4.0 * (v - 1.0) / (Q * E * wave**2)
    bulk = np.inf if C == 0.0 else E * wave / (4.0 * C)
    dT, amplitude = steps_a_cell / cells, 1e-3
    x = np.arange(cells) / cells
    k = np.abs(np.fft.fftfreq(cells, 1.0 / cells)) * wave
    softness = np.divide(4.0, k * E, out=np.zeros(cells), where=k > 0.0)
    laplacian = -((2.0 * cells * np.sin(0.5 * k / cells)) ** 2)
    transport, status = Transport(film), np.full((1, TILES * cells), LUBRICATED)

    def tiled(values):
        return np.tile(values, TILES)[None, :]

    carried, t = Carried(tiled(1.0 + amplitude * np.cos(wave * x))), 0.0
    for _ in range(int(SETTLED * max(abs(Q), 1.0) / (dT * abs(v - 1.0)))):
        t += dT
        leg, _ = transport.leg(carried, status, dT, Shift(dT * cells))
        rough = amplitude * np.cos(wave * (x - v * t))
        before = np.fft.fft(leg.before[0, 2 * cells : 3 * cells] - 1.0 - rough)
        # softness p + p/B = before + b dT mobility p''
        yielding = softness + 1.0 / bulk - leg.b * dT * mobility * laplacian
        p = np.divide(before, yielding, out=np.zeros(cells, complex), where=k > 0.0)
        flow = -mobility * np.diff(np.append(np.fft.ifft(p).real, np.fft.ifft(p).real[0])) * cells
        G = leg.b * dT * tiled(flow)[:, :-1] + (0.0 if leg.G is None else leg.G[0])
        m = 1.0 + rough + np.fft.ifft((softness + 1.0 / bulk) * p).real
        carried = Carried(tiled(m), np.pad(G, ((0, 0), (0, 1))), None, dT)
        gap = rough + np.fft.ifft(softness * p).real
    return np.fft.fft(gap)[1] / (0.5 * cells) * np.exp(1j * wave * v * t) / amplitude


SETTLED = 2.0
"""Waves by which roughness and film have moved past each other, for each unit of Q: what was there at the
beginning has fallen to e^(-2 pi SETTLED)."""


def exact(Q, C):
    return (1.0 - 1j * C * Q) / (1.0 - 1j * Q - 1j * C * Q)


CASES = [
    (0.1, 0.0, 2.0),
    (1.0, 0.0, 2.0),
    (1.0, 0.3, 0.5),
    (3.0, 0.1, 0.0),
    (10.0, 0.0, 2.0),
    (10.0, 0.3, 2.0),
]


@pytest.mark.parametrize("Q, C, v", CASES)
def test_amplitude_and_phase_to_a_percent(Q, C, v):
    """In steps as a run chooses them: of a cell, or half a cell of film and roughness past each other."""
    Q = Q if v > 1.0 else -Q
    assert response(32, Q, C, v, 1.0 / cells_a_step((v,))) == pytest.approx(exact(Q, C), rel=0.01)


@pytest.mark.parametrize("steps", [0.5, 0.75])
def test_second_order_in_space_and_time(steps):
    errors = [abs(response(cells, 1.0, 0.1, 2.0, steps) - exact(1.0, 0.1)) for cells in (32, 64)]
    assert np.log2(errors[0] / errors[1]) > 1.9


def test_film_that_goes_with_the_roughness_is_exact():
    """Where both move alike nothing is pressed, and a wave is carried for ever."""
    film = Film(32)
    transport, wave = Transport(film), np.sin(2.0 * np.pi * np.arange(32) / 32.0)
    carried = Carried(np.tile(1.0 + 0.1 * wave, TILES)[None, :])
    leg, _ = transport.leg(carried, np.full((1, 32 * TILES), LUBRICATED), 1.0 / 32.0, Shift(1.0))
    assert leg.before[0, 64:96] == pytest.approx(1.0 + 0.1 * np.roll(wave, 1), abs=1e-14)
