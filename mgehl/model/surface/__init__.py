"""Rough, wavy and dented bodies: heights in m over the smooth ones, a peak positive."""

from mgehl.model.surface.measured import Measured, Preparation
from mgehl.model.surface.self_affine import SelfAffine
from mgehl.model.surface.shapes import Dent, Ridge
from mgehl.model.surface.surface import Surface, summed
from mgehl.model.surface.waviness import Waviness

__all__ = ["Dent", "Measured", "Preparation", "Ridge", "SelfAffine", "Surface", "Waviness", "summed"]
