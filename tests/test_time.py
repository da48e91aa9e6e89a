import json
from contextlib import suppress
from types import SimpleNamespace

import h5netcdf
import numpy as np
import pytest
from mpi4py import MPI

import mgehl
from mgehl.discretization.mesh import Mesh
from mgehl.errors import ConfigError, Stopped, UserError
from mgehl.kinds import contact_from
from mgehl.run import Watch, enter, run
from mgehl.solver.pace import SHORTEST, SHORTEST_PART

BALL = {
    "contact.load": 15.0, "contact.radius_x": 0.0125, "contact.radius_y": 0.0125,
    "contact.reduced_modulus": 110e9, "lubricant.viscosity": 0.25, "lubricant.viscosity_law": "roelands",
    "lubricant.pressure_viscosity": 22e-9, "motion.speed": 0.09, "grid.nodes": 65,
    "contact.boundary_film": 2e-11, "solver.start": "film", "solver.error": False,
}  # fmt: skip
"""The ball of Mourier et al., whose film is found in a second."""

UNIT = 1.52e-3
"""Seconds in which its surfaces go the contact's radius."""

ROUGH = {
    "surface.kind": "self-affine", "surface.rms": 300e-9, "grid.x": [-2.5, 2.5], "grid.y": [-2.5, 2.5],
    "surface.shortest_wavelength": 60e-6,
    "surface.longest_wavelength": 200e-6, "surface.seed": 3, "surface.body": "body_1",
    "contact.boundary_film": 2e-9,
}  # fmt: skip


def solved(more=(), **keys):
    """The ball with other settings; in a keyword a dot is two underscores."""
    named = {key.replace("__", "."): value for key, value in keys.items()}
    return mgehl.solve(mgehl.load(None, BALL | dict(more) | named))


@pytest.fixture
def course(tmp_path):
    def written(*rows):
        path = tmp_path / "course.csv"
        path.write_text("\n".join(f"{t},{value}" for t, value in rows))
        return str(path)

    return written


def column(solution, name):
    return np.array([row[name] for row in solution.rows])


def test_a_steady_state_stays():
    """To the last digits, in steps of any length, each of the one convolution that tells its residual."""
    steady, after = solved(), solved(time__end=6.0 * UNIT)
    assert after.summary.converged
    assert after.fields.H == pytest.approx(steady.fields.H, abs=1e-8)
    assert len(after.rows) > 100
    assert np.diff(column(after, "convolutions")) == pytest.approx(1.0)
    assert np.ptp(column(after, "step_s")) > 0.0
    oblique = {"motion__angle": 30.0, "contact__radius_y": 0.02}
    steady, after = solved(**oblique), solved(**oblique, time__end=1.0 * UNIT)
    assert after.fields.H == pytest.approx(steady.fields.H, abs=1e-8)


THINNED = {"motion__slide_to_roll": 0.5, "friction__model": "eyring", "friction__eyring_stress": 1e5}


def test_a_film_that_shear_thins_stays_thin(course):
    """By a table of the speed, too: one that stays had the film of oil that shear does not thin."""
    thick, thin = solved(), solved(**THINNED)
    after = solved(**THINNED, time__end=1.0 * UNIT)
    assert thin.summary.central_film_nm < 0.98 * thick.summary.central_film_nm
    assert after.fields.H == pytest.approx(thin.fields.H, abs=1e-8)
    one, other = (vars(each.summary.friction) for each in (after, thin))
    for name in ("coefficient", "film_coefficient", "rolling_N", "force_1_N", "power_loss_W"):
        assert one[name] == pytest.approx(other[name], rel=1e-6) != 0.0
    assert after.fields.shear == pytest.approx(thin.fields.shear, rel=1e-5)
    by_table = solved(**THINNED, motion__speed=course((0.0, 0.09), (UNIT, 0.09)), time__end=0.5 * UNIT)
    assert by_table.fields.H == pytest.approx(thin.fields.H, abs=1e-8)


def test_friction_at_the_end_is_that_of_its_speed_and_load(course):
    speed, load = course((0.0, 0.09), (0.1 * UNIT, 0.03)), 15.0
    slower = solved(**THINNED, motion__speed=speed, time__end=0.1 * UNIT)
    (found, row), sliding = (slower.summary.friction, slower.rows[-1]), 0.5 * 0.03
    assert found.coefficient == pytest.approx(row["friction"], rel=1e-5)
    assert found.sliding_speed == pytest.approx(sliding)
    power = found.coefficient * load * sliding - 2.0 * 0.03 * found.rolling_N
    assert found.power_loss_W == pytest.approx(power)


