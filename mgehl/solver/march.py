"""A contact in time: step after step, each a solve of its own (`carry` says what one hands to the next).

    bodies, load, speed, oil    as they are at its end          mgehl.solver.problem.ContactProblem.turn_to
    contents                    carried along                   mgehl.solver.carry.Transport.leg
    first guess                 the states before, continued    mgehl.solver.march.March._guess
    pressures, sets             Newton's method                 mgehl.solver.step_solve.StepSolve.solved

A step that does not settle is halved.
"""

from dataclasses import dataclass, field

import numpy as np

from mgehl.discretization.status import BOUNDARY, CONTACT
from mgehl.discretization.storage import content
from mgehl.discretization.transport import Shift, moved
from mgehl.solver.beyond import Beyond
from mgehl.solver.carry import Carried, Reference, Transport
from mgehl.solver.extrapolation import alike, curvature, fading, weights_at
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.outcome import Outcome
from mgehl.solver.pace import HALVINGS, Pace
from mgehl.solver.problem import State
from mgehl.solver.record import Kept, Record
from mgehl.solver.step_solve import StepSolve

SUDDEN = 0.3
"""Change of the speed in a step, over the largest one, after which nothing is known of steps before."""

TRIES, NO_GAP = 3, 1e-9
"""First steps that are tried, and gap below which its change tells nothing."""

GAPS = 2.0
"""Times that what gaps are off counts: a squeezed film is told to .1 %, not to .2 %."""

NOT_THE_LAST = "all steps in time settled, the last instant does not to the last digits: "
"""Why a run that reached its end is not converged."""

LOOKS_BACK = 3
"""States that the first guess of a step is made of: a parabola in time."""


@dataclass
class Standing(Kept):
    """Where a run in time stands: all that the way from here depends on."""

    PARTS = {"state": State, "carried": Carried, "reference": Reference, "memory": Record}

    state: State
    carried: Carried
    t: float
    path: list
    """Way in m, along the user's x and y, that the mean surface has gone from the beginning of the run that
    this one started from."""
    step: float
    """In s, the next one that is tried."""
    number: int = 0
    times: list = field(default_factory=list)
    """Of the last states, the present one the last."""
    P: np.ndarray | None = None
    """Their pressures, (states, lines, nx)."""
    H0: list = field(default_factory=list)
    H: np.ndarray | None = None
    """Their gaps, of surfaces that stand still alone."""
    reference: Reference | None = None
    """The steady state at the beginning, where no heights move."""
    memory: Kept | Record | None = None
    """Of the linear systems before: what the linear solver has, or what was kept of it."""


@dataclass
class Instant:
    """A step that has ended: what a history has of it."""

    number: int
    t: float
    step: float
    speed: float
    load: float
    """Over that of the contact."""
    newton: Outcome
    stored: float
    """Oil in the domain, the layers' apart, in units of H, X and Y."""
    closure: float
    """By how much the account of the oil is off in this step, over what is stored."""
    halvings: int


