"""How far each tuned number may move: one is changed at a time, a few small cases are solved.

    python tests/tools/constants.py                 every number, some 20 minutes on a quiet machine
    python tests/tools/constants.py STIFF omega     these alone

A row of the table is a value, a column a case; in it stand the convolutions, and in brackets the linear
iterations of the fluid that is solved apart, where the value changes them, "=" where it does not. "!" is a
case that did not converge, "~" one whose answer is another by more than a millionth of its pressure. Where
a value changes a verdict, an answer or a tenth of the work, none further off is tried. No part of
the tests.
"""

import importlib
import inspect
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import numpy as np

import mgehl
from mgehl.solver import rigid_gap
from mgehl.solver.rigid_gap import FluidStep

CONFIGS = Path(__file__).resolve().parents[2] / "configs"
SQUARE = {"grid.x": [-1.9, 1.9], "grid.y": [-1.9, 1.9]}

LARGER = {"dry 513": ("point_contact", {"grid.nodes": 513})}
FILM = {
    "thick 2B": ("thick_film", {"discretization.couette": "2B"}),
    "30 deg": ("thick_film", {"discretization.couette": "2B", "motion.angle": 30, **SQUARE}),
    "moes 2B": ("moes_200_10", {"grid.nodes": 129}),
    "film 257": ("full_film", {"grid.nodes": 257, "motion.speed": 0.06}),
}
CONTACT = {
    "dry 257": ("point_contact", {}),
    "mixed 129": ("point_contact", {"grid.nodes": 129, "motion.speed": 0.001}),
    "mixed 257": ("point_contact", {"motion.speed": 0.001}),
}
MEAN = {
    "geometric": ("full_film", {"grid.nodes": 129, "discretization.face_mobility": "geometric"}),
    "harmonic": ("full_film", {"grid.nodes": 65, "discretization.face_mobility": "harmonic"}),
}
MEAN = {name: (file, {**keys, "motion.speed": 0.5}) for name, (file, keys) in MEAN.items()}
LINE = {"line": ("line_contact", {}), "line dry": ("line_dry", {})}
WEDGE = {
    "wedge": ("wedge_square_pillar", {}),
    "wedge cav.": ("wedge_square_pillar", {"discretization.cavitation": True}),
}
COATED = {"coated": ("coated", {"grid.nodes": 129})}
LOADED = FILM | {"mixed 129": CONTACT["mixed 129"]} | LINE
SQUEEZED = CONTACT | MEAN | {"line dry": LINE["line dry"]}
APART = CONTACT | {"line dry": LINE["line dry"]}

TENFOLD = (0.1, 0.3, 3.0, 10.0)


@dataclass(frozen=True)
class Tuned:
    """A number: where it stands, the cases that may feel it, and what is tried."""

    places: tuple
    """Of "module:NAME" (and all who imported it), "module:function(parameter)", "section.key"."""
    cases: dict
    values: tuple = ()
    """In rising order; none: factors of `TENFOLD`."""
    is_factor: bool = False


def tuned(cases, *places, values=(), is_factor=False):
    return Tuned(places, cases, values, is_factor)