def test_what_is_exported_is_of_the_end(course):
    """Load and film were of the end, the speed and the groups of the beginning."""
    speed, load = course((0.0, 0.09), (0.1 * UNIT, 0.03)), 15.0
    slower = solved(motion__speed=speed, time__end=0.1 * UNIT)
    there = slower.contact.at_speed(0.03)
    told = slower.to_xarray()
    assert (float(told.speed), float(told.normal_load)) == pytest.approx((0.03, load))
    assert float(told.moes_M) == pytest.approx(there.groups.M)
    assert slower.summary.formulas_of == "at the largest speed" and solved().summary.formulas_of == ""
    H = 1e-9 * slower.summary.central_film_nm * there.moes_scale
    assert slower.summary.moes_film.central == pytest.approx(H)
    friction = np.average(column(slower, "friction"), weights=column(slower, "step_s"))
    assert slower.summary.time.whole["friction"] == pytest.approx(friction)
    assert "means over the whole run: mean gap" in str(slower.summary)
    most, least = column(slower, "max_pressure_GPa").max(), column(slower, "minimum_film_nm").min()
    assert (slower.summary.time.most_pressure_GPa, slower.summary.time.least_film_nm) == (most, least)
    assert not solved(time__end=0.1 * UNIT).summary.time.whole


def test_a_stop_leaves_the_film_shut_in(course):
    speed = course((0.0, 0.09), (0.3 * UNIT, 0.0), (3.0 * UNIT, 0.0))
    stopped = solved(motion__speed=speed, time__end=3.0 * UNIT)
    central, least = column(stopped, "central_film_nm"), column(stopped, "minimum_film_nm")
    assert stopped.summary.converged
    assert central[-1] > 0.98 * central[0]
    assert least[-1] < 0.6 * least[0]
    assert np.all(np.diff(least) < 1e-3)


PAPERS = {
    "grid.nodes": 65, "grid.x": [-2.5, 2.5], "grid.y": [-2.0, 2.0], "solver.start": "film",
    "solver.error": False, "discretization.face_mobility": "linear-gap", "discretization.couette": "3B",
}  # fmt: skip
"""The paper's ball: hard bodies, which part slowly."""


def papers_ball(motion, end):
    return mgehl.solve(mgehl.load(None, PAPERS | {"motion.speed": motion, "time.end": end}))


def test_bodies_that_lie_dry_part_as_they_start(course):
    """Oil that is shut in between them fills gaps as small as rounding: no set settles there."""
    started = papers_ball(course((0, 0), (0.02, 0.06)), 0.006)
    assert started.summary.converged and not column(started, "halvings").any()
    assert started.result.recipe["begins"] == "dry contact"
    touching = column(started, "contact_nodes")
    assert touching[-1] < 0.9 * touching[0]


def test_a_reversal_makes_no_oil(course):
    """Where contents turn round, cavities owe nothing to the steady state at the beginning."""
    turned = papers_ball(course((0, 0.06), (0.005, 0.06), (0.025, -0.06)), 0.02)
    assert turned.summary.converged
    assert np.abs(column(turned, "closure")).max() < 1e-8


def test_after_a_reversal_the_bath_comes_in_and_the_film_is_that_of_its_mirror(course):
    """What is added for the beginning to stay as it is was added to its reverse, too: no oil came in from
    outside, and a ball's film settled 14 % too thick."""
    motion = course((0, 0.5), (0.5e-3, 0.5), (1e-3, -0.5), (1.0, -0.5))
    line = {"contact.kind": "line", "contact.load_per_length": 50e3, "contact.radius_x": 0.01}
    oil = {"lubricant.viscosity": 0.04, "lubricant.pressure_viscosity": 20e-9}
    grid = PAPERS | {"grid.nodes": 129, "grid.x": "auto"}
    del grid["grid.y"]
    told = line | oil | grid | {"motion.speed": motion, "time.end": 2.5e-3, "time.step": 8e-6}
    turned = mgehl.solve(mgehl.load(None, told))
    film = column(turned, "central_film_nm")
    assert film.min() < 0.6 * film[0] and film[-1] == pytest.approx(film[0], rel=0.01)
    assert turned.fields.filling[..., -30:].min() == 1.0


OBLONG = {
    "contact__radius_y": 0.02, "time__end": 0.5 * UNIT, "grid__x": [-2.5, 2.5], "grid__y": [-2.5, 2.5],
}  # fmt: skip


@pytest.fixture
def turned(tmp_path):
    """The ball, longer along y, whose motion turns from one angle to another."""

    def run(first, last, **keys):
        (tmp_path / "angle.csv").write_text(f"0,{first}\n{0.3 * UNIT},{last}\n1,{last}\n")
        return solved(motion__angle=str(tmp_path / "angle.csv"), **OBLONG | keys)

    return run


