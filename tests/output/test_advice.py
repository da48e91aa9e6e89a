from dataclasses import replace

import pytest
from made_solution import make_result

from mgehl.config import load_config
from mgehl.kinds import contact_from, with_domain
from mgehl.output.advice import MOST, what_next
from mgehl.output.resolution import Resolution
from mgehl.output.result import NOT_SEEN
from mgehl.output.solution import Solution


def advice(settings=(), **changes):
    """Of a run with these settings that did not converge."""
    config = load_config(settings=["grid.nodes=65", *settings])
    contact = contact_from(config)
    config = with_domain(config, contact)
    result = make_result(**({"converged": False} | changes))
    return what_next(Solution(config, contact, None, None, [], result))


def test_none_of_a_run_that_converged():
    assert advice(converged=True) == []


@pytest.mark.parametrize("start, other", [("film", "contact"), ("contact", "film")])
def test_the_other_start(start, other):
    head, *tries = advice([f"solver.start={start}"])
    assert head == "what to try next:" and len(tries) <= MOST
    assert any(f'solver.start = "{other}"' in each for each in tries)


def test_a_grid_that_does_not_see_the_inlet_comes_first():
    _, first, *_ = advice(resolution=Resolution(0.25, "grid-determined", "sufficient", 0.1))
    assert "the inlet has 0.25 cells and needs 4" in first and "mgehl check" in first


def test_a_domain_that_cuts_the_contact():
    _, first, *_ = advice(["grid.x=[-1.05, 1.3]"], edge=replace(NOT_SEEN, pressure_ratio=0.5))
    assert first.startswith('  grid.x = "auto" and grid.y = "auto"')
    _, *alone = advice(edge=replace(NOT_SEEN, pressure_ratio=0.5), settled=True)
    assert len(alone) == 1 and alone[0].startswith("  grid.x = [")


def test_a_limit_that_was_lowered_comes_first():
    _, first, *_ = advice(["solver.max_work=20"], resolution=Resolution(0.25, "grid-determined", "", 0.1))
    assert first.startswith("  solver.max_steps, solver.max_work: more than 400, 20")


@pytest.mark.parametrize(("squeeze", "told"), [(0.0, True), (10.0, False)])
def test_peaks_that_touch_are_told_of_shorter_steps(squeeze, told):
    tries = "\n".join(advice([f"solver.squeeze={squeeze}"], recipe={"peaks": "touching"}))
    assert ("solver.squeeze = 10" in tries) is told
    assert "solver.squeeze" not in "\n".join(advice(recipe={"peaks": "none"}))


@pytest.mark.parametrize(("couette", "told"), [("3L", True), ("1B", False)])
def test_the_first_order_scheme_is_told_of_where_it_was_not_used(couette, told):
    first = advice(recipe={"couette": couette})[1]
    assert first.startswith('  discretization.couette = "1B"') is told


@pytest.mark.parametrize("settings", [["contact.kind=wedge"], ["discretization.contact_model=dry"]])
def test_what_has_no_film_is_told_nothing_of_one(settings):
    text = "\n".join(advice(settings))
    assert "max_steps" in text and "start" not in text