SOLVER, DISCRETE, CYCLE = "mgehl.solver.", "mgehl.discretization.", "mgehl.multigrid."
NEWTON = SOLVER + "settings:NewtonSettings"
NUMBERS = {
    "REACH": tuned(
        LOADED, DISCRETE + "kernels:REACH", DISCRETE + "bands:LineBands(reach)", values=(2, 3, 4, 6, 7, 10)
    ),
    "STIFF": tuned(LOADED, DISCRETE + "bands:STIFF"),
    "omega": tuned(LOADED, "solver.omega", values=(0.5, 0.6, 0.7, 0.9, 1.0)),
    "sweeps": tuned(LOADED, "solver.sweeps", values=(2, 3)),
    "max_iterations": tuned(
        LOADED, "mgehl.multigrid.cycle:CycleSettings(max_iterations)", values=(10, 20, 30, 40, 100, 200)
    ),
    "linear_tolerance": tuned(LOADED, "solver.linear_tolerance", values=(0.01, 0.03, 0.05, 0.2, 0.3)),
    "max_pressure_step": tuned(
        LOADED, NEWTON + "(max_pressure_step)", values=(0.03, 0.1, 0.2, 0.5, 1.0, 3.0)
    ),
    "STEEP": tuned(LOADED, SOLVER + "step_length:STEEP", values=(10.0, 13.0, 17.0, 27.0, 40.0)),
    "SECOND": tuned(LOADED, CYCLE + "fcycle:SECOND", values=(0.5, 0.7, 0.75, 0.85, 0.9, 1.0)),
    "AT_CLIFFS": tuned(LOADED, CYCLE + "crossed_lines:AT_CLIFFS", values=(1.0, 1.1, 1.3, 1.5)),
    "CLIFF": tuned(LOADED, CYCLE + "cliffs:CLIFF", values=(3.0, 5.0, 20.0, 100.0)),
    "DIVERGED": tuned(LOADED, SOLVER + "problem:DIVERGED", values=(1e3, 1e4, 1e6, 1e14)),
    "STALLS": tuned(LOADED, SOLVER + "judge:STALLS", values=(1, 2, 4, 10)),
    "RESTLESS": tuned(LOADED, SOLVER + "partition:RESTLESS", values=(4, 6, 8, 20, 40)),
    "WEAKLY_COUPLED": tuned(LOADED, SOLVER + "cavitation:WEAKLY_COUPLED"),
    "LIFTED": tuned(LOADED, SOLVER + "cavitation:LIFTED"),
    "SWEEPS": tuned(LOADED, SOLVER + "cavitation:SWEEPS", values=(4, 10, 20, 80, 400)),
    "PASSES": tuned(LOADED, SOLVER + "cavitation:PASSES", values=(1, 3, 4)),
    "LONG_WAVES": tuned(LINE, SOLVER + "cavitation:LONG_WAVES"),
    "first_nodes": tuned(FILM | {"line": LINE["line"]}, "solver.first_nodes", values=(33, 129)),
    "inlet_cells": tuned(
        FILM | MEAN | {"line": LINE["line"]},
        "solver.inlet_cells",
        values=(0.0, 1.0, 1.4, 1.7, 2.5, 3.0, 4.0, 6.0),
    ),
    "coarse_tolerance": tuned(
        FILM | MEAN | {"line": LINE["line"]}, SOLVER + "settings:NestedSettings(coarse_tolerance)"
    ),
    "release_budget": tuned(LOADED, "solver.release_budget", values=(0, 1, 3, 5, 10)),
    "RELEASE_STEPS": tuned(APART, SOLVER + "arbiter:RELEASE_STEPS", values=(1, 2, 4, 6, 16, 40)),
    "EARLY": tuned(APART | LARGER, SOLVER + "arbiter:EARLY"),
    "EARLY_ROUNDS": tuned(APART | LARGER, SOLVER + "arbiter:EARLY_ROUNDS", values=(0, 1, 2, 4, 10)),
    "FLUID_AHEAD": tuned(APART, SOLVER + "rigid_gap:FLUID_AHEAD"),
    "rigid_gap.LARGEST_STEP": tuned(APART, SOLVER + "rigid_gap:LARGEST_STEP"),
    "rigid_gap.LINEAR_TOLERANCE": tuned(
        APART, SOLVER + "rigid_gap:LINEAR_TOLERANCE", SOLVER + "rigid_gap:RigidGapFluid(linear_tolerance)"
    ),
    "rigid_gap.max_steps": tuned(
        APART, SOLVER + "rigid_gap:RigidGapFluid.solve(max_steps)", values=(3, 5, 10, 20, 60)
    ),
    "SQUEEZE": tuned(SQUEEZED, SOLVER + "squeeze:SQUEEZE"),
    "OF_NODES": tuned(SQUEEZED, SOLVER + "squeeze:OF_NODES", values=(0.0, *TENFOLD), is_factor=True),
    "STABLE": tuned(MEAN, SOLVER + "squeeze:STABLE"),
    "LAST_STEPS": tuned(MEAN, SOLVER + "squeeze:LAST_STEPS"),
    "THINNEST": tuned(SQUEEZED, SOLVER + "squeeze:THINNEST", values=(1e-12, 1e-10, 1e-8, 1e-7, 1e-6)),
    "SMALLEST_STEP": tuned(MEAN, SOLVER + "continuation:SMALLEST_STEP", values=(0.05, 0.1, 0.5, 1.0)),
    "SPEED_RATIO": tuned(MEAN, SOLVER + "continuation:SPEED_RATIO", values=(1.3, 1.5, 3.0, 4.0, 8.0)),
    "dry.TOLERANCE": tuned(COATED, SOLVER + "dry:TOLERANCE"),
    "dry.MAX_STEPS": tuned(COATED, SOLVER + "dry:MAX_STEPS", values=(5, 10, 30)),
    "wedge.LINEAR_TOLERANCE": tuned(
        WEDGE, SOLVER + "wedge:LINEAR_TOLERANCE", values=(1e-13, 1e-12, 1e-9, 1e-6, 1e-3)
    ),
}


@contextmanager
def changed(number, change):
    """Put `change(value)` in the places of a number; gives the keys that a configuration needs instead."""
    undo, keys = [], {}
    for place in number.places:
        if ":" not in place:
            keys[place] = change(None)
        elif "(" in place:
            undo.append(_change_default(place, change))
        else:
            undo += _change_name(place, change)
    try:
        yield keys
    finally:
        for thing, name, value in undo:
            setattr(thing, name, value)