class March:
    """Runs a `Scene` in time, on a problem and a `Newton` that stand at its beginning."""

    def __init__(
        self, scene, problem, newton, settings, told=lambda instant, standing, problem: "", pace=None
    ):
        """`newton` solves each step; `settings` are a `TimeSettings`. `told` is called with each
        `Instant`, the `Standing` after it and the problem; what it returns ends the run, in words.
        Without a `pace` steps are as long as `Pace` says."""
        self._scene, self._problem, self._newton, self._told = scene, problem, newton, told
        self._settings, self._pace = settings, pace or Pace(scene, problem.grid.mesh, settings.step)
        self._transport, self._beyond = Transport(problem), Beyond(problem)
        self._solve = StepSolve(problem, newton, settings)

    def run(self, state, path=(0.0, 0.0), reference=None, journal=NOTHING_KEPT):
        """March from a `state`, which is the march's own from now on; return the `Outcome`.

        The mean surface has gone a `path` before. With the `Reference` that the state is, if it is
        steady and no heights move.
        """
        grid = self._problem.grid
        standing = journal.standing(grid, Standing.from_record)
        if standing is None:
            first = self._transport.begin(state)
            standing = Standing(state, first, 0.0, list(path), self._pace.first())
            standing.reference = reference
            self._remember(standing)
        standing.memory = self._newton.remembered(standing.memory)
        reason = ""
        while not reason and standing.t < self._scene.end * (1.0 - 1e-9):
            journal.step(grid, standing)
            instant = self._advance(standing)
            if instant is None:
                t = 1e3 * standing.t
                return self._ended(standing, False, f"at {t:.6g} ms no step in time settles: {self._why}")
            reason = self._told(instant, standing, self._problem)
        return self._ended(standing, True, reason or "all steps in time settled")

    def _ended(self, standing, converged, reason):
        """The `Outcome` of the last step, solved to the last digits, or of where the run was given up."""
        self._turn(standing.t, standing.path)
        if converged and self._problem.storage is not None:
            last = self._newton.run(standing.state.copy(), tolerance=self._settings.least)
            converged, reason = last.converged, reason if last.converged else NOT_THE_LAST + last.reason
            standing.state = last.state if last.converged else standing.state
        return Outcome(standing.state, converged, reason)

    def _turn(self, t, path):
        """Let bodies, load, speed and oil be as they are at a time."""
        scene = self._scene
        self._problem.turn_to(scene.at(path), scene.instant(scene.framed, t), scene.sense(t))

    def _advance(self, standing):
        """Take one step, halved as often as need be; return its `Instant`, None where it never settles."""
        step = self._gentle(standing, self._pace.fitted(standing.t, standing.step))
        for halvings in range(HALVINGS):
            if (found := self._tried(standing, step, halvings)) is not None:
                return found
            step *= 0.5
        return None

    def _tried(self, standing, step, halvings):
        """The `Instant` of a step in s, None where it does not settle; else `standing` has moved on."""
        scene, problem, t = self._scene, self._problem, standing.t + step
        path = np.add(standing.path, scene.way(standing.t, t)).tolist()
        leg, reference, newton = self._after(standing, step, path, halvings)
        if not newton.converged:
            self._why = newton.reason
            return None
        evaluation = problem.evaluate(newton.state)
        stored, closure = self._account(leg, standing.carried, evaluation)
        error = self._error(standing, t, newton.state)
        standing.state, standing.carried = newton.state, self._transport.ended(leg, evaluation)
        standing.t, standing.path, standing.number = t, path, standing.number + 1
        standing.reference = reference
        standing.step = self._pace.next(t, step, error, halvings > 0)
        self._remember(standing)
        speed, load = scene.speed.value(t), scene.load_share(t)
        return Instant(standing.number, t, step, speed, load, newton, stored, closure, halvings)

    def _after(self, standing, step, path, halvings=0):
        """The `Leg` of a step in s on a path, the `Reference` after it, and Newton's `Outcome`."""
        scene, problem, t = self._scene, self._problem, standing.t + step
        way = scene.way(standing.t, t)
        self._turn(t, path)
        leg, reference = self._leg(standing, step, way)
        problem.storage = leg.storage
        self._beyond.resist(standing.state, leg.dT, scene.load_share(t) / scene.load_share(standing.t))
        return leg, reference, self._solve.solved(self._guess(standing, t, way, halvings), leg)

    def _gentle(self, standing, step):
        """As much of the first step as changes no gap by more than it may, as a longer one tells. A load
        that leaps changes gaps in any."""
        most, before = self._pace.first_change, standing.state.H
        for _ in range(TRIES if most and not standing.number else 0):
            *_, newton = self._after(standing, step, standing.path)
            changed = np.abs(newton.state.H - before) / np.maximum(before, NO_GAP)
            largest = self._problem.grid.max(changed, initial=0.0)
            if not newton.converged or largest <= most:
                break
            step *= 0.5 * most / largest
        return step

    def _leg(self, standing, step, way):
        """The `Leg` of a step in s in which the mean surface goes a way, and the `Reference` after it.

        Where the velocity changes much, what passed the faces in the step before tells nothing.
        """
        scene, carried = self._scene, standing.carried
        before, after = (scene.velocity(t) for t in (standing.t, standing.t + step))
        if np.linalg.norm(after - before) > SUDDEN * scene.contact.speed:
            carried = carried.afresh()
        # What is steady at the beginning is not steady under motion that turned.
        along = float(np.dot(way, scene.contact.motion))
        stays = along >= 0.0 and not scene.has_turned(standing.t + step)
        reference = standing.reference if stays else None
        shift = Shift(*scene.cells(way, self._problem.grid.mesh))
        status, dT, X = standing.state.status, step / scene.unit, along / scene.framed.x_scale
        return self._transport.leg(carried, status, dT, shift, reference, X)

    def _account(self, leg, carried, evaluation):
        """The oil that is stored, and the part of it that storage and flow through the domain's ends leave
        open."""
        inner, mesh = ~self._problem.boundary, self._problem.grid.mesh
        now, before = self._sum(content(evaluation.fluid), inner), self._sum(carried.m, inner)
        pressed = self._sum(self._transport.into(leg.pressed(evaluation)), inner)
        # What is pressed between inner nodes leaves one and enters another: the sum is that of the ends.
        return now * mesh.dX * mesh.dY, (now - before - leg.through_ends - pressed) / now

    def _sum(self, array, nodes):
        return self._problem.grid.sum(array[nodes].sum())

    def _guess(self, standing, t, way, halvings):
        """The state that a step begins with, in which the mean surface goes a way: without contact the last
        ones go on."""
        problem, last = self._problem, standing.state
        P, H0 = last.P, last.H0
        if not halvings and not problem.grid.count(last.status == CONTACT):
            weights, tears_at = weights_at(standing.times, t), problem.contact.tears_at
            P = np.maximum(fading(self._going_on(standing, t, way), standing, t, tears_at), tears_at)
            P, H0 = np.where(last.P > tears_at, P, tears_at), float(np.dot(weights, standing.H0))
        status = np.where(last.status == BOUNDARY, BOUNDARY, last.status)
        return problem.state(P, H0, status, last.p.copy(), last.filling.copy())

    def _going_on(self, standing, t, way):
        """Pressures after those before: what heights that move have changed goes along with the mean
        surface, as waves of the film do; else a parabola in time."""
        shift = Shift(*self._scene.cells(way, self._problem.grid.mesh))
        if not self._scene.moves or shift.along_y or len(standing.times) < 2:
            return np.tensordot(weights_at(standing.times, t), standing.P, 1)
        before, last = standing.P[-2:]
        steps = (t - standing.times[-1]) / (standing.times[-1] - standing.times[-2])
        return last + steps * moved(last - before, shift.along_x)

    def _error(self, standing, t, state):
        """What a step is off a straight line in time: its pressures, over themselves, rms; where nothing
        moves the gaps, too, for under a load that stays pressures hardly change."""
        times, rms = [*standing.times, t], self._problem.rms
        if len(times) < 3:
            return 0.0
        error = rms(_off(times, [*standing.P, state.P])) / max(rms(state.P), 1e-300)
        if standing.H is None:
            return error
        borne = np.sqrt(np.maximum(state.P, 0.0))
        gaps = rms(borne * _off(times, [*standing.H, state.H]) / np.maximum(state.H, NO_GAP))
        return max(error, GAPS * gaps / max(rms(borne), 1e-300))

    def _remember(self, standing):
        """Take the present state among those that a guess is made of."""
        state, last = standing.state, 1 - LOOKS_BACK
        standing.times = [*standing.times[last:], standing.t]
        standing.H0 = [*standing.H0[last:], state.H0]
        standing.P = _with(standing.P, state.P, last)
        if self._scene.stands:
            standing.H = _with(standing.H, state.H, last)


def _with(before, latest, last):
    """The `last` ones of a stack of arrays, None of nothing, and the latest."""
    return np.stack([*([] if before is None else before[last:]), latest])


def _off(times, values):
    """What the last of some values at `times` is off a straight line through those before. Of what a node
    tells that counts which the step before told, too: a spike that jumps on to the next node jumps in any
    step."""
    bent = curvature(times[-3:], values[-3:])
    if len(times) > 3:
        bent = alike(bent, curvature(times[-4:-1], values[-4:-1]))
    return (times[-1] - times[-2]) * (times[-1] - times[-3]) * bent