def test_the_film_turns_with_the_motion_and_no_oil_is_made(turned):
    """Once all of it has passed through it is that of the last direction, as near as so few cells tell."""
    scheme = {"discretization__couette": "3B", "discretization__face_mobility": "linear-gap"}
    ball = OBLONG | scheme | {"contact__radius_y": 0.0125, "time__end": 2.5 * UNIT}
    film, inside = turned(0.0, 90.0, **ball), slice(20, -20)
    assert film.summary.converged and film.motion == (0.0, 1.0)
    assert np.abs(column(film, "closure")).max() < 1e-8
    quarter = 0.3 * 2.0 / np.pi
    assert film.path == pytest.approx([0.09 * UNIT * part for part in (quarter, 2.2 + quarter)])
    del ball["time__end"]
    last = solved(**ball, motion__angle=90.0).film[inside, inside]
    assert film.film[inside, inside] == pytest.approx(last, abs=0.05 * last.max())


@pytest.mark.parametrize("first, last, flip", [(0.0, -60.0, np.s_[::-1]), (180.0, 120.0, np.s_[:, ::-1])])
def test_motion_that_turns_the_other_way_has_the_mirrored_film(turned, first, last, flip):
    one, other = turned(0.0, 60.0), turned(first, last)
    assert other.fields.H[flip] == pytest.approx(one.fields.H, abs=1e-6)


def test_motion_that_turns_in_other_axes_has_the_same_film(turned):
    radii = {"contact__radius_x": 0.02, "contact__radius_y": 0.0125}
    one, other = turned(10.0, 70.0), turned(80.0, 20.0, **radii)
    assert other.film.T == pytest.approx(one.film, abs=1e-13)


def test_motion_that_has_turned_is_motion_of_its_direction(tmp_path, monkeypatch):
    """Beside cavities it was asked along x alone whether what comes to a node was film."""
    scheme = {"discretization.couette": "3B", "discretization.face_mobility": "linear-gap"}
    ball = BALL | scheme | {"grid.x": [-2.5, 2.5], "grid.y": [-2.5, 2.5], "time.step": 0.03 * UNIT}
    (tmp_path / "angle.csv").write_text("0,0\n1e-7,90\n1,90\n")
    (tmp_path / "speed.csv").write_text("0,0.088\n1e-7,0.09\n1,0.09\n")
    start = mgehl.solve(mgehl.load(None, BALL | scheme | {"grid.x": [-2.5, 2.5], "grid.y": [-2.5, 2.5]}))
    turned, there = {"motion.angle": str(tmp_path / "angle.csv")}, {"motion.angle": 90.0}
    # Where motion turned no steady state is kept.
    monkeypatch.setattr("mgehl.solver.in_time.Reference", SimpleNamespace(of=lambda *steady: None))
    steps = {"time.end": 0.6 * UNIT, "motion.speed": str(tmp_path / "speed.csv")}  # the same steps
    one, other = (
        mgehl.solve(mgehl.load(None, ball | steps | motion), start=start) for motion in (turned, there)
    )
    assert one.fields.H == pytest.approx(other.fields.H, abs=1e-5)
    assert one.rows[-1]["rolling"] == pytest.approx(other.rows[-1]["rolling"], rel=1e-4)


def test_rolling_drags_against_a_reversed_motion_as_against_one_that_is_turned(tmp_path):
    start = solved(motion__slide_to_roll=0.1)
    (tmp_path / "speed.csv").write_text(f"0,0.09\n{0.01 * UNIT},-0.09\n1,-0.09\n")
    (tmp_path / "angle.csv").write_text("0,0\n1e-7,180\n1,180\n")
    courses = ({"motion.speed": str(tmp_path / "speed.csv")}, {"motion.angle": str(tmp_path / "angle.csv")})
    wide = BALL | {"grid.x": [-2.5, 2.0], "grid.y": [-2.0, 2.0], "time.end": 0.5 * UNIT}
    configs = (mgehl.load(None, wide | {"motion.slide_to_roll": 0.1} | course) for course in courses)
    reversed_, turned = (mgehl.solve(config, start=start) for config in configs)
    rolling = pytest.approx(turned.rows[-1]["rolling"], rel=0.01)
    assert reversed_.rows[-1]["rolling"] == rolling == reversed_.summary.friction.rolling_coefficient
    assert reversed_.motion == pytest.approx(turned.motion, abs=1e-12) == (-1.0, 0.0)
    for beyond in ("rolling_beyond", "sliding_beyond"):  # twice of it, of a film that does not tear
        found = [getattr(each.summary.friction, beyond) for each in (reversed_, turned)]
        assert found[0] == pytest.approx(found[1], rel=0.01) != 0.0


def test_the_path_goes_on_where_a_run_of_another_direction_starts_from_it(turned):
    """The part across the direction of the second run was lost."""
    first = turned(0.0, 90.0, time__end=0.35 * UNIT)
    along_x = {key.replace("__", "."): value for key, value in OBLONG.items()} | {"time.end": 0.1 * UNIT}
    second = mgehl.solve(mgehl.load(None, BALL | along_x), start=first)
    assert second.path == pytest.approx((first.path[0] + 0.09 * 0.1 * UNIT, first.path[1]))


