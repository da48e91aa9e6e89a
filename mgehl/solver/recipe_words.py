"""A recipe in words, a choice each, as `mgehl check` prints it; in plain values, as result.json has it."""

from dataclasses import asdict
from math import isfinite

from mgehl.multigrid.smoother_choice import smoother_of
from mgehl.solver.recipe import (
    A_STATE,
    COVERED,
    DRY,
    FULL_FILM,
    IN_CONTACT,
    NEAR,
    NONE,
    THICK,
    THICK_FILM,
    TOUCHING,
    UNDER_FILM,
    UNDER_THIN_FILM,
    UNSEEN_FILM,
)
from mgehl.solver.step_length import LARGEST_CHANGE

PEAKS = {
    NONE: "smooth bodies",
    COVERED: f"peaks under a film of more than {THICK:g} times the roughness",
    NEAR: f"peaks near the other body: the film is less than {THICK:g} times the roughness",
    TOUCHING: "peaks that touch: the roughness is more than the film that smooth bodies would have",
}

BEGINS = {
    FULL_FILM: "from a full film",
    UNSEEN_FILM: "from a thicker film: the grid hardly sees its own",
    IN_CONTACT: "from the dry contact, in contact",
    UNDER_FILM: "from the dry contact of the peaks, a film laid on it",
    UNDER_THIN_FILM: "from the dry contact of the peaks, nearly no film on it",
    DRY: "from the dry contact of the peaks alone: the film is thinner than the layers",
    A_STATE: "from another solution",
}

NAMES = {
    DRY: "the dry contact without oil",
    THICK_FILM: "a thick film",
    FULL_FILM: "a film",
    IN_CONTACT: "contact",
}
"""What is begun from where another start leads nowhere."""

AT_REST = "from the dry contact: the surfaces are at rest"
"""So begins a run in time whose speed rises from nothing."""


def recipe_words(recipe, is_line, at_rest=False):
    """Words for each choice of a `Recipe` and why; of a single line, of surfaces that begin `at_rest`."""
    law, newton = recipe.scheme.contact_law, recipe.newton
    yield PEAKS[recipe.peaks]
    is_limited = isfinite(recipe.scheme.couette_flow.limit)
    limited = ", limited: no film behind a peak is less than none" if is_limited else ""
    mean = f"{recipe.scheme.face_mobility} mean of mobilities"
    yield f"Couette flow by {recipe.scheme.couette}{limited}; {mean}"
    yield f"contact {law.words}"
    grids = f"coarse grids first{_slower(recipe)}" if recipe.on_coarse_grids else "on the finest grid alone"
    yield f"begins {AT_REST if at_rest else f'{BEGINS[recipe.begins]}, {grids}'}"
    if recipe.otherwise:
        yield f"where that fails, {', then '.join(f'from {NAMES[each]}' for each in recipe.otherwise)}"
    yield _steps(newton)
    memory = "; corrections of one system are remembered for the next" if recipe.cycle.rough else ""
    yield f"smoother: {_smoother(recipe, is_line)}{memory}"


def _slower(recipe):
    if not isfinite(recipe.most_slower):
        return ""
    return f"; the speed falls by at most a factor of {recipe.most_slower:g} at once"


def _smoother(recipe, is_line):
    """That of the finest grid."""
    cycle = recipe.cycle
    if is_line and cycle.direct:
        return f"none, up to {cycle.direct} nodes of a line are solved directly"
    return smoother_of(is_line, recipe.scheme.couette, in_valleys=cycle.in_valleys, finest=True).words


def _steps(newton):
    """Newton's steps."""
    kind = f"implicit steps in time, rate {newton.squeeze:g}" if newton.squeeze else "Newton's own steps"
    scale = "the largest pressure" if newton.over_largest else "p_h"
    film = f" and {LARGEST_CHANGE:g} of the film" if newton.by_film else ""
    change = f"{newton.max_pressure_step:.2g} of {scale}{film}"
    end = f"{newton.idle_steps} in vain" if newton.idle_steps < newton.max_steps else f"{newton.max_steps}"
    falls = "; pressures fall as the oil flows after one in vain" if newton.by_reduced_pressure else ""
    few = "; few nodes that hold up all others are solved by themselves" if newton.eliminates else ""
    few += "; contact opens at once, with all contact behind it" if newton.passes_on else ""
    return f"{kind}; one changes at most {change}{falls}{few}; {end} end it"


def plain(recipe):
    """{choice: value} of a `Recipe`, for files."""
    newton = {key: asdict(recipe.newton)[key] for key in NEWTON}
    return {
        "peaks": recipe.peaks,
        "couette": recipe.scheme.couette,
        "face_mobility": recipe.scheme.face_mobility,
        "contact": recipe.scheme.contact_law.words,
        "begins": recipe.begins,
        "on_coarse_grids": recipe.on_coarse_grids,
        "most_slower": recipe.most_slower if isfinite(recipe.most_slower) else None,
        "otherwise": [*recipe.otherwise],
        **newton,
        "smoother": "in valleys" if recipe.cycle.in_valleys else "by lines",
        "remembers": recipe.cycle.rough,
    }


NEWTON = (
    "tolerance", "certain", "squeeze", "idle_steps", "max_pressure_step", "over_largest", "by_film",
    "by_reduced_pressure", "eliminates", "passes_on",
)  # fmt: skip
"""Newton's rules that a recipe has."""
