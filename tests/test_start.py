"""A run says from what it began where that is not what was asked for."""

import json

import pytest
from mpi4py import MPI

from mgehl.config import chosen_config, load_config
from mgehl.output.report.run_report import report
from mgehl.output.stored import read_run
from mgehl.output.terminal import JsonLines, Lines
from mgehl.run import Watch, run
from mgehl.solver.from_config import FILM_INSTEAD

THICK_FILM = {
    "grid.nodes": 65, "motion.speed": "1 m/s", "surface.rms": "20 nm",
    "surface.shortest_wavelength": "60 um",
    "contact.boundary_film": 0.0, "solver.start": "contact", "solver.error": False,
}  # fmt: skip
"""Thicker than the roughness: contact would open everywhere."""


@pytest.fixture(scope="module")
def replaced(tmp_path_factory):
    """The directory of a run whose start from contact was replaced by one from a film."""
    directory = tmp_path_factory.mktemp("replaced")
    run(load_config(chosen_config(), THICK_FILM), directory, MPI.COMM_SELF)
    return directory


def test_it_stands_in_the_result_and_in_its_words(replaced):
    result = read_run(replaced).result
    assert result.start_note == FILM_INSTEAD
    assert json.loads((replaced / "result.json").read_text())["start_note"] == FILM_INSTEAD
    assert f"\n  start: {FILM_INSTEAD}\n" in result.words(verbose=False)


def test_it_stands_on_the_page_beside_the_films(replaced):
    films = next(
        section for section in report(read_run(replaced), "here").sections if section.anchor == "films"
    )
    assert any(FILM_INSTEAD in getattr(block, "text", "") for block in films.blocks)


@pytest.mark.parametrize("speaker", [Lines(), JsonLines()])
def test_it_is_said_before_the_first_cycle(speaker, tmp_path, capsys):
    settings = THICK_FILM | {"solver.max_steps": 0}
    run(load_config(chosen_config(), settings), tmp_path, MPI.COMM_SELF, Watch(speaker))
    assert FILM_INSTEAD in capsys.readouterr().out.splitlines()[0]


def test_a_run_from_another_runs_fields_has_no_such_start(replaced, tmp_path):
    config = load_config(chosen_config(), THICK_FILM)
    assert run(config, tmp_path, MPI.COMM_SELF, start=read_run(replaced)).start_note == ""
    asked = load_config(chosen_config(), THICK_FILM | {"solver.start": "film"})
    assert run(asked, tmp_path, MPI.COMM_SELF).start_note == ""