def test_roughness_goes_along_where_the_motion_turns(turned):
    moving = {key.replace(".", "__"): value for key, value in ROUGH.items()} | {"surface__rms": 30e-9}
    first = turned(0.0, 90.0, **moving)
    assert first.summary.converged
    x, y = first.path
    there = ROUGH | {"surface.rms": 30e-9, "surface.body": "still", "surface.x": x, "surface.y": y}
    surface = contact_from(mgehl.load(None, BALL | there)).surface
    heights = surface.height(first.x[None, :], first.y[:, None])
    assert first.heights == pytest.approx(heights, abs=1e-12)


@pytest.mark.parametrize("how", ["by a function", "by a table"])
@pytest.mark.parametrize("key, first, last", [("contact.load", 15.0, 20.0), ("motion.speed", 0.09, 0.0)])
def test_what_jumps_makes_no_step_too_short(tmp_path, course, how, key, first, last):
    """Steps whose squeeze is all there is would not settle."""
    when, own = 0.1 * UNIT, tmp_path / "own.py"
    own.write_text(f"def jump(t):\n    return {first} if t < {when} else {last}\n")
    table = course((0.0, first), (when, first), (when + 1e-12, last), (1.0, last))
    after = solved({key: table if how == "by a table" else f"{own}:jump"}, time__end=0.2 * UNIT)
    times, steps = column(after, "time_s"), column(after, "step_s")
    assert after.summary.converged
    cells = (after.x[1] - after.x[0]) / after.contact.x_scale
    shortest = min(SHORTEST * UNIT * cells, SHORTEST_PART * 0.2 * UNIT)
    assert steps.min() > 0.99 * shortest
    name, begin = {"contact.load": ("load_share", 1.0), "motion.speed": ("speed_mm_s", 90.0)}[key]
    assert np.all(column(after, name)[times < when - 1e-9] == begin)
    assert np.all(column(after, name)[times > when + shortest] == begin * last / first)


def test_the_end_is_told_by_the_load_of_the_end(course):
    """Shares, area and mean gap are those that the history has of its last instant."""
    load = course((0.0, 5.0), (0.05 * UNIT, 10.0))
    wide = {"grid__x": [-2.5, 2.0], "grid__y": [-2.0, 2.0], "grid__nodes": 65}
    waves = {"surface__kind": "waviness", "surface__amplitude": 3e-8, "surface__wavelength_y": 6e-5}
    slow = {"motion__speed": 1e-4, "contact__boundary_film": 2e-9, "time__end": 0.05 * UNIT}
    after = solved(contact__load=load, **wide, **waves, **slow)
    result, last = after.summary, after.rows[-1]
    assert 0.5 < result.contact.load_fraction == pytest.approx(last["load_on_contact"], abs=1e-6)
    mixed, beyond = result.mixed, last["squeezed_beyond"]
    within = mixed.contact_load_share + mixed.film_load_share
    assert within + beyond == pytest.approx(1.0, abs=1e-4) and beyond > 0.05  # it doubles in 76 us
    assert mixed.mean_gap_nm == pytest.approx(last["mean_gap_nm"], rel=1e-6)
    hertz, larger = after.at_the_end, 2.0 ** (1.0 / 3.0)
    assert hertz.x_scale == pytest.approx(larger * after.contact.x_scale)
    inside = np.hypot(after.x[None, :], after.y[:, None]) <= hertz.x_scale
    assert mixed.mean_gap_nm == pytest.approx(1e9 * after.film[inside].mean())
    ends = (np.divide(wide[f"grid__{axis}"], larger) for axis in "xy")
    assert result.friction.rolling_beyond == pytest.approx(hertz.drag_beyond(Mesh(65, 65, *ends)) / 10.0)
    part = mixed.contact_area_m2 / (np.pi * hertz.x_scale * hertz.y_scale)
    assert mixed.contact_area_over_hertz == pytest.approx(part)


def test_the_inlet_is_that_of_the_slowest_motion_and_heat_that_of_the_end(course):
    """As many cells as at that speed in a steady state; heat at the end takes what it takes there."""
    speed = course((0.0, 0.09), (0.02 * UNIT, 0.03), (0.04 * UNIT, 0.06))
    oil = {"lubricant__conductivity": 0.14, "lubricant__thermoviscosity": 0.04}
    domain = {"grid__x": [-2.5, 1.5], "grid__y": [-2.0, 2.0]}
    after = solved(motion__speed=speed, time__end=0.04 * UNIT, **oil, **domain).summary
    slow, end = (contact_from(mgehl.load(None, BALL | {"motion.speed": u})) for u in (0.03, 0.06))
    mesh = Mesh(65, 65, (-2.5, 1.5), (-2.0, 2.0))
    found = after.resolution
    assert found.inlet_cells == pytest.approx(slow.inlet_cells(mesh))
    assert found.inlet_speed == pytest.approx(0.03) and not found.rests
    assert f"{found.inlet_cells:.2f} cells at the slowest, 30 mm/s, " in str(after)
    assert after.thermal_reduction == pytest.approx(end.heated_film(0.04, 0.14))


