"""The kinds of surface: keys of [surface] and [second_surface], and what is built of them.

A formula's keys are the fields of its class: those without a default must be given. A new kind is a class
of `mgehl.model.surface`, its name in `FORMULAS`, and a key of the section for every field that is new.
"""

from dataclasses import MISSING, dataclass, fields
from pathlib import Path

from mgehl.config_value import number, whole, word
from mgehl.kinds.choice import Choice, word_of
from mgehl.model.own_function import OwnFunction
from mgehl.model.own_laws import OwnSurface
from mgehl.model.surface import Dent, Measured, Preparation, Ridge, SelfAffine, Waviness
from mgehl.model.surface.map import UNITS
from mgehl.model.surface.measured import CONTINUATIONS, INTERPOLATE, REFUSE, REMOVED

NAMES = ("surface", "second_surface")

FORMULAS = {"waviness": Waviness, "self-affine": SelfAffine, "dent": Dent, "ridge": Ridge}

ALONG_Y = {"waviness": ("wavelength_y", "angle", "y"), "dent": ("y",), "ridge": ("angle", "y")}
"""Keys of a formula that mean nothing to a line contact, which has nothing that varies along y. Another y
or angle of a file, or of self-affine heights, is another profile."""

OF_A_FILE = (
    "file", "height_unit", "position_unit", "spacing", "spacing_y", "continuation", "remove", "holes",
    "shortest_wavelength", "longest_wavelength", "body", "x", "y", "angle",
)  # fmt: skip
"""Keys of a surface from a file."""

BODIES = STILL, MOVING, BODY_1, BODY_2 = "still", "moving", "body_1", "body_2"
"""The body that a surface belongs to."""


def share_of(body, slide_to_roll):
    """The speed of a surface's body over the mean speed of both."""
    slip = 0.5 * slide_to_roll
    return {STILL: 0.0, MOVING: 2.0, BODY_1: 1.0 + slip, BODY_2: 1.0 - slip}[body]


def number_of(body, slide_to_roll):
    """The number of a surface's body: what moves at twice the mean speed is on the faster one, what stands
    still on the other."""
    faster = 1 if slide_to_roll >= 0.0 else 2
    return {STILL: 3 - faster, MOVING: faster, BODY_1: 1, BODY_2: 2}[body]


LENGTHS = ("m", "mm", "um", "µm", "nm", "pm", "in", "uin")
"""Units that keys name."""


def absolute_path(value, directory="."):
    """A file's path, counted from `directory`; None of anything else."""
    return str((Path(directory) / value).resolve()) if isinstance(value, str) and value else None


@dataclass(frozen=True)
class SurfaceSection:
    # fmt: off
    kind: str | None = word(None, "heights by a formula", tuple(FORMULAS))
    file: str | None = word(None, "heights from a file: .npy, .npz, text (matrix, x y z, or x z "
        "of a line), an instrument's format", own=absolute_path, own_name="FILE")
    body: str = word(STILL, "the body that carries it: one that stands still, one that moves at twice "
        "motion.speed, or body_1, body_2 at speeds by motion.slide_to_roll", BODIES)
    amplitude: float | None = number(None, "of waviness half from valley to peak, of a dent its depth, of "
        "a ridge its height", "m", 0.0, 1e-2)
    wavelength_x: float | None = number(None, "waviness: wavelength along its own x axis (unset: no waves "
        "that way)", "m", 1e-9, 1.0)
    wavelength_y: float | None = number(None, "the same along its own y axis", "m", 1e-9, 1.0)
    width: float | None = number(None, "w of a dent or a ridge: A 10^(-10 (r/w)^2) cos(2 pi r/w)", "m",
        1e-9, 1.0)
    rms: float | None = number(None, "self-affine: rms height", "m", 0.0, 1e-2)
    hurst: float = number(0.8, "self-affine: Hurst exponent", low=0.0, high=1.0)
    seed: int = whole(0, "self-affine: which of the random surfaces", 0, 2**31)
    aspect: float = number(1.0, "self-affine: length of features along angle over that across it", low=1.0,
        high=100.0)
    shortest_wavelength: float | None = number(None, "cut-off: self-affine has no shorter waves, a file is "
        "filtered", "m", 1e-9, 1.0)
    longest_wavelength: float | None = number(None, "cut-off: self-affine has no longer waves, a file is "
        "filtered", "m", 1e-9, 1.0)
    x: float = number(0.0, "where the middle of the file, dent or ridge is, a peak of the waves", "m", -1.0,
        1.0)
    y: float = number(0.0, "the same along y", "m", -1.0, 1.0)
    angle: float = number(0.0, "direction of its own x axis, from +x towards +y; "
        "of self-affine of its lay, with other heights at each angle", "deg", -360.0, 360.0)
    height_unit: str | None = word(None, "file: unit of its heights (unset: the file's own)", LENGTHS)
    position_unit: str | None = word(None, "file: unit of its x and y (unset: the file's own)", LENGTHS)
    spacing: float | None = number(None, "file: distance of its points (unset: the file's own)", "m", 1e-12,
        1.0)
    spacing_y: float | None = number(None, "file: the same along y (unset: as along x)", "m", 1e-12, 1.0)
    continuation: str = word("none", "file: what is beyond its edge (none: the edge's heights, outside the "
        "contact alone)", tuple(CONTINUATIONS))
    remove: str = word("nothing", "file: what is taken off it (curvature: with tilt and mean)",
        tuple(REMOVED))
    holes: str = word(REFUSE, "file: holes, points without a height (interpolate: filled smoothly, up to a "
        "quarter)", (REFUSE, INTERPOLATE))
    # fmt: on


