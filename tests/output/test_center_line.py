"""The centre line of a wedge between the edges of its pad."""

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.output.center_line import center_line
from mgehl.output.solution import Fields

MESH = Mesh(5, 3, (1.5, 5.5), (-1.0, 1.0), edges=(2.0, 5.5))


def fields(*line):
    """Fields whose middle line has the given statuses and P = 1, 2, ... 5."""
    status = np.full((3, 5), BOUNDARY)
    status[1] = line
    P = np.zeros((3, 5))
    P[1] = np.arange(1.0, 6.0)
    return Fields(P, np.ones((3, 5)), status)


def test_the_node_outside_is_moved_to_the_edge():
    X, P = center_line(MESH, fields(BOUNDARY, LUBRICATED, LUBRICATED, LUBRICATED, BOUNDARY))
    assert X.tolist() == [2.0, 2.5, 3.5, 4.5, 5.5]
    assert P.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]


def test_a_pillar_has_no_fluid_pressure():
    X, P = center_line(MESH, fields(BOUNDARY, LUBRICATED, CONTACT, LUBRICATED, BOUNDARY))
    assert X.size == 5 and np.isnan(P).tolist() == [False, False, True, False, False]


@pytest.mark.parametrize("end", [0, -1])
def test_a_blocked_exit_ends_the_line_at_the_last_fluid(end):
    line = [BOUNDARY, LUBRICATED, LUBRICATED, LUBRICATED, BOUNDARY]
    line[end] = CONTACT
    X, P = center_line(MESH, fields(*line))
    assert X.size == 4 and not np.isnan(P).any()
    assert X[end] == MESH.X[1 if end == 0 else -2]


def test_the_fields_are_left_alone():
    given = fields(BOUNDARY, LUBRICATED, CONTACT, LUBRICATED, BOUNDARY)
    center_line(MESH, given)
    assert given.P[1].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0] and MESH.X[0] == 1.5
