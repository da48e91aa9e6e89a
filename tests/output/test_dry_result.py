from dataclasses import replace

import numpy as np
import pytest
from contacts import solved

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.output.dry_summary import summarise_dry
from mgehl.output.result import Making, Work
from mgehl.solver.dry import solve_dry

TOLERANCE = 1e-8


@pytest.fixture
def settled(make_problem):
    def run(**grid):
        problem = make_problem(**({"nodes": 65} | grid))
        guess = problem.contact.guessed_pressure(problem.grid.X, problem.grid.Y)
        return problem, solve_dry(problem, guess, TOLERANCE, 60, lambda step: None)

    return run


def judged(problem, outcome):
    return summarise_dry(problem, outcome, TOLERANCE, Making(Work(1.0, 1), 0.0, {}))


def test_an_answer_converges(settled):
    problem, outcome = settled()
    result = judged(problem, outcome)
    assert result.converged and result.boundary_nodes == 0 and result.overlap.nodes == 0
    assert abs(result.load_error) < 1e-13 and result.complementarity_error < 1e-10
    assert result.contact.nodes == np.count_nonzero(outcome.state.P)
    cell = problem.grid.mesh.dX * problem.grid.mesh.dY
    assert result.contact.area_fraction == pytest.approx(result.contact.nodes * cell / np.pi)
    assert result.approach_um == pytest.approx(result.hertz.approach_um, rel=1e-3)
    assert result.max_pressure_GPa == pytest.approx(result.hertz.max_pressure_GPa, rel=1e-3)


HARM = {
    "lighter": (np.s_[:], lambda P: P * (1.0 - 1e-6), "the load is off by"),
    "pulled": ((20, 10), lambda P: -1e-6, "complementarity is broken by 1.0e-06"),
    "lifted": (None, lambda H0: H0 + 1e-6, "complementarity is broken by 1.0e-06"),
    "pressed": (None, lambda H0: H0 - 1e-6, "complementarity is broken by 1.0e-06"),
}


@pytest.mark.parametrize("where, change, said", HARM.values(), ids=HARM)
def test_what_is_wrong_is_found(settled, where, change, said):
    problem, outcome = settled()
    if where is None:
        outcome.state.H0 = change(outcome.state.H0)
    else:
        outcome.state.P[where] = change(outcome.state.P[where])
    result = judged(problem, outcome)
    assert not result.converged and (said in result.reason or "the load is off" in result.reason)


@pytest.mark.parametrize(
    "grid, across", [({"x": (-60.0, 60.0)}, "1 nodes wide along x"), ({"y": (-30.0, 30.0)}, "along y")]
)
def test_contact_of_too_few_nodes_is_none(settled, grid, across):
    """Load and gap hold there, too, and its largest pressure is anything."""
    result = judged(*settled(**grid))
    assert not result.converged and result.complementarity_error < 1e-10
    assert across in result.reason and "needs 4: a smaller domain or more nodes" in result.reason


@pytest.mark.parametrize("ends", [{"x": (-0.8, 1.3)}, {"y": (-1.5, 0.9)}, {"x": (-1.02, 1.3)}])
def test_contact_that_reaches_the_boundary_is_none(settled, ends):
    """Whether nodes beside it press, or it would overlap itself."""
    result = judged(*settled(**ends))
    assert not result.converged and result.boundary_nodes > 0
    assert "a larger grid.x or grid.y is needed" in result.reason


DRY = {"discretization": {"contact_model": "dry"}}
WAVES = {"surface": {"kind": "waviness", "amplitude": 1e-7}} | DRY
DRY_WAVES = WAVES | {"surface": WAVES["surface"] | {"wavelength_x": 300e-6}}


@pytest.mark.parametrize(
    "wavelength, verdict", [(40e-6, "grid-determined"), (150e-6, "coarse"), (300e-6, "resolved")]
)
def test_a_surface_that_the_grid_does_not_show_is_named(wavelength, verdict):
    """Waves of less than four cells have the contact of other waves: pressures may be a third."""
    found = solved(WAVES, {"surface": {"wavelength_x": wavelength}, "grid": {"nodes": 65}})
    assert found.result.converged and found.result.surface.verdict == verdict
    told = str(found)
    assert (
        ("THE SURFACE IS THE GRID'S" in told)
        == ("how to do better" in told)
        == (verdict == "grid-determined")
    )
    assert f"{found.result.surface.wave_nodes:.1f} nodes in its shortest wave" in told


def finds(error, coarse, fine):
    """Whether the bands of a `DryError` about the `Result` that has it hold what a finer grid says."""
    area, approach = coarse.contact.area_fraction, coarse.approach_um
    return (
        abs(fine.contact.area_fraction - area) <= error.area_fraction,
        abs(fine.max_pressure_GPa - coarse.max_pressure_GPa) <= error.max_pressure_GPa,
        abs(fine.approach_um - approach) <= error.approach_um,
    )


class TestBands:
    @pytest.mark.parametrize("kind, nodes", [("point", 65), ("point", 129), ("line", 129)])
    def test_they_hold_what_is_exact(self, kind, nodes):
        """A smooth contact is that of Hertz: area pi, or width 2."""
        found = solved({"contact": {"kind": kind}, "grid": {"nodes": nodes}}, DRY).result
        error, hertz = found.dry_error, found.hertz
        exact = replace(
            found, contact=replace(found.contact, area_fraction=1.0),
            max_pressure_GPa=hertz.max_pressure_GPa, approach_um=hertz.approach_um,
        )  # fmt: skip
        assert finds(error, found, exact) == (True, True, True)
        assert error.area_fraction < 0.1 * 65 / nodes
        assert found.max_pressure_band_GPa == error.max_pressure_GPa < 0.02 * hertz.max_pressure_GPa
        assert error.convolutions > 0.0

    def test_they_hold_what_a_finer_grid_says_of_a_rough_contact(self):
        coarse, fine = (solved(DRY_WAVES, {"grid": {"nodes": n}}).result for n in (65, 257))
        assert finds(coarse.dry_error, coarse, fine) == (True, True, True)
        assert coarse.dry_error.area_fraction < 0.05 and coarse.dry_error.how.endswith("to 33 nodes")
        assert "bands: that of the area by the length of its edge" in str(coarse)

    def test_peaks_that_the_coarser_grid_does_not_have_are_no_matter(self, tmp_path):
        """All that presses stood between its nodes: a run that had converged ended there."""
        ball = {"contact": {"load": 2.0}, "grid": {"nodes": 65, "x": [-2.0, 2.0], "y": [-2.0, 2.0]}}
        cell = contact_from(config_from_tables(ball)).x_scale / 16.0
        (tmp_path / "peaks.py").write_text(
            "import numpy as np\n\n\ndef peaks(x, y):\n"
            f"    X, Y = (np.pi / 4.0 * (each / {cell!r} - 1.0) for each in (x, y))\n"
            "    return 2e-6 * (np.cos(X) + np.cos(Y))\n"
        )
        found = solved(ball, DRY, {"contact": {"surface": f"{tmp_path}/peaks.py:peaks"}})
        assert found.result.converged and not found.fields.P[::2, ::2].any()
        assert found.result.dry_error.area_fraction > 0.0
