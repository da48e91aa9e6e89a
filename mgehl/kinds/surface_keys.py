"""Keys of [surface] and [second_surface], and which of them each kind of surface uses."""

from dataclasses import dataclass
from pathlib import Path

from mgehl.config_value import key_field
from mgehl.model.surface.measured import CONTINUATIONS, REMOVED

NAMES = ("surface", "second_surface")

STILL, MOVING = "still", "moving"

LENGTHS = ("m", "mm", "um", "µm", "nm", "pm")
"""Units that keys name."""


def absolute_path(value, directory="."):
    """A file's path, counted from `directory`; None of anything else."""
    return str((Path(directory) / value).resolve()) if isinstance(value, str) and value else None


@dataclass(frozen=True)
class SurfaceSection:
    kind: str | None = key_field(
        None, "heights by a formula", choices=("waviness", "self-affine", "dent", "ridge"), kind=str
    )
    file: str | None = key_field(
        None, "heights from a file: .npy, .npz, text (matrix or x y z), an instrument's format",
        kind=str, own=absolute_path, own_name="FILE",
    )  # fmt: skip
    body: str = key_field(
        STILL, "the body that carries it: it stands still, or moves at twice motion.speed",
        choices=(STILL, MOVING), kind=str,
    )  # fmt: skip
    amplitude: float | None = key_field(
        None, "of waviness half from valley to peak, of a dent its depth, of a ridge its height",
        "m", low=0.0, high=1e-2,
    )  # fmt: skip
    wavelength_x: float | None = key_field(
        None, "waviness: wavelength along its own x axis (unset: no waves that way)", "m",
        low=1e-9, high=1.0,
    )  # fmt: skip
    wavelength_y: float | None = key_field(
        None, "the same along its own y axis", "m", low=1e-9, high=1.0
    )  # fmt: skip
    width: float | None = key_field(
        None, "w of a dent or a ridge: A 10^(-10 (r/w)^2) cos(2 pi r/w)", "m", low=1e-9, high=1.0
    )
    rms: float | None = key_field(None, "self-affine: rms height", "m", low=0.0, high=1e-2)
    hurst: float = key_field(0.8, "self-affine: Hurst exponent", low=0.0, high=1.0)
    seed: int = key_field(0, "self-affine: which of the random surfaces", low=0, high=2**31, kind=int)
    aspect: float = key_field(
        1.0, "self-affine: length of features along angle over that across it", low=1.0, high=100.0
    )
    shortest_wavelength: float | None = key_field(
        None, "cut-off: self-affine has no shorter waves, a file is filtered", "m", low=1e-9, high=1.0
    )
    longest_wavelength: float | None = key_field(
        None, "cut-off: self-affine has no longer waves, a file is filtered", "m", low=1e-9, high=1.0
    )
    x: float = key_field(
        0.0, "where the middle of the file, dent or ridge is, a peak of the waves", "m", low=-1.0, high=1.0
    )
    y: float = key_field(0.0, "the same along y", "m", low=-1.0, high=1.0)
    angle: float = key_field(
        0.0, "direction of its own x axis, from +x towards +y", "deg", low=-360.0, high=360.0
    )
    height_unit: str | None = key_field(
        None, "file: unit of its heights (unset: the file's own)", choices=LENGTHS, kind=str
    )
    position_unit: str | None = key_field(
        None, "file: unit of its x and y (unset: the file's own)", choices=LENGTHS, kind=str
    )
    spacing: float | None = key_field(
        None, "file: distance of its points (unset: the file's own)", "m", low=1e-12, high=1.0
    )
    spacing_y: float | None = key_field(
        None, "file: the same along y (unset: as along x)", "m", low=1e-12, high=1.0
    )
    continuation: str = key_field(
        "none", "file: what is beyond its edge (none: the edge's heights, outside the contact alone)",
        choices=tuple(CONTINUATIONS), kind=str,
    )  # fmt: skip
    remove: str = key_field(
        "nothing", "file: what is taken off it (curvature: with tilt and mean)",
        choices=tuple(REMOVED), kind=str,
    )  # fmt: skip

    @property
    def is_given(self):
        """Whether there is a surface."""
        return self.kind is not None or self.file is not None

    @property
    def source(self):
        """Its kind; "file" of a file, None of none."""
        return "file" if self.file is not None else self.kind


PLACE = ("body", "x", "y", "angle")
CUT_OFFS = ("shortest_wavelength", "longest_wavelength")
TAKES = {
    "waviness": ("kind", "amplitude", "wavelength_x", "wavelength_y", *PLACE),
    "self-affine": ("kind", "rms", "hurst", "seed", "aspect", *CUT_OFFS, *PLACE),
    "dent": ("kind", "amplitude", "width", "body", "x", "y"),
    "ridge": ("kind", "amplitude", "width", *PLACE),
    "file": ("file", "height_unit", "position_unit", "spacing", "spacing_y", "continuation", "remove",
             *CUT_OFFS, *PLACE),
}  # fmt: skip
"""Keys that each kind of surface uses."""

NEEDS = {
    "waviness": ("amplitude",),
    "self-affine": ("rms", *CUT_OFFS),
    "dent": ("amplitude", "width"),
    "ridge": ("amplitude", "width"),
    "file": (),
}