def test_lambda_is_that_of_the_end(course):
    """As at half of the speed in a steady state, and nothing at rest."""
    waves = {"surface.kind": "waviness", "surface.amplitude": 3e-8, "surface.wavelength_y": 6e-5}
    half = contact_from(mgehl.load(None, BALL | waves | {"motion.speed": 0.045}))
    for last, ratio in ((0.045, half.lambda_ratio), (0.0, 0.0)):
        speed = course((0.0, 0.09), (0.02 * UNIT, last))
        after = solved(waves, motion__speed=speed, time__end=0.02 * UNIT).summary
        assert after.mixed.lambda_ratio == pytest.approx(ratio)


def test_lambda_and_valleys_are_those_of_the_heights_of_the_end():
    """They were those of the beginning: next to no roughness where a dent comes in."""
    dent = {"surface.kind": "dent", "surface.amplitude": 1e-7, "surface.width": 6e-5}
    there = {"surface.x": 0.4 * UNIT * BALL["motion.speed"] - 1.8e-4}
    moves = {"surface.x": -1.8e-4, "surface.body": "body_1", "motion.slide_to_roll": 0.0}
    found = solved(dent | moves, time__end=0.4 * UNIT)
    contact, mixed = contact_from(mgehl.load(None, BALL | dent | there)), found.summary.mixed
    assert mixed.Sq_nm == pytest.approx(1e9 * contact.roughness, rel=1e-3) and mixed.Sq_nm > 3.0
    assert mixed.lambda_ratio == pytest.approx(contact.lambda_ratio, rel=1e-3)
    heights = found.fields.named["heights"]
    inside = np.hypot(*np.meshgrid(found.mesh.X, found.mesh.Y)) <= 1.0
    valleys = inside & (heights - contact.mean_height < -contact.roughness)
    assert mixed.valley_film_nm == pytest.approx(1e9 * found.film[valleys].mean())


def test_heat_thins_the_film_by_the_speed_of_the_instant(course):
    """From 8 to 2 m/s: what the film loses at the end is what it loses at 2 m/s, on finer grids nearer."""
    line = {
        "contact.kind": "line", "contact.load_per_length": 2e5, "contact.radius_x": 0.012,
        "contact.reduced_modulus": 226e9, "lubricant.viscosity": 0.05, "grid.x": [-6.0, 2.0],
        "grid.nodes": 129, "lubricant.conductivity": 0.14, "lubricant.thermoviscosity": 0.045,
        "motion.speed": course((0.0, 8.0), (1e-4, 2.0), (4e-4, 2.0)), "time.end": 4e-4,
        "motion.slide_to_roll": 0.5,
    }  # fmt: skip
    configs = (mgehl.load(None, line | {"lubricant.heating": how}) for how in ("none", "factor"))
    plain, heated = (mgehl.solve(config).summary for config in configs)
    assert heated.converged and plain.thermal_reduction == pytest.approx(heated.thermal_reduction)
    ratio = heated.central_film_nm / plain.central_film_nm
    assert ratio == pytest.approx(plain.thermal_reduction, abs=0.015) and ratio < 0.93


@pytest.fixture(scope="module")
def rough():
    return solved(ROUGH, time__end=0.4 * UNIT)


def test_rough_bodies_make_no_oil(rough):
    assert rough.summary.converged
    assert np.abs(column(rough, "closure")).max() < 1e-8
    assert rough.summary.time.largest_node < 1e-8
    assert rough.summary.complementarity_error < 1e-6
    # The steps' own choices are told beside those of the beginning.
    recipe = rough.summary.recipe
    assert recipe["squeeze"] > 0.0 == recipe["steps"]["squeeze"]
    assert column(rough, "load_on_contact").max() > 0.0
    assert np.all(column(rough, "load_on_solids") <= column(rough, "load_on_contact") + 1e-12)
    assert np.abs(column(rough, "load_error")).max() < 1e-4


def test_what_steps_leave_open_does_not_decide_the_load_on_solids(course):
    """Stiff oil that is carried into contact bears all of a load: in steps that left a thousandth of what
    they began with, solids of bodies that start from rest lost a third of it."""
    start = {"motion.speed": course((0.0, 0.0), (5e-3, 0.03)), "time.end": 1.7e-3, "solver.error": False}
    found = [
        mgehl.solve(mgehl.load("configs/passing_roughness.toml").with_(start | {"time.tolerance": each}))
        for each in (1e-3, 1e-6)
    ]
    loads = [column(each, "load_on_solids") for each in found]
    assert 0.8 < loads[0][-1] < 0.95
    assert loads[0] == pytest.approx(loads[1], abs=1e-3)


