"""Of bodies that are layered, or whose heat is asked for: input that is allowed, and yet unusual."""

from mgehl.kinds.heat import solids_from
from mgehl.model.coating import Coating
from mgehl.model.flash import has_temperatures
from mgehl.model.lubricant import USUAL_CONDUCTIVITY

COMPRESSED = 0.2
"""Part of a layer's thickness by which the dry contact presses it from which on strains are not small: a
layer that gives way to a paraboloid alone does so by half the square of the contact's radius over R. None
gives way by more than one that is free at its sides."""


def implausible_layer(contact):
    """Lines about a layer that is pressed through, or thicker than its body."""
    layer = contact.deformation
    if not isinstance(layer, Coating):
        return
    radius = min(contact.radius_x, contact.radius_y)
    free = contact.hertz.p_h / contact.widening**2 / layer.modulus * layer.thickness
    pressed = min(0.5 * contact.widening**2 * contact.film_scale, free)
    if pressed > COMPRESSED * layer.thickness:
        yield (
            f"the dry contact presses a layer of {1e6 * layer.thickness:.3g} um by some "
            f"{1e6 * pressed:.2g} um: strains are not small, as is assumed"
        )
    if layer.thickness > radius:
        yield (
            f"coating.thickness = {1e3 * layer.thickness:.3g} mm is more than a radius of "
            f"{1e3 * radius:.3g} mm: such a layer is no half-space's"
        )


def implausible_heat(config, contact):
    """Lines about bodies that conduct, beside what does not slide, layers, and oil that is not known."""
    if solids_from(config) is None or config.is_in_time:
        return
    slides = contact.friction.slide_to_roll
    if not slides:
        yield "heat: bodies that do not slide have no temperatures: motion.slide_to_roll is 0, or not given"
        return
    if not has_temperatures(contact):
        yield (
            f"heat: no temperatures are told at motion.slide_to_roll = {slides:g}: "
            "below a line contact, a body at rest grows warmer for ever; 1.99 has one"
        )
        return
    if config.lubricant.conductivity is None:
        yield (
            f"lubricant.conductivity is not given: flash temperatures take {USUAL_CONDUCTIVITY:g} W/(m K), "
            "as is usual"
        )
    if contact.deformation is not None:
        yield "heat: flash temperatures know no layer: each body conducts as given, all through"