def surface_choices(tables):
    """The `Choice` of each surface that nested values speak of."""
    for name in NAMES:
        table = tables.get(name)
        if not isinstance(table, dict) or {"kind", "file"}.isdisjoint(table):
            continue
        kind = word_of(tables, f"{name}.kind")
        if table.get("file") is not None:
            yield Choice(f"with {name}.file", (name,), _keys(name, OF_A_FILE))
        elif kind is None:
            yield Choice(f"without {name}.kind or {name}.file", (name,))
        elif kind in FORMULAS:
            parameters, said = _parameters(FORMULAS[kind]), f'with {name}.kind = "{kind}"'
            if word_of(tables, "contact.kind") == "line" and kind in ALONG_Y:
                said = f"{said} of a line contact"
                parameters = {key: each for key, each in parameters.items() if key not in ALONG_Y[kind]}
            takes = _keys(name, ("kind", "body", *parameters))
            needs = _keys(name, (key for key, needed in parameters.items() if needed))
            yield Choice(said, (name,), takes, needs)


def _keys(section, names):
    return tuple(f"{section}.{name}" for name in names)


def _parameters(formula):
    """{key: whether it must be given} of a formula's class."""
    known = {key.name for key in fields(SurfaceSection)}
    own = (field for field in fields(formula) if field.name in known)
    return {field.name: field.default is MISSING and field.type is float for field in own}


def every_surface(config):
    """(Key, `Surface`, the body that carries it) of every surface."""
    for name in NAMES:
        section = getattr(config, name)
        if (surface := surface_of(section)) is not None:
            key = "kind" if section.file is None else "file"
            yield f"{name}.{key} = {getattr(section, key)!r}", surface, section.body
    contact = config.contact
    if contact.surface:
        own = OwnSurface(OwnFunction(contact.surface))
        yield f"contact.surface = {contact.surface!r}", own, contact.surface_body


def surface_of(section):
    """The `Surface` of a section; None where it gives none."""
    if section.file is not None:
        place = {"x": section.x, "y": section.y, "angle": section.angle}
        return Measured(section.file, _preparation(section), **place)
    if section.kind is None:
        return None
    formula = FORMULAS[section.kind]
    return formula(**{key: getattr(section, key) for key in _parameters(formula)})


def _preparation(section):
    same = "remove", "shortest_wavelength", "longest_wavelength", "continuation", "holes"
    units = {name: UNITS.get(getattr(section, name)) for name in ("height_unit", "position_unit")}
    values = {name: getattr(section, name) for name in same}
    return Preparation(dx=section.spacing, dy=section.spacing_y, **units, **values)