def went_on(start, **keys):
    named = {key.replace("__", "."): value for key, value in keys.items()}
    return mgehl.solve(mgehl.load(None, BALL | named), start=start)


@pytest.mark.parametrize("end", [None, 0.5 * UNIT])
def test_a_steady_film_stays_where_another_run_went_on_from_it(end):
    """By the paper's scheme it fell from 228 to 198 nm: what steps err about it was no longer known."""
    before = solved(**({"time__end": end} if end else {}))
    after = went_on(before, **{"time.end": UNIT})
    assert after.summary.central_film_nm == pytest.approx(before.summary.central_film_nm, rel=1e-6)
    assert end or np.diff(column(after, "convolutions")) == pytest.approx(1.0)


def test_a_run_goes_on_from_the_end_of_another_one_whose_load_has_changed(course):
    """Its units were taken for those of the first load: a film of 2700 nm for 156."""
    load = course((0.0, 15.0), (0.5 * UNIT, 6.0), (1.0 * UNIT, 6.0))
    lighter = solved(contact__load=load, time__end=0.8 * UNIT)
    after = went_on(lighter, contact__load=6.0, time__end=0.1 * UNIT)
    assert after.summary.converged
    for name, part in (("central_film_nm", 0.005), ("max_pressure_GPa", 0.01)):
        assert column(after, name)[0] == pytest.approx(column(lighter, name)[-1], rel=part)


def test_roughness_goes_on_from_where_it_is(course):
    moving = ROUGH | {"surface.rms": 30e-9}
    first, whole = (solved(moving, time__end=times * 0.3 * UNIT) for times in (1, 2))
    second = mgehl.solve(mgehl.load(None, BALL | moving | {"time.end": 0.3 * UNIT}), start=first)
    assert second.summary.converged
    assert second.heights == pytest.approx(whole.heights, abs=1e-13)
    inner = np.abs(second.x) < 1e-4
    assert second.film[:, inner] == pytest.approx(whole.film[:, inner], rel=0.05, abs=2e-9)
    with pytest.raises(UserError, match="start: its heights differ by .* % from those that this run in"):
        mgehl.solve(mgehl.load(None, BALL | moving | {"time.end": UNIT, "surface.seed": 4}), start=first)


def test_a_run_that_finds_no_beginning_can_be_read(tmp_path):
    """It has no step: its directory was called damaged, and a sweep ended there."""
    failed = solved(solver__max_steps=2, time__end=UNIT)
    failed.save(tmp_path / "failed")
    again = mgehl.read(tmp_path / "failed")
    assert not again.summary.converged and again.rows == [] and "beginning" not in str(again.summary.error)
    assert again.plot("film")


@pytest.mark.parametrize("grid", [{"x": "auto", "y": "auto"}, {"nodes": 129}])
def test_films_go_on_as_they_were_on_any_grid(grid):
    """Laid on another grid by straight lines the smallest film was 7 to 20 % thicker at once."""
    stood = solved(motion__speed=0.01)
    named = {f"grid.{key}": value for key, value in grid.items()}
    rests = {"motion.speed": 1e-6, "time.end": 1e-6}
    config = mgehl.load(None, {**{k: v for k, v in BALL.items() if k not in named}, **named, **rests})
    film = mgehl.solve(config, start=stood).rows[0]["minimum_film_nm"]
    assert film == pytest.approx(stood.summary.minimum_film_nm, rel=0.01)


def test_surfaces_that_stand_still_squeeze_a_film_out(course):
    """The same by a number and by a table; no formula, no inlet is told."""
    flows = solved(motion__speed=0.3)
    stands = BALL | {"motion.speed": 0.0, "time.end": 2e-4}
    after = mgehl.solve(mgehl.load(None, stands), start=flows)
    by_table = BALL | {"motion.speed": course((0.0, 0.0), (1.0, 0.0)), "time.end": 2e-4}
    table = mgehl.solve(mgehl.load(None, by_table), start=flows)
    assert after.summary.converged and table.fields.H == pytest.approx(after.fields.H, rel=1e-9)
    films = column(after, "minimum_film_nm")
    assert films[-1] < 0.95 * films[0] and (np.diff(films) < 0.0).all()
    assert (column(after, "squeezed_beyond") > 0.0).all()
    result, words = after.summary, str(after)
    assert result.groups is None and result.formulas == {} and result.resolution.verdict == "standing"
    assert "none: the surfaces stand still" in words and "passage" not in words
    assert "moes_M" not in after.to_xarray() and "moes_M" in flows.to_xarray()


