from dataclasses import replace

import numpy as np
import pytest
from made_solution import make_result

from mgehl.config import config_from_tables
from mgehl.kinds import Case, case_of, contact_from, mesh_from
from mgehl.model.frame import Frame
from mgehl.output.result import ContactResult
from mgehl.output.solution import Fields, Solution
from mgehl.output.users_axes import in_users_axes
from mgehl.solver.from_config import set_up
from mgehl.solver.inequality import Inequality
from mgehl.solver.verification import NOT_SEEN

ANGLES = (20.0, 70.0, 110.0, 160.0, 200.0, 250.0, 290.0, 340.0)
"""One for each frame."""

NODES = 9


def config_at(angle):
    grid = {"nodes": 65, "x": [-3.0, 2.0], "y": [-2.0, 4.0]}
    return config_from_tables(
        {"contact": {"radius_y": 25.4e-3}, "motion": {"speed": 0.5, "angle": angle}, "grid": grid}
    )


@pytest.fixture(params=ANGLES, ids=lambda angle: f"{angle:g} degrees")
def case(request):
    """(the user's `Solution`, the one that was solved, its frame) at an angle."""
    config = config_at(request.param)
    parts = set_up(case_of(config))
    contact = contact_from(config)
    mesh = replace(mesh_from(config, contact), nx=NODES, ny=NODES)
    random = np.random.default_rng(11)
    P, H = random.random((2, NODES, NODES))
    status = np.zeros((NODES, NODES), np.int8)
    status[4, 2:5], status[3:7, 4] = 3, 3
    fields = Fields(P, H, status, heights=random.random((NODES, NODES)))
    expected = Solution(config, contact, mesh, fields, [], _result(fields), H0=-0.5)
    # In m a film is the same in every frame, in units of H it is not.
    scale = contact.film_scale / parts.contact.film_scale
    there = Fields(**{name: parts.frame.array(array) for name, array in fields.named.items()})
    there.H = scale * there.H
    solved = replace(
        expected, contact=parts.contact, mesh=mesh.in_frame(parts.frame), fields=there,
        result=_result(there), H0=-0.5 * scale,
    )  # fmt: skip
    return expected, solved, parts.frame


def _result(fields):
    """A `Result` whose lists name one node each, that of the largest P and that of the largest H."""
    of_P, of_H = _largest(fields.P), _largest(fields.H)
    j, i = of_H["j"] - 1, of_H["i"] - 1
    sides = [fields.P[j, i - 1], fields.P[j, i + 1], fields.P[j - 1, i], fields.P[j + 1, i]]
    solid = fields.status == 3
    ends = [tuple(int(n) + 1 for n in np.flatnonzero(solid.sum(axis=axis) > 0)[[0, -1]]) for axis in (0, 1)]
    return make_result(
        contact=ContactResult(6, 0.1, 0.2, *ends, 0.0),
        pressure_inequality=Inequality(8, 1, 0.25, 1.5, [of_P | {"size": 0.25}]),
        edge=replace(
            NOT_SEEN, nodes_along_x=solid.any(axis=0).sum(), nodes_along_y=solid.any(axis=1).sum()
        ),
        contradictions=[of_H | {"film_gap_nm": -1.0, "neighbours": sides}],
    )


def _largest(array):
    j, i = np.unravel_index(array[1:-1, 1:-1].argmax(), (NODES - 2, NODES - 2))
    return {"i": int(i) + 2, "j": int(j) + 2}


def back(expected, solved, frame):
    return in_users_axes(solved, frame, Case(expected.config, expected.contact, expected.mesh))


def test_nodes_sides_and_ranges_are_the_users(case):
    expected, *_ = case
    found = back(*case).result
    assert found.contact == expected.result.contact and found.edge == expected.result.edge
    assert found.pressure_inequality == expected.result.pressure_inequality
    assert found.contradictions == expected.result.contradictions


def test_what_was_solved_in_the_users_axes_stays_as_it_is(case):
    expected, solved, _ = case
    assert back(expected, solved, Frame()) is solved
