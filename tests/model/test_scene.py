import numpy as np
import pytest

from mgehl.config import load_config
from mgehl.discretization.mesh import Mesh
from mgehl.kinds import contact_from
from mgehl.kinds.time import scene_of
from mgehl.solver.pace import Pace, expected_steps

WAVES = {"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_x": 1e-4}


def scene(settings):
    config = load_config(settings={"time.end": 1.0, "grid.nodes": 65, "motion.speed": 0.1} | settings)
    return scene_of(config, contact_from(config))


@pytest.mark.parametrize(
    "body, slide_to_roll, lengths",
    [("still", 1.0, 1.0), ("body_1", 1.0, 1.0 / 1.5), ("body_2", 1.0, 2.0), ("body_1", -1.9, 20.0),
     ("body_2", 2.5, 4.0), ("body_2", 2.0, 1.0)],
)  # fmt: skip
def test_a_passage_is_that_of_the_slowest_heights(body, slide_to_roll, lengths):
    """Those that go against the motion pass, too; those that rest never do."""
    found = scene(WAVES | {"surface.body": body, "motion.slide_to_roll": slide_to_roll})
    assert found.passage() == pytest.approx(lengths * 2.0 * found.framed.x_scale)
    assert bool(found.surface_at((0.0, 0.0)).moving) == (lengths != 1.0)  # back where they were, too


def test_a_heavier_load_takes_longer_to_pass():
    found = scene(WAVES)
    assert found.passage(8.0) == pytest.approx(2.0 * found.passage())


def test_a_wide_ellipse_takes_longer_to_pass_across():
    """Along x its short semi-axis, along y the long one, in between a chord."""
    wide = scene(WAVES | {"contact.radius_y": 0.2})
    a, b = wide.contact.x_scale, wide.contact.y_scale
    assert wide.passage() == pytest.approx(2.0 * a)
    chord = 2.0 * np.sqrt(2.0) / np.hypot(1.0 / a, 1.0 / b)
    assert wide.passage(1.0, np.array([0.0, 45.0, 90.0])) == pytest.approx([2.0 * a, chord, 2.0 * b])


def test_ridges_along_the_motion_do_not_pass():
    ridges = {"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_y": 1e-4}
    found = scene(ridges | {"surface.body": "body_2", "motion.slide_to_roll": 1.0})
    assert found.passage() == pytest.approx(2.0 * found.framed.x_scale)


@pytest.mark.parametrize(
    "rows, slowest, rests",
    [("0,8\n0.4,0.3\n1,0.3\n", 0.4, False), ("0,0.3\n1,8\n", 0.0, False),
     ("0,0\n0.5,4\n1,8\n", 1.0, True), ("0,0\n0.2,8\n0.6,0.3\n1,0.3\n", 0.6, True),
     ("0,8\n0.5,-8\n1,-2\n", 1.0, True), ("0,8\n0.5,1e-9\n1,4\n", 0.0, True)],
)  # fmt: skip
def test_the_slowest_motion_is_where_the_speed_turns_or_stays(tmp_path, rows, slowest, rests):
    """On the way to rest and from it every speed is passed: there the largest counts."""
    (tmp_path / "speed.csv").write_text(rows)
    found = scene({"motion.speed": str(tmp_path / "speed.csv")})
    assert (found.slowest, found.rests) == (slowest, rests)


def test_of_equal_speeds_the_heaviest_load_is_the_slowest(tmp_path):
    (tmp_path / "load.csv").write_text("0,10\n0.25,80\n1,20\n")
    found = scene({"contact.load": str(tmp_path / "load.csv")})
    assert (found.slowest, found.rests, found.is_steady) == (0.25, False, True)
    there = found.instant(found.contact, 0.25)
    assert (there.load, there.speed) == (80.0, 0.1)
    assert found.instant(found.contact, 0.0) is found.contact


def turning(tmp_path, rows, **settings):
    (tmp_path / "angle.csv").write_text(rows)
    named = {key.replace("__", "."): value for key, value in settings.items()}
    return scene(named | {"motion.angle": str(tmp_path / "angle.csv")})


@pytest.mark.parametrize("first, last", [(0.0, 90.0), (0.0, -90.0), (200.0, 110.0), (90.0, 450.0)])
def test_a_surface_whose_direction_turns_goes_along_a_circle(tmp_path, first, last):
    found = turning(tmp_path, f"0,{first}\n1,{last}\n")
    circle = 0.1 / np.radians(last - first)
    begin, end = np.radians([first, last])
    there = circle * (np.sin(end) - np.sin(begin)), circle * (np.cos(begin) - np.cos(end))
    parts = [found.way(*ends) for ends in ((0.0, 0.3), (0.3, 0.6), (0.6, 1.0))]
    assert np.sum(parts, axis=0) == pytest.approx(there, abs=1e-9)
    assert np.linalg.norm(found.velocity(0.4)) == pytest.approx(0.1)


def test_the_contact_of_an_instant_is_turned_in_the_users_axes_and_in_those_of_the_solve(tmp_path):
    found = turning(tmp_path, "0,200\n1,300\n", contact__radius_y=0.02)
    users, there = (found.instant(contact, 0.5) for contact in (found.contact, found.framed))
    assert users.angle == pytest.approx(250.0)
    assert there.motion == pytest.approx(found.contact.frame.vector(*users.motion))
    assert there.aligned.radius_x == pytest.approx(users.aligned.radius_x)


