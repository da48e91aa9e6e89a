"""What is foretold agrees with what runs do, as far as it claims to."""

from math import log
from pathlib import Path

import pytest
from mpi4py import MPI

from mgehl.config import chosen_config, config_from_tables, load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.kinds.point import CONTACT, FILM
from mgehl.output import forecast as module
from mgehl.output.forecast import MiB, bytes_of_nodes, bytes_of_rank, effort_of, forecast, inlet_grids
from mgehl.run import solve

CONFIGS = Path(__file__).resolve().parents[2] / "configs"


def film(nodes=257, speed=0.0075, **changes):
    settings = {"grid.nodes": nodes, "motion.speed": speed, "solver.start": "film"} | changes
    return load_config(settings=settings)


@pytest.fixture
def one_second(monkeypatch):
    """A machine on which the timed convolution takes a second."""
    monkeypatch.setattr(module, "time_convolution", lambda mesh: 1.0)
    monkeypatch.setattr(module, "cores_allowed", lambda: 2)


def foretold(config, ranks=1):
    contact = contact_from(config)
    return forecast(config, contact, mesh_from(config, contact), ranks)


def test_speeds_are_those_that_the_nested_iteration_solves_at():
    config = film(nodes=129, speed=0.2)
    grids = inlet_grids(config, contact_from(config))
    assert [grid.nodes for grid in grids] == [33, 65, 129]
    rows = solve(config, MPI.COMM_SELF).rows
    solved = {row["grid"]: row["speed_mm_s"] for row in rows}
    assert solved == {grid.nodes: pytest.approx(1e3 * grid.speed) for grid in grids if grid.speed}


def test_time_is_that_of_the_convolutions_on_the_cores_there_are(one_second):
    config = film(speed=0.5, **{"solver.error": False})
    one, two, three = (foretold(config, ranks) for ranks in (1, 2, 3))
    each, n = 1.0 + FILM.node_seconds * 257**2, FILM.convolutions
    assert one.seconds == pytest.approx(module.START_SECONDS + n * (each + FILM.beside))
    assert [found.workers for found in (one, two, three)] == [1, 2, 2]
    assert two.seconds == three.seconds == pytest.approx(one.seconds - 0.5 * n * each)


def rough_line(nodes):
    tables = {
        "contact": {"kind": "line", "load_per_length": 847e3, "radius_x": 18.5e-3},
        "motion": {"speed": 0.05},
        "surface": {"kind": "waviness", "amplitude": 200e-9, "wavelength_x": 44e-6},
        "grid": {"nodes": nodes},
    }
    return foretold(config_from_tables(tables))


def test_rough_lines_keep_two_matrices_and_factor_one(one_second):
    """As far as they are solved directly: from there on the matrices stay the same."""
    some, twice, largest, beyond = (rough_line(nodes) for nodes in (1025, 2049, 4097, 8193))
    assert 0.0 < twice.memory - some.memory - 16.0 * (2049**2 - 1025**2) < 6000.0 * 1025
    assert 0.0 < beyond.memory - largest.memory < 6000.0 * 4097
    rises = [
        more.seconds - less.seconds for less, more in ((some, twice), (twice, largest), (largest, beyond))
    ]
    assert rises[1] > 6.0 * rises[0] > 0.0 and rises[2] < 0.2 * rises[1]


@pytest.mark.parametrize("speed, effort", [(1e-3, module.UNSEEN), (0.5, FILM)])
def test_a_film_that_the_grid_hardly_sees_may_take_far_more(one_second, speed, effort):
    found = foretold(film(speed=speed, **{"solver.error": False}))
    assert found.convolutions == effort.convolutions and found.measured == effort.measured


@pytest.mark.parametrize("speed, effort", [(5e-6, CONTACT), (0.1, module.SIDE_BY_SIDE)])
def test_a_contact_start_takes_more_where_a_film_comes_up(one_second, speed, effort):
    found = foretold(film(speed=speed, **{"solver.start": "contact"}))
    assert found.convolutions == effort.convolutions


class TestPeaks:
    """Balls whose peaks reach through the film."""

    @pytest.mark.parametrize("start", ["film", "contact"])
    def test_they_are_foretold_by_roughness_and_film(self, one_second, start):
        found = foretold(load_config(chosen_config(), {"solver.start": start}))
        assert found.measured == module.ROUGH.measured
        slower = foretold(load_config(chosen_config(), {"solver.start": start, "motion.speed": 1e-5}))
        rougher = foretold(load_config(chosen_config(), {"solver.start": start, "surface.rms": 2e-7}))
        assert found.convolutions < min(slower.convolutions, rougher.convolutions)

    def test_a_thick_film_has_none(self, one_second):
        thick = load_config(chosen_config(), {"motion.speed": 0.5, "solver.error": False})
        assert foretold(thick).convolutions == FILM.convolutions


@pytest.mark.parametrize(
    "name, settings",
    [
        ("full_film", {"grid.nodes": 129, "motion.speed": 0.5}),
        ("point_contact", {"grid.nodes": 129}),
        ("rough", {}),
        ("rough", {"discretization.contact_model": "dry"}),
    ],
    ids=["full film", "contact", "rough", "dry"],
)
def test_runs_take_half_to_twice_the_convolutions(one_second, name, settings):
    config = load_config(CONFIGS / f"{name}.toml", settings)
    result = solve(config, MPI.COMM_SELF).result
    bands = 0.0 if config.is_dry else result.error.convolutions
    taken = result.work.convolutions + bands
    assert result.converged and 0.5 < taken / foretold(config).convolutions < 2.0


def test_a_convolution_grows_by_n_log_n_from_the_grid_that_was_timed(one_second):
    found = foretold(film(nodes=2049))
    assert found.timed_nodes == 513
    assert found.convolution_seconds == pytest.approx((2049 / 513) ** 2 * log(2049) / log(513))


def test_memory_is_that_of_the_runs_that_were_measured(one_second):
    """A film on 4097 by 4097 nodes took 14.2 to 14.4 GiB on two ranks. On 257 nodes rough balls took 450 to
    680 MiB, with nearby nodes solved at once 1010 to 1100."""
    rough, smooth = foretold(load_config(CONFIGS / "rough.toml")), foretold(film(nodes=4097), 2)
    assert smooth.memory / 2**30 == smooth.most_memory / 2**30 == pytest.approx(14.3, rel=0.01)
    assert 450.0 < rough.memory / MiB < 680.0 < 1010.0 < rough.most_memory / MiB < 1130.0


@pytest.mark.parametrize("kind, part", [("point", 0.25), ("line", 1.0)])
def test_what_one_rank_has_of_the_nodes(kind, part):
    """A line contact is solved by one rank."""
    config = load_config(settings={"contact.kind": kind, "motion.speed": 0.1, "grid.nodes": 257})
    contact = contact_from(config)
    mesh = mesh_from(config, contact)
    effort = effort_of(config, contact, mesh)
    assert bytes_of_rank(effort, mesh, 4) == pytest.approx(part * bytes_of_nodes(effort, mesh))
