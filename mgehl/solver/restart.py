"""A start from the fields of another run: another grid, another speed, another load."""

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.errors import UserError
from mgehl.grid.onto import onto, smoothly_onto
from mgehl.model.own_function import file_and_function
from mgehl.solver.beginning import OF_A_START, begin, first_found
from mgehl.solver.continuation import Continuation
from mgehl.solver.gaps import within_hertz
from mgehl.solver.nested import single_loop

FORECAST_STEPS = 40
"""Newton steps that a forecast may take before the way from the nearest solution is taken instead: the
speeds of rough.toml take 8 to 30 on 129 nodes, with the continuation's squeeze a fifth more work."""

THINNER = 0.5
"""A formula's film over that of a solution below which nothing is the better start. To thicker films a
solution leads as well. Convolutions on 129 nodes:

    film                           from a solution                    from nothing
    .63, smooth                    33, 30, 43                         36, 67, 56
    .25, smooth                    111, 55, 319                       32, 55, 58
    .21, rough, without layers     799, 339, 930, 2841, 2942          281, 306, 888, 813, 926
"""

OTHER_HEIGHTS = 0.05
"""Rms by which heights at the same X and Y may differ, over their own, where a solution is a start.
Convolutions of rough.toml on 129 nodes at 0.6 and 20 mm/s:

    differ by         from a solution           from nothing
    .01 to .05        160 to 258, 61 to 84      224 to 256, 134 to 144
    .07               319, 76                   245, 130
    .1                385, 368                  277, 136
    .27 and more      947 to 2250, 170 to 2246  141 to 391, 91 to 192

Wherever the pressure is laid, in m or in units of a, with Hertz's change or without, linear or cubic, what
differs by .27 takes more than from nothing.
"""

LEAST_LEFT = 0.2
"""Part of a pressure that a forecast leaves at the least."""


@dataclass(frozen=True)
class Forecast:
    """Two solutions on the way to the next one: what has changed from `before` to `last` goes on.

    Both `Solution`s are whole on rank 0. Without `before` the film alone changes, as a formula has it.
    """

    last: object
    before: object = None
    factor: float = 0.0
    """Change that is expected, over that from `before` to `last`."""

    def leads_to(self, contact, frame):
        """Whether a contact in a `Frame` is sooner found from here than from nothing.

        Another load moves the peaks, in units of a, as another surface does.
        """
        last = self.last.contact.in_frame(frame)
        thinner = contact.expected_film < THINNER * last.expected_film
        change = np.sqrt(np.mean((contact.heights - last.heights) ** 2))
        return bool(not thinner and change <= OTHER_HEIGHTS * contact.roughness)


def check_start(start, case):
    """Raise UserError where a `Solution` cannot start a `Case`, or is none; where its fields are.

    In time films go on between the same heights.
    """
    if not hasattr(start, "config"):
        raise UserError(f"start: is of type {type(start).__name__}; must be a Solution or a run directory")
    other, kind = start.config.contact.kind, case.config.contact.kind
    if other != kind:
        raise UserError(f"a {other} is no start for a {kind}")
    if not start.contact.is_loaded:
        raise UserError(f"a {kind} takes no start")
    if any(start.path):
        case.check_ways(start.path)
    if case.config.is_in_time and start.fields and (off := _other_heights(start, case)) > OTHER_HEIGHTS:
        raise UserError(
            f"start: its heights differ by {100.0 * off:.3g} % from those that this run in time begins "
            "with: films go on between the same heights, moved by the same motion.slide_to_roll"
        )


def _other_heights(start, case):
    """Rms by which heights differ from those of a `Solution` at its end, over the rougher ones."""
    surface, old = case.scene.surface_at(start.path), start.heights
    now = surface.height(start.x[None, :], start.y[:, None]) if surface else 0.0
    heights = (np.broadcast_to(0.0 if each is None else each, start.fields.P.shape) for each in (now, old))
    inside = within_hertz(start.mesh)
    now, old = (each[inside] - each[inside].mean() for each in heights)
    rougher = max(np.sum(now**2), np.sum(old**2))
    return float(np.sqrt(np.sum((now - old) ** 2) / rougher)) if rougher else 0.0


DIFFER = ("contact", "coating", "lubricant", "discretization")
"""Sections of a configuration that describe the contact: where they differ, a start is of another contact.
"""

OF_A_CASE = ("contact.load", "contact.load_per_length")
"""Keys of these sections in which a start may differ: the solution is carried from its value to the new
one."""


def differing_keys(start, config):
    """Keys in which the `Config` of a start describes another contact than `config`."""
    ours, theirs = config.as_toml_tables(), start.config.as_toml_tables()
    no_matter = {*OF_A_CASE, *config.unused}
    for section in DIFFER:
        if section in no_matter:
            continue
        one, other = ours.get(section, {}), theirs.get(section, {})
        for key in sorted(one.keys() | other.keys()):
            if f"{section}.{key}" not in no_matter and _plain(one.get(key)) != _plain(other.get(key)):
                yield f"{section}.{key}"


def _plain(value):
    """A value, of an own function without its directory."""
    own = file_and_function(value)
    return (Path(own[0]).name, own[1]) if own else value


