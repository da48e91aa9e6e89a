"""Bands about the mean gaps of rough bodies."""

import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.output.gap_error import GridGap
from mgehl.run import solve
from mgehl.studies.study import merged

WAVY = {
    "contact": {"load": 20.0, "boundary_film": 2e-9},
    "surface": {"kind": "waviness", "amplitude": 5e-8, "wavelength_x": 8e-5},
    "grid": {"x": [-2.0, 1.5], "y": [-1.75, 1.75]},
    "motion": {"speed": 1e-3},
    "solver": {"error": True},
}
"""A ball with ridges across the motion, in mixed lubrication."""


def grid(nodes, settled=True):
    loads = {
        "max_pressure_GPa": 2.0, "solid_load_fraction": 0.2, "pressure_apart_GPa": 0.05,
        "pressure_crest_GPa": 0.03,
    }  # fmt: skip
    return GridGap(nodes, 10.0, 2.0, 0.25, settled, 0.5, 0.1, **loads)


class TestOfAWavyBall:
    @pytest.fixture(scope="class")
    def solved(self):
        """Function: the `Result` on so many nodes."""
        found = {}

        def result(nodes, **solver):
            key = nodes, *solver
            if key not in found:
                tables = merged(WAVY, {"grid": {"nodes": nodes}, "solver": solver})
                found[key] = solve(config_from_tables(tables), MPI.COMM_SELF).result
            return found[key]

        return result

    def test_the_bands_hold_the_gaps_of_a_grid_four_times_as_fine(self, solved):
        coarse, fine = solved(65), solved(257)
        assert coarse.converged and fine.converged and fine.mixed.contact_load_share > 0.0
        for gap in ("mean", "loaded"):
            values = [getattr(each.mixed, f"{gap}_gap_nm") for each in (coarse, fine)]
            width = getattr(coarse.mixed.error, f"{gap}_nm")
            assert 0.0 < abs(values[1] - values[0]) < width < 0.4 * values[0]

    def test_so_do_those_of_the_loads_and_the_largest_pressure(self, solved):
        coarse, fine = solved(65), solved(257)
        off = abs(fine.max_pressure_GPa - coarse.max_pressure_GPa)
        assert 0.0 < off < coarse.mixed.error.max_pressure_GPa < 0.2 * fine.max_pressure_GPa
        for name in ("contact_load_share", "solid_load_fraction"):
            off = abs(getattr(fine.mixed, name) - getattr(coarse.mixed, name))
            assert 0.0 < off < getattr(coarse.mixed.error, name) < 0.25


class TestOfAThickFilm:
    """Ridges of 30 nm under a film of 60."""

    @pytest.fixture(scope="class")
    def solved(self):
        """Results on 65 and 257 nodes."""
        thick = {"motion": {"speed": 0.1}, "surface": {"amplitude": 3e-8}}
        tables = [merged(WAVY, thick, {"grid": {"nodes": nodes}}) for nodes in (65, 257)]
        return [solve(config_from_tables(each), MPI.COMM_SELF).result for each in tables]

    def test_the_bands_hold_the_gaps_of_a_grid_four_times_as_fine(self, solved):
        coarse, fine = (each.mixed for each in solved)
        assert coarse.lambda_ratio > 2.0 and solved[0].converged and solved[1].converged
        assert abs(fine.mean_gap_nm - coarse.mean_gap_nm) < coarse.error.mean_nm < 0.1 * fine.mean_gap_nm
        assert abs(fine.loaded_gap_nm - coarse.loaded_gap_nm) < coarse.error.loaded_nm