def test_how_a_film_is_squeezed_does_not_hang_on_the_end_of_the_run():
    """The first step was a two-hundredth of the run: half of the side's film was gone in it."""
    flows = solved(motion__speed=0.3)
    short, long = (
        mgehl.solve(mgehl.load(None, BALL | {"motion.speed": 0.0, "time.end": end}), start=flows)
        for end in (5e-4, 5e-3)
    )
    film = np.interp(short.rows[-1]["time_s"], column(long, "time_s"), column(long, "minimum_film_nm"))
    assert film == pytest.approx(short.rows[-1]["minimum_film_nm"], rel=0.02)


class StopAfter:
    def __init__(self, steps):
        self.left = steps

    def __call__(self):
        self.left -= 1
        return Stopped("told to", 143) if self.left < 0 else None


def test_a_run_that_is_stopped_goes_on_with_the_same_bits(tmp_path):
    config = mgehl.load(None, BALL | ROUGH | {"time.end": 0.15 * UNIT})
    directories = [tmp_path / name for name in ("whole", "stopped")]
    for directory in directories:
        directory.mkdir()
    case, comm = enter(config, MPI.COMM_SELF), MPI.COMM_SELF
    run(case, directories[0], comm)
    stops = 0
    for steps in (3, 12, 1000):
        try:
            run(case, directories[1], comm, Watch(stop=StopAfter(steps)))
        except Stopped:
            stops += 1
    assert stops >= 2
    one, other = (mgehl.read(directory) for directory in directories)
    assert np.array_equal(one.fields.H, other.fields.H)
    assert [row["residual"] for row in one.rows] == [row["residual"] for row in other.rows]


def test_work_before_a_stop_counts_for_the_limit(tmp_path):
    """A run that was killed now and then made as many convolutions as it liked."""
    still = {"surface.body": "still", "solver.max_work": 50}
    case, comm = enter(mgehl.load(None, BALL | ROUGH | still), MPI.COMM_SELF), MPI.COMM_SELF
    directories = [tmp_path / name for name in ("whole", "stopped")]
    for directory in directories:
        directory.mkdir()
    whole = run(case, directories[0], comm)
    assert not whole.converged and "convolutions led to no answer" in whole.reason
    for steps in (4, 4, 1000):
        with suppress(Stopped):
            stopped = run(case, directories[1], comm, Watch(stop=StopAfter(steps)))
    assert stopped.reason == whole.reason and stopped.work.steps == whole.work.steps
    assert stopped.work.convolutions == pytest.approx(whole.work.convolutions, rel=1e-12)


def test_files_of_a_run_in_time(tmp_path):
    config = mgehl.load(None, BALL | {"time.end": UNIT, "time.save_every": 0.25 * UNIT})
    (tmp_path / "run").mkdir()
    run(enter(config, MPI.COMM_SELF), tmp_path / "run", MPI.COMM_SELF, Watch(save_every=0.0))
    solution = mgehl.read(tmp_path / "run")
    with h5netcdf.File(tmp_path / "run" / "series.nc") as series:
        assert series.attrs["Conventions"].startswith("CF")
        assert np.array_equal(series["time"][:], column(solution, "time_s"))
        assert np.array_equal(series["central_film_nm"][:], column(solution, "central_film_nm"))
    with h5netcdf.File(tmp_path / "run" / "frames.nc") as frames:
        assert frames["film"].shape[1:] == (65, 65)
        assert frames["film"][-1] == pytest.approx(solution.film, rel=1e-6)
        assert frames["filling"][-1] == pytest.approx(solution.fields.filling, rel=1e-6)
        flags = frames["status"].attrs
        assert dict(zip(flags["flag_values"], flags["flag_meanings"].split(), strict=True))[3] == "contact"
    assert json.loads((tmp_path / "run" / "result.json").read_text())["time"]["steps"] == len(solution.rows)


DENT = {"surface.kind": "dent", "surface.amplitude": 1e-7, "surface.width": 1e-5}


def test_frames_have_the_heights_where_they_are_and_what_cavities_hold():
    """A dent goes along with its body, a cell of 6 um a step."""
    dent = {"surface.kind": "dent", "surface.amplitude": 5e-8, "surface.width": 6e-5, "surface.x": -1e-4}
    solution = solved(**dent, surface__body="body_1", time__end=0.5 * UNIT, time__save_every=0.1 * UNIT)
    frames = list(solution.frames.all())
    for t, fields in frames:
        middle = fields["heights"][32]
        place = (middle * solution.x).sum() / middle.sum()
        assert place == pytest.approx(-1e-4 + 0.09 * t, abs=3e-6)
        assert (fields["filling"][fields["status"] != 2] == 1.0).all()
    assert len(frames) > 3 and frames[-1][1]["heights"] == pytest.approx(solution.heights, abs=1e-12)