def test_ridges_along_the_motion_pass_where_it_turns(tmp_path):
    ridges = {"surface__kind": "waviness", "surface__amplitude": 1e-8, "surface__wavelength_y": 1e-4}
    moving = ridges | {"surface__body": "body_1"}
    assert not scene({key.replace("__", "."): value for key, value in moving.items()}).moves
    assert turning(tmp_path, "0,0\n1,1\n", **moving).moves


def test_heat_thins_the_oil_by_the_speed_and_the_load_of_the_instant(tmp_path):
    """As in a steady state there, and not at all at rest."""
    oil = {"lubricant.conductivity": 0.14, "lubricant.thermoviscosity": 0.04, "lubricant.heating": "factor"}
    (tmp_path / "speed.csv").write_text("0,4\n0.5,1\n1,0\n")
    (tmp_path / "load.csv").write_text("0,10\n1,30\n")
    courses = {"motion.speed": str(tmp_path / "speed.csv"), "contact.load": str(tmp_path / "load.csv")}
    found = scene(oil | courses)
    steady = contact_from(load_config(settings=oil | {"motion.speed": 1.0, "contact.load": 20.0}))
    thinned = [found.instant(found.contact, t).lubricant.thinned for t in (0.0, 0.5, 1.0)]
    assert thinned[1:] == [pytest.approx(steady.lubricant.thinned), 1.0]
    assert thinned[0] == found.contact.lubricant.thinned < thinned[1] < 1.0


@pytest.mark.parametrize(
    "viscosity, cells, taken",
    [(200.0, 0.5, 0.5), (200.0, 30.0, 4.0), (5.0, 30.0, 0.2 * 3.482), (5.0, 0.5, 0.5), (0.1, 30.0, 0.25)],
)  # fmt: skip
def test_a_step_that_is_asked_for_is_cut_to_the_cells_that_a_film_bears(viscosity, cells, taken):
    """A steady film of 127 nm walked off to 210 by steps of 8 cells, and was called converged; by one cell
    with two in the inlet it was 5 % too thin."""
    found, mesh = scene({"lubricant.viscosity": viscosity}), Mesh(65, 65, (-2.0, 2.0), (-2.0, 2.0))
    cell = mesh.dX * found.framed.x_scale / 0.1
    pace = Pace(found, mesh, cells * cell)
    assert pace.fitted(0.0, pace.first()) == pytest.approx(taken * cell, rel=1e-3)


def loads_seen(load, end, step, speed=0.01):
    found = scene({"contact.load": str(load), "time.end": end, "motion.speed": speed})
    pace, t, seen = Pace(found, Mesh(65, 65, (-2.0, 2.0), (-2.0, 2.0)), step), 0.0, []
    while t < found.end * (1.0 - 1e-9):
        t += pace.fitted(t, step)
        seen.append(found.load.value(t))
    return seen


PULSE = "lambda t: 20.0 * (1.0 + 2.0 * np.exp(-(((t - 5.3e-4) / 1e-5) ** 2)))"
WAVE, NOISE = np.linspace(0.0, 1e-2, 10_001), np.linspace(0.0, 1e-2, 1_001)
COURSES = {
    "a function's pulse": (None, 1e-3, 1e-4, 0.01, lambda seen: max(seen) > 0.9 * 60.0),
    "a table's pulse": (([0, 0.15, 0.1505, 0.151, 0.3], [20, 20, 40, 20, 20]), 0.3, 0.05, 1e-4,
                        lambda seen: max(seen) == 40.0),
    "an even fall": (([0, 0.15, 0.151, 0.3], [20, 20, 2, 2]), 0.3, 0.05, 1e-4,
                     lambda seen: sum(2.0 < load < 20.0 for load in seen) >= 4),
    "ten thousand rows of a wave": ((WAVE, 20.0 + 10.0 * np.sin(2e2 * np.pi * WAVE)), 1e-2, 1e-3, 0.005,
                                    lambda seen: max(seen) > 29.5 and min(seen) < 10.5),
    "noise": ((NOISE, 20.0 + 1e-3 * np.random.default_rng(1).standard_normal(1_001)), 1e-2, 1e-3, 0.005,
              all),
}  # fmt: skip


@pytest.mark.parametrize("rows, end, step, speed, is_seen", COURSES.values(), ids=COURSES)
def test_steps_see_what_a_load_does_and_are_few(tmp_path, rows, end, step, speed, is_seen):
    """A load that is three times as large for 20 us of 1 ms: steps of 100 us saw nothing of it."""
    (tmp_path / "mine.py").write_text(f"import numpy as np\nload = {PULSE}\n")
    if rows:
        np.savetxt(tmp_path / "load.csv", np.column_stack(rows), delimiter=",")
    seen = loads_seen(tmp_path / "load.csv" if rows else f"{tmp_path}/mine.py:load", end, step, speed)
    assert is_seen(seen) and len(seen) < 40


@pytest.mark.parametrize("periods", [10, 1000])
def test_steps_of_a_wave_are_foretold(tmp_path, periods):
    """Ten or so in each period, though surfaces hardly move meanwhile; of many the first are counted."""
    end = 1e-5 * periods
    wave = f"20.0 * (1.0 + 0.5 * math.sin({2e5 * np.pi} * t))"
    (tmp_path / "mine.py").write_text(f"import math\ndef load(t):\n    return {wave}\n")
    load = f"{tmp_path}/mine.py:load"
    found = scene({"contact.load": load, "time.end": end, "motion.speed": 0.01})
    steps = expected_steps(found, Mesh(65, 65, (-2.0, 2.0), (-2.0, 2.0)))
    assert 7 * periods < steps < 20 * periods