def _change_name(place, change):
    module, name = place.split(":")
    home = importlib.import_module(module)
    value = getattr(home, name)
    modules = [each for key, each in sorted(sys.modules.items()) if key.startswith("mgehl")]
    users = [each for each in modules if vars(each).get(name) is value]
    for user in users:
        setattr(user, name, change(value))
    return [(user, name, value) for user in users]


def _change_default(place, change):
    """Of a function's parameter, or of a class's."""
    function, parameter = _function(place)
    with_defaults = [
        each.name
        for each in inspect.signature(function).parameters.values()
        if each.default is not each.empty
    ]
    before = function.__defaults__
    at = with_defaults.index(parameter)
    function.__defaults__ = (*before[:at], change(before[at]), *before[at + 1 :])
    return function, "__defaults__", before


def _function(place):
    """The function, and the name of the parameter."""
    module, names = place.removesuffix(")").split(":")
    path, parameter = names.split("(")
    function = importlib.import_module(module)
    for name in path.split("."):
        function = getattr(function, name)
    function = function.__init__ if inspect.isclass(function) else function
    return function, parameter


def solved(case, keys):
    """((convolutions, fluid iterations), converged, pressure) of a case, or None where it broke."""
    (file, settings), fluid = case, []
    try:
        with mock.patch.object(
            rigid_gap, "FluidStep", lambda *step: fluid.append(step[1]) or FluidStep(*step)
        ):
            solution = mgehl.solve(mgehl.load(CONFIGS / f"{file}.toml", settings | keys))
    except Exception as error:  # what a wild value breaks is a result, too
        print(f"    {type(error).__name__}: {str(error)[:100]}", file=sys.stderr)
        return None
    result = solution.summary
    work = result.work.convolutions if hasattr(result, "work") else 0.0
    return (work, sum(fluid)), result.converged, solution.fields.P


def entry(found, normal):
    """A cell of the table."""
    if found is None:
        return "broke"
    other = _is_another(found, normal)
    same = found[:2] == normal[:2] and not other
    return "=" if same else _words(found) + "~" * other


def _is_another(found, normal):
    return bool(np.abs(found[2] - normal[2]).max() > 1e-6 * np.abs(normal[2]).max())


def _words(found):
    (work, fluid), converged, _ = found
    return f"{work:.0f}" + f" ({fluid})" * bool(fluid) + "!" * (not converged)


def goes_too_far(found, normal):
    """Whether a case says so clearly of a value that the next one, further off, need not be tried."""
    if found is None or found[1] != normal[1] or _is_another(found, normal):
        return True
    return abs(found[0][0] - normal[0][0]) > 0.1 * normal[0][0]


def outwards(number):
    """(Its name, the change) of all that is tried: downwards, and upwards."""
    values = number.values or TENFOLD
    if not number.values or number.is_factor:
        sides = [v for v in values[::-1] if v < 1.0], [v for v in values if v > 1.0]
        return [[(f"x {factor:g}", scaled(factor)) for factor in side] for side in sides]
    now = present(number.places[0])
    sides = [v for v in values[::-1] if v < now], [v for v in values if v > now]
    return [[(f"{v:g}", lambda old, v=v: v) for v in side] for side in sides]


def present(place):
    """The value that stands in a place."""
    if ":" not in place:
        section, key = place.split(".")
        return getattr(getattr(mgehl.load(), section), key)
    module, name = place.split(":")
    if "(" in name:
        function, parameter = _function(place)
        return inspect.signature(function).parameters[parameter].default
    return getattr(importlib.import_module(module), name)


def scaled(factor):
    """The change by a factor of a number, or of all in a dictionary."""
    return lambda old: {k: factor * v for k, v in old.items()} if isinstance(old, dict) else factor * old


def main(names):
    """Print a table for each of the `names`, or for all numbers."""
    for name in names:
        if name not in NUMBERS:
            sys.exit(f"constants.py: {name}: known are {', '.join(NUMBERS)}")
    normal = {}
    for name in names or NUMBERS:
        number = NUMBERS[name]
        for case in number.cases:
            if case not in normal:
                normal[case] = solved(number.cases[case], {})
        print(f"\n| {name} | " + " | ".join(number.cases) + " |")
        print("|---" * (len(number.cases) + 1) + "|")
        usual = [_words(normal[case]) for case in number.cases]
        print("| as it is | " + " | ".join(usual) + " |", flush=True)
        for side in outwards(number):
            try_side(number, side, normal)


def try_side(number, side, normal):
    """Lines of the table for values ever further off."""
    for label, change in side:
        with changed(number, change) as keys:
            found = {key: solved(case, keys) for key, case in number.cases.items()}
        row = [entry(each, normal[key]) for key, each in found.items()]
        print(f"| {label} | " + " | ".join(row) + " |", flush=True)
        if any(goes_too_far(each, normal[key]) for key, each in found.items()):
            break


if __name__ == "__main__":
    main(sys.argv[1:])
