"""PETSc's log tells how long the parts of a run took, and counts nothing twice."""

import time

import numpy as np
import pytest


@pytest.fixture
def spent():
    """Function that does something and returns its wall time and the seconds of each part."""
    from mgehl.grid.events import seconds_by_part, start_logging

    start_logging()

    def measure(action):
        before, started = seconds_by_part(), time.perf_counter()
        action()
        wall = time.perf_counter() - started
        return wall, {part: now - before[part] for part, now in seconds_by_part().items()}

    return measure


@pytest.fixture
def grids(make_hierarchy, paper_contact):
    return make_hierarchy(paper_contact(), nodes=65)


def test_log_view_names_the_parts(spent, grids, tmp_path):
    from petsc4py import PETSc

    from mgehl.grid.events import linear_solve

    deflection = grids.deflections[-1]

    def solve():
        with linear_solve():
            deflection(np.zeros(deflection.grid.shape))

    spent(solve)
    viewer = PETSc.Viewer().createASCII(str(tmp_path / "log"), "w", comm=PETSc.COMM_SELF)
    PETSc.Log.view(viewer)
    viewer.destroy()
    log = (tmp_path / "log").read_text()
    assert "mgehl linear solves" in log
    assert "mgehlDeflection" in log and "mgehlLinear" in log and "mgehlSetUp" in log
