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


@pytest.mark.parametrize(("squeeze", "told"), [(0.0, True), (10.0, False)])
def test_peaks_that_touch_are_told_of_shorter_steps(squeeze, told):
    tries = "\n".join(advice([f"solver.squeeze={squeeze}"], recipe={"peaks": "touching"}))
    assert ("solver.squeeze = 10" in tries) is told
    assert "solver.squeeze" not in "\n".join(advice(recipe={"peaks": "none"}))


UNSEEN = Resolution(0.25, "grid-determined", "sufficient", 0.1)
CUT = replace(NOT_SEEN, pressure_ratio=0.5)


@pytest.mark.parametrize(
    "settings, changes, first",
    [([], {"resolution": UNSEEN}, "the inlet has 0.25 cells and needs 4"),
     (["solver.max_work=20"], {"resolution": UNSEEN},
      "solver.max_steps, solver.max_work: more than 400, 20"),
     (["grid.x=[-1.05, 1.3]"], {"edge": CUT}, 'grid.x = "auto" and grid.y = "auto"'),
     ([], {"edge": CUT, "settled": True}, "grid.x = ["),
     ([], {"recipe": {"couette": "3L"}}, 'discretization.couette = "1B"')],
)  # fmt: skip
def test_what_comes_first(settings, changes, first):
    assert first in advice(settings, **changes)[1]


@pytest.mark.parametrize("settings", [["contact.kind=wedge"], ["discretization.contact_model=dry"]])
def test_what_has_no_film_is_told_nothing_of_one(settings):
    text = "\n".join(advice(settings))
    assert "max_steps" in text and "start" not in text