def solve_from(task, start, frame):
    """Solve a `Task` on the finest grid from another run's fields; otherwise as `nested_iteration`.

    `start` is a `Solution` whose whole fields rank 0 has, or a `Forecast`; the contact is one in a `Frame`.
    From another speed it is carried here, in smaller steps where one is too large. What no start leads to
    is looked for from nothing, and what a `Forecast` hardly leads to is so at first. Contact that shuts its
    faces is not: there two states may be answers, and a start names the one that is meant.
    """
    settings = task.settings
    if not settings.by_newton or not settings.scheme.contact_law.is_continuous:
        return _from_fields(task, start, frame)
    from_start = partial(_from_fields, start=start, frame=frame)
    ways = [("that start", lambda task: from_start(task.within(OF_A_START))), ("nothing", _from_nothing)]
    if isinstance(start, Forecast) and not start.leads_to(task.contact, frame):
        ways.reverse()
    return first_found(task, ways)


def _from_nothing(task):
    """Problem and `Outcome` of a `Task` without another run's fields."""
    problem, outcome = begin(task)
    return problem, replace(outcome, begins=outcome.begins or task.recipe.begins)


def _from_fields(task, start, frame):
    """Problem and `Outcome` of a `Task` from another run's fields alone."""
    problem, contact, settings = task.problem(), task.contact, task.settings
    forecast, start = (start, start.last) if isinstance(start, Forecast) else (None, start)
    state = interpolated(problem, start, frame)
    if not settings.by_newton:
        return single_loop(task, state)
    continuation = Continuation(task)
    if forecast:
        patient = min(FORECAST_STEPS, settings.newton.max_steps)
        limits = {"max_steps": patient, "squeeze": settings.newton.squeeze}
        found = continuation.at(contact.speed, forecast_state(problem, state, forecast, frame), **limits)
        if found[1].converged:
            return found
    speed = contact.speed if start.is_dry else start.contact.speed
    if speed == contact.speed:
        return continuation.at(speed, state)
    return continuation.follow(state, speed, contact.speed)


def forecast_state(problem, last, forecast, frame):
    """The state that a `Forecast` in a `Frame` expects of this problem; `last` is the last one of it."""
    if forecast.before is None:
        films = problem.contact.expected_film, forecast.last.contact.expected_film
        H0 = last.H0 + (films[0] - films[1]) / problem.contact.film_scale
        return problem.state(last.P, H0, last.status, last.p, last.filling)
    before = interpolated(problem, forecast.before, frame)

    def on(newer, older):
        more, torn = newer + forecast.factor * (newer - older), problem.contact.tears_at
        least = torn + LEAST_LEFT * (newer - torn)
        return np.where(last.P > torn, np.maximum(more, least), torn)

    P = on(last.P, before.P)
    p = np.minimum(on(last.p, before.p), P)
    H0 = last.H0 + forecast.factor * (last.H0 - before.H0)
    return problem.state(P, H0, last.status, p, last.filling)


def interpolated(problem, start, frame):
    """The fields of a `Solution` as a `State` of this problem in a `Frame` (collective).

    P over p_h is bilinear in X and Y, those of each load's own Hertz contact, and zero outside of what was
    solved. A node is in contact where most of its surroundings were.
    """
    grid, contact, stood, before = problem.grid, problem.contact, start.contact, start.at_the_end
    whole = _laid_on(problem, start, frame) if grid.comm.rank == 0 else [None] * 4
    P, p, filling, status = (grid.scatter(each) for each in whole)
    # Of H0 the dry approach is the new contact's; what lies between the bodies is as thick as before, in m.
    between = grid.comm.bcast(start.H0) * stood.film_scale + before.approach * before.film_scale
    H0 = between / contact.film_scale - contact.approach
    return problem.state(P, H0, status, p, filling)


def _laid_on(problem, start, frame):
    """P, p, fillings and status of a `Solution` at the nodes of this problem's whole grid."""
    mesh, fields, before = problem.grid.mesh, start.fields, start.at_the_end
    # The units of a run in time are those of its first load.
    wider = start.contact.x_scale / before.x_scale
    higher = start.contact.pressure_scale / before.pressure_scale
    old = _stretched(start.mesh.in_frame(frame), wider, wider)

    def laid(values):
        return onto(mesh, old, frame.array(values))

    P, p = higher * laid(fields.P), higher * laid(fields.fluid_pressure)
    filling = 1.0 - laid(1.0 - fields.full_part)  # full outside
    status = problem.status_of(P, laid((fields.status == CONTACT).astype(float)))
    if problem.scheme.cavitation:  # oil around it may have had another pressure
        P, p = (np.maximum(each, problem.contact.tears_at) for each in (P, p))
    return P, p, filling, status


def begun_in_time(problem, start, frame):
    """The same for a run in time, whose films go on as they were: H is that of the `Solution`, at the same
    place in m, and no more that of P (collective)."""
    grid, mesh, contact = problem.grid, problem.grid.mesh, problem.contact
    state, H = interpolated(problem, start, frame), None
    if grid.comm.rank == 0:
        stood = start.contact.in_frame(frame)
        wider = stood.x_scale / contact.x_scale, stood.y_scale / contact.y_scale
        old = _stretched(start.mesh.in_frame(frame), *wider)
        scale = start.contact.film_scale / contact.film_scale
        # Between the nodes of a parabola a straight line lies a film too high.
        H = scale * smoothly_onto(mesh, old, frame.array(start.fields.H))
    H = grid.scatter(H)
    state.H = np.where(np.isnan(H), state.H, np.maximum(H, problem.scheme.contact_law.contact_gap))
    return state


def _stretched(mesh, x, y):
    """A mesh in other units: `x` of those along X make an old one, and `y` along Y."""
    return replace(mesh, x=tuple(x * end for end in mesh.x), y=tuple(y * end for end in mesh.y))