@pytest.mark.parametrize("settings, what",
    [
        ({"motion.speed": [(0, 1), (1, 1)]}, "time.end is not given"),
        ({"motion.speed": [(0, 1), (1, 1)], "time.end": 2.0}, "must cover 0 to 2"),
        ({"motion.speed": 0.0}, "must be at least 1e-12"),
        ({"motion.speed": 1e-15, "time.end": 1.0}, "must be at least 1e-12"),
        ({"motion.speed": 0.0, "time.end": 1.0, "time.until": "settled"}, "is 0 at time.end"),
        ({"motion.speed": [(0, -1), (1, 1)], "time.end": 1.0}, "begins below 0"),
        ({"motion.speed": [(0, 1), (1, -1)], "time.end": 1.0, "grid.x": (-3.0, 1.1)}, "must end beyond"),
        ({"contact.load": [(0, 1), (1, 0)], "time.end": 1.0}, "must stay above 0"),
        ({"time.step": 2.0, "time.end": 1.0}, "must be at most 1"),
        ({"time.save_every": 2.0, "time.end": 1.0}, "must be at most 1"),
        ({"time.step": 1e-12, "time.end": 1.0}, "must be at least 1e-06"),
        ({"time.step": 2.0}, "without time.end"),
        ({"contact.load": [(0, 1), (1, 2)], "time.end": 1.0, "time.until": "settled"}, 'must be "end"'),
        ({"time.until": "settled"}, "means nothing without time.end"),
        ({"time.end": 1.0, "solver.method": "relaxation"}, "solver.method"),
        ({"time.end": 1.0, "discretization.contact_model": "unified"}, "discretization.contact_model"),
        (DENT | {"surface.body": "body_1"}, "give time.end"),
    ])  # fmt: skip
def test_what_is_refused(settings, what, course):
    settings = {key: course(*each) if isinstance(each, list) else each for key, each in settings.items()}
    with pytest.raises(ConfigError, match=what):
        enter(mgehl.load(None, BALL | settings), MPI.COMM_SELF)


def test_a_file_must_reach_as_far_as_it_goes(tmp_path):
    np.save(tmp_path / "map.npy", np.zeros((60, 60)))
    surface = {"surface.file": str(tmp_path / "map.npy"), "surface.body": "body_1"}
    surface |= {"surface.spacing": 1e-5, "surface.height_unit": "m"}
    enter(mgehl.load(None, BALL | surface | {"time.end": 0.1 * UNIT}), MPI.COMM_SELF)
    with pytest.raises(ConfigError, match="on its way ends inside the contact"):
        enter(mgehl.load(None, BALL | surface | {"time.end": 2.0 * UNIT}), MPI.COMM_SELF)
    case = enter(mgehl.load(None, BALL | surface | {"time.end": 0.1 * UNIT}), MPI.COMM_SELF)
    case.check_ways((0.01 * case.contact.x_scale, 0.0))
    with pytest.raises(ConfigError, match="on its way ends inside the contact"):
        case.check_ways((0.0, 2.0 * case.contact.x_scale))  # where the run that it starts from has ended


def test_an_end_before_the_means_have_settled_is_told():
    moving = ROUGH | {"surface.rms": 1e-9, "time.until": "settled"}
    assert "mean gap and load on solids have not" in solved(moving, time__end=0.1 * UNIT).summary.reason


def test_friction_beyond_the_domain_is_that_of_the_steady_state():
    """In time it was 0, and nothing was said: a third of the rolling of a light ball."""
    slides = {"motion__slide_to_roll": 0.1}
    both = solved(**slides), solved(**slides, time__end=0.1 * UNIT)
    steady, after = (each.summary.friction for each in both)
    assert after.rolling_beyond == pytest.approx(steady.rolling_beyond) != 0.0
    assert after.sliding_beyond == pytest.approx(steady.sliding_beyond) != 0.0


LIGHT = {
    "contact.radius_x": 0.01, "contact.reduced_modulus": 220e9, "lubricant.viscosity": 0.1,
    "lubricant.pressure_viscosity": 15e-9, "contact.boundary_film": 2e-9, "time.end": 2e-6,
    "grid.nodes": 65, "solver.error": False,
}  # fmt: skip
A_LINE = {"contact.kind": "line", "motion.speed": 1.0, "grid.nodes": 257, "grid.x": [-40.0, 20.0]}
A_BALL = {"contact.radius_y": 0.01, "motion.speed": 0.5, "grid.x": [-8.0, 5.0], "grid.y": [-6.0, 6.0]}


@pytest.mark.parametrize(
    "kind, key, load", [(A_LINE, "contact.load_per_length", 3e3), (A_BALL, "contact.load", 10.0)]
)
def test_a_load_that_leaps_stays_a_load(kind, key, load, course):
    """What a line squeezes out beyond its domain was fed by itself: 1600 GPa, and no step settled."""
    leaps = {key: course((0.0, load), (1e-7, 2.0 * load), (1.0, 2.0 * load))}
    after = mgehl.solve(mgehl.Config().with_(LIGHT | kind | leaps))
    assert after.summary.converged and column(after, "max_pressure_GPa").max() < 1.0
