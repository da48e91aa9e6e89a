from itertools import combinations

import numpy as np
import pytest

from mgehl.config import load_config
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.kinds import contact_from
from mgehl.output.pictures import style
from mgehl.output.result import Result
from mgehl.output.solution import Fields, Solution

FILM = 2e-4
"""H of the film in the middle: some nanometres."""


def newton_rows(grids=(65, 129), cycles=4, speed=500.0):
    """A history that converges by two orders a cycle on every grid; coarse ones at a higher speed."""
    return [
        {
            "grid": nodes, "speed_mm_s": speed * (2.0 if nodes < grids[-1] else 1.0), "step": k,
            "residual": 100.0**-k, "load_error": (-1) ** k * 10.0 ** (-k - 1), "contact_nodes": 3 * k,
            "cavitated_nodes": nodes, "changed_nodes": 2 * (cycles - 1 - k), "linear_iterations": 2,
        }
        for nodes in grids for k in range(cycles)
    ]  # fmt: skip


def status_of(mesh, contact):
    """Boundary about film, a cavity behind X = 0.5 and a disc of contact of that radius."""
    X, Y = mesh.X[None, :], mesh.Y[:, None]
    status = np.where(X > 0.5, CAVITATED, LUBRICATED) + 0 * Y.astype(int)
    status[[0, -1]], status[:, [0, -1]] = BOUNDARY, BOUNDARY
    return np.where(np.hypot(X, Y) < contact, CONTACT, status).astype(np.int8)


@pytest.fixture
def make_rows():
    return newton_rows


@pytest.fixture
def drawn():
    """Function: what a function draws of something, in the style of all pictures."""

    def draw(function, *what):
        with style.applied():
            return function(*what)

    return draw


def bare_result(converged=True, **more):
    """A `Result` of which pictures ask only whether it converged."""
    known = {"reason": "", "wall_s": 0.0, "ranks": 1, "versions": {}}
    return Result(converged=converged, settled=converged, **known, **more)


def heights_of(body, mesh):
    """Of a body's surface at the nodes, None of a smooth one."""
    if body.surface is None:
        return None
    x, y = mesh.X[None, :] * body.x_scale, mesh.Y[:, None] * body.y_scale
    return np.broadcast_to(body.surface.height(x, y), (mesh.ny, mesh.nx))


@pytest.fixture
def make_solution():
    def make(nodes=33, contact=0.0, settings=(), rows=None, converged=True):
        config = load_config(settings=["grid.nodes=65", *settings])
        body = contact_from(config)
        mesh = Mesh(nodes, nodes, config.grid.x, config.grid.y, body.k_e)
        X, Y = mesh.X[None, :], mesh.Y[:, None]
        status = status_of(mesh, contact)
        P = np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0))
        H = np.where(status == CONTACT, 0.0, FILM + np.maximum(X**2 + Y**2 - 1.0, 0.0))
        result = bare_result(converged)
        rows = newton_rows() if rows is None else rows
        return Solution(
            config, body, mesh, Fields(P, H, status, heights=heights_of(body, mesh)), rows, result
        )

    return make


@pytest.fixture
def make_line():
    def make(nodes=65, settings=()):
        config = load_config(settings=["contact.kind=line", "grid.nodes=65", *settings])
        body = contact_from(config)
        mesh = Mesh(nodes, 1, config.grid.x, (-0.5, 0.5))
        P = np.sqrt(np.maximum(1.0 - mesh.X**2, 0.0))[None, :]
        status = np.full((1, nodes), LUBRICATED)
        status[0, [0, -1]] = BOUNDARY
        fields = Fields(P, FILM + 0.0 * P, status, heights=heights_of(body, mesh))
        return Solution(config, body, mesh, fields, newton_rows(), bare_result())

    return make


@pytest.fixture
def make_wedge():
    def make(nodes=33, settings=()):
        wedge = "contact.kind=wedge", "grid.nodes=65", "wedge.pillar=square"
        config = load_config(settings=[*wedge, *settings])
        body = contact_from(config)
        ends, edges = body.placement(nodes)
        mesh = Mesh(nodes, nodes, ends, (-10.0, 10.0), edges=edges)
        X, Y = mesh.X[None, :], mesh.Y[:, None]
        status = np.where(body.solid(X, Y), CONTACT, LUBRICATED).astype(np.int8)
        P = np.sin(0.2 * X) * np.cos(0.1 * Y)
        row = {"grid": nodes, "linear_iterations": 3}
        rows = [row | {"step": k, "residual": 10.0 ** (-6 * k)} for k in range(3)]
        result = bare_result(cavitated_nodes=0)
        return Solution(config, body, mesh, Fields(P, body.gap(X) + 0.0 * Y, status), rows, result)

    return make


def written(figure):
    """The texts that a figure shows, each with its box in pixels; without the numbers of lines of a map."""
    with style.applied():  # as a figure is saved
        figure.draw_without_rendering()
    texts = [*figure.texts, *(text for legend in figure.legends for text in legend.get_texts())]
    for axes in figure.axes:
        texts += [axes.title, *axes.texts[: 0 if axes.collections else None]]
        texts += axes.get_legend().get_texts() if axes.get_legend() else []
        for axis in (each for part in (axes, *axes.child_axes) for each in (part.xaxis, part.yaxis)):
            texts += [axis.label, *_shown_numbers(axis)]
    shown = [text for text in texts if text.get_visible() and text.get_text().strip()]
    return [(text.get_text(), text.get_window_extent()) for text in shown]


def _shown_numbers(axis):
    low, high = sorted(axis.get_view_interval())
    ticks = [tick for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
    return [label for tick in ticks for label in (tick.label1, tick.label2)]


def overlapping(figure):
    """Pairs of texts whose boxes share more than a pixel."""
    return [
        (one, other)
        for (one, a), (other, b) in combinations(written(figure), 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > 1.0 and min(a.y1, b.y1) - max(a.y0, b.y0) > 1.0
    ]


@pytest.fixture
def check_texts():
    """Function: no text of a figure lies on another, and all words given are there."""

    def check(figure, *words):
        assert overlapping(figure) == []
        said = [text for text, _ in written(figure)]
        assert set(words) <= set(said), said

    return check
