"""Input that is allowed, and yet unusual: most often a wrong unit. Each is named; none is refused."""

import numpy as np

from mgehl.kinds.bodies import BODIES
from mgehl.kinds.loaded_checks import LARGEST_CONTACT, on_the_bodies
from mgehl.kinds.plausible_bodies import implausible_heat, implausible_layer
from mgehl.kinds.plausible_in_time import FASTEST, implausible_in_time
from mgehl.kinds.surface_kinds import MOVING, NAMES, STILL, every_surface
from mgehl.kinds.time import reference
from mgehl.model.films import formula_of
from mgehl.model.frame import direction
from mgehl.model.lubricant import Roelands
from mgehl.model.oils import CELSIUS, OILS
from mgehl.model.own_function import OwnFunctionError
from mgehl.model.own_laws import OwnDensity, OwnViscosity

USUAL = {
    "contact.radius_x": (1e-5, 5.0, "m"),
    "contact.radius_y": (1e-5, 50.0, "m"),
    "contact.reduced_modulus": (5e3, 1.3e12, "Pa"),
    "lubricant.viscosity": (2e-4, 5.0, "Pa s"),
    "lubricant.pressure_viscosity": (3e-10, 6e-8, "1/Pa"),
    "motion.speed": (0.0, FASTEST, "m/s"),
    "body_1.roughness": (0.0, 2e-5, "m"),
    "body_2.roughness": (0.0, 2e-5, "m"),
    "body_1.Ra": (0.0, 2e-5, "m"),
    "body_2.Ra": (0.0, 2e-5, "m"),
    "heat.conductivity_1": (0.05, 2500.0, "W/(m K)"),
    "heat.conductivity_2": (0.05, 2500.0, "W/(m K)"),
    "heat.capacity_1": (5e5, 5e6, "J/(m3 K)"),
    "heat.capacity_2": (5e5, 5e6, "J/(m3 K)"),
    "lubricant.conductivity": (0.05, 1.0, "W/(m K)"),
    "lubricant.thermoviscosity": (3e-3, 0.2, "1/K"),
    "friction.eyring_stress": (1e5, 1e8, "Pa"),
    "friction.limiting_coefficient": (5e-3, 0.2, ""),
    "friction.boundary_coefficient": (0.0, 1.5, ""),
}
"""{key: smallest and largest value of machines, from gels to diamond and from petrol to gear oil, unit}."""

HARD = 1e10
"""E' in Pa from which on bodies are hard: gels, rubber and plastics are pressed lightly, and by right."""

LIGHTEST, HEAVIEST = 0.1e9, 5e9
"""p_h in Pa of hard bodies: below it the film hardly needs elasticity, above it all steels yield."""

STEEPEST = 0.1
"""p_h over E' from which on the strain of soft bodies is no longer small: a/R of 0.3."""

THICKEST = {True: 3e-6, False: 50e-6}
"""Film in m, of piezoviscous contacts and of others."""

STEEPEST_HEIGHTS = 0.2
"""Rms slope of a surface whose square, 4 %, Reynolds' equation and the half-space can no longer neglect."""

LONGER, SLENDER = 2.0, 8.0
"""R_x/R_y from which on formulas are not made for the contact. Films of 100 N, 1 m/s, 257 nodes are 1.17,
1.26, 1.39 and 1.49 times Nijenbanning's at 2, 3, 5 and 8, and .96, .90, .78 and .65 times Hamrock and
Dowson's; of other contacts 1.3, 1.4 and 1.5 times Nijenbanning's at 10, 20 and 34."""

AGAINST = 2.0
"""Slide-to-roll ratio from which on one body moves against the other; one in per cent is as large, too."""

APART = 1000.0
"""Ratio of two formulas of which one cannot be meant."""


def implausible(config, contact, goes_on=False):
    """Lines that name what is unusual in the input, of a run that `goes_on` from another, or of one that
    does not."""
    physics = config.inputs
    for key, (low, high, unit) in USUAL.items():
        value = physics[key] if key in physics else config.value(key)
        known = isinstance(value, float) and key not in config.unused  # not a course in time
        if known and value and not low <= value <= high:
            yield f"{f'{key} = {value:.4g} {unit}'.rstrip()}: machines have {low:g} to {high:g}"
    if not contact.is_loaded:
        return
    yield from _pressure(contact)
    for axis, size, radius in on_the_bodies(config, contact):
        if size > LARGEST_CONTACT * radius:
            yield (
                f"the contact's semi-axis along {axis} is {1e3 * size:.3g} mm, more than half of a body's "
                f"radius of {1e3 * radius:.3g} mm: such bodies are no half-spaces, as is assumed"
            )
    yield from implausible_layer(contact)
    yield from _flat_lay(config)
    yield from _steep(contact)
    yield from _unit_of_a_file(config, contact)
    if config.is_dry:
        return
    law = contact.lubricant.viscosity_law
    if isinstance(law, Roelands) and law.z > 1.0:
        yield (
            f"lubricant.viscosity_law = 'roelands': its z is {law.z:.3g}, measured oils have 0.4 to 0.8: "
            "look at viscosity and pressure_viscosity"
        )
    yield from _falling(contact)
    yield from _films(config, contact)
    yield from _against(contact)
    yield from _stands_still(config)
    yield from _turned_axes(config)
    yield from implausible_heat(config, contact)
    yield from _either_body(config)
    if config.is_in_time:
        yield from implausible_in_time(config, contact, goes_on)
    if config.lubricant.oil is not None:
        yield from _range(config.lubricant, contact.hertz.p_h)


def _falling(contact):
    """Own laws of the oil that fall where the pressure rises."""
    lubricant, p_h = contact.lubricant, contact.hertz.p_h
    P = np.linspace(0.0, 1.0, 101)[None, :]
    for key, law, values in (
        ("viscosity_law", lubricant.viscosity_law, lubricant.log_viscosity),
        ("density_law", lubricant.density_law, lubricant.density),
    ):
        if isinstance(law, OwnViscosity | OwnDensity):
            falls = np.flatnonzero(np.diff(values(P, p_h)[0][0]) < 0.0)
            if falls.size:
                at = 1e-9 * p_h * P[0, falls[0]]
                yield f"lubricant.{key} falls from {at:.3g} GPa on: pressure makes oil thicker and denser"


def _flat_lay(config):
    """Directions of surfaces that are the same in all."""
    for name in NAMES:
        section = getattr(config, name)
        if section.kind == "self-affine" and section.aspect == 1.0 and section.angle:
            yield f"{name}.angle does nothing where {name}.aspect is 1: the surface has no lay"


def _steep(contact):
    """Heights that rise too steeply; nothing where they are a function that is not run."""
    try:
        slope = contact.slope
    except OwnFunctionError:
        return
    if slope > STEEPEST_HEIGHTS:
        yield (
            f"the surface's rms slope is {slope:.2g}: from {STEEPEST_HEIGHTS:g} on its square is no longer "
            "small, as is assumed: look at heights and wavelengths"
        )


def _unit_of_a_file(config, contact):
    """Measured heights that are none of a contact's roughness."""
    if not (config.surface.file or config.second_surface.file):
        return
    at, size = np.linspace(-1.0, 1.0, 65), max(contact.x_scale, contact.y_scale)
    shortest = contact.surface.shortest(contact.x_scale * at, contact.y_scale * at)
    if size < shortest < np.inf:
        yield (
            f"the surface's shortest wave is {1e3 * shortest:.3g} mm, the contact's semi-axis "
            f"{1e3 * size:.3g} mm: it has no roughness: look at the unit of the file's spacing"
        )


def _pressure(contact):
    p_h, modulus = contact.hertz.p_h, contact.reduced_modulus
    if p_h > HEAVIEST:
        yield f"p_h = {1e-9 * p_h:.3g} GPa: above {1e-9 * HEAVIEST:g} GPa all steels yield"
    elif p_h > STEEPEST * modulus:
        yield f"p_h = {p_h:.3g} Pa is {p_h / modulus:.2g} E': strains are not small, as is assumed"
    elif modulus > HARD and p_h < LIGHTEST:
        yield (
            f"p_h = {1e-9 * p_h:.3g} GPa: hard bodies mostly have {1e-9 * LIGHTEST:g} to "
            f"{1e-9 * HEAVIEST:g}: look at load and radii"
        )


def _films(config, contact):
    long = 0.0 if contact.is_line else contact.aligned.radius_x / contact.aligned.radius_y
    if long > LONGER:
        far, off = ("far ", "half") if long > SLENDER else ("", "a fifth and more")
        yield (
            f"the contact is {far}longer along the motion than it is wide: film formulas, lambda and the "
            f"regime are made for others, and off by {off}"
        )
    known = contact.formulas
    film = next(film for name, film in known.items() if formula_of(name).bodies == "any")
    if film > THICKEST["piezoviscous" in contact.regime]:
        yield f"film of {1e6 * film:.3g} um by a formula: look at viscosity, speed and radii"
    threshold = config.discretization.film_threshold
    if config.solver.from_film and not contact.is_rough and film < threshold:
        yield (
            f"film of {1e9 * film:.3g} nm by a formula: below discretization.film_threshold = "
            f"{1e9 * threshold:.3g} nm bodies count as in contact"
        )
    centers = {
        name: film
        for name, film in known.items()
        if film and not name.endswith("_minimum") and formula_of(name).bodies != "soft"
    }
    low, high = (pick(centers, key=centers.__getitem__) for pick in (min, max))
    if contact.regime != "elastic isoviscous" and centers[high] > APART * centers[low]:
        yield (
            f"films of formulas are {centers[high] / centers[low]:.2g} fold apart ({low.replace('_', ' ')} "
            f"{1e9 * centers[low]:.3g} nm, {high.replace('_', ' ')} {1e9 * centers[high]:.3g} nm): the "
            "load hardly presses the bodies: look at load, radii and viscosity"
        )


def _against(contact):
    """Bodies that move against each other."""
    slides = contact.friction.slide_to_roll
    if abs(slides) > AGAINST:
        yield (
            f"motion.slide_to_roll = {slides:g}: above {AGAINST:g} one body moves against the other; it is "
            "a ratio, not in per cent"
        )


def _stands_still(config):
    """Roughness that stands still on a body that moves."""
    motion, slide = config.motion, config.inputs.get("motion.slide_to_roll", config.motion.slide_to_roll)
    moves = slide not in (None, 2.0, -2.0) or motion.ring_rotation is not None
    along = direction(reference(config, "motion.angle"))
    bodies = [body for _, surface, body in every_surface(config) if surface.varies_along(along)]
    if not moves or not bodies:
        return
    both = f"motion.slide_to_roll = {slide or 0.0:.3g}: both bodies move"
    if not config.is_in_time:
        yield (
            f"{both}, and roughness that moves changes the film with time: here it stands still, and "
            'friction alone is of this motion; body = "body_1" and time.end move it'
        )
        return
    goes = {STILL: "stands still", MOVING: "goes at twice the mean speed"}
    for body in (each for each in goes if each in bodies):
        yield f'{both}, but roughness whose body = "{body}" {goes[body]}: "body_1" or "body_2" carry it'


def _turned_axes(config):
    """Rotations that are speeds by the radius along x, of a motion that goes another way."""
    angle, along_x = reference(config, "motion.angle"), "by the radius along x, though motion.angle is"
    if angle % 180.0 == 0.0:
        return
    for name in BODIES:
        body = getattr(config, name)
        is_round = body.diameter is not None or body.radius_x == body.radius_y
        if body.rotation is not None and body.rotation_radius is None and not is_round:
            yield f"{name}.rotation is a speed {along_x} {angle:g}: {name}.rotation_radius says by which"
    if config.motion.ring_rotation is not None:
        yield f"motion.ring_rotation is a speed {along_x} {angle:g}: bearings roll along x"


def _either_body(config):
    """A coating on one of two bodies that are not alike, and nobody says on which."""
    if config.contact.deformation != "coated" or config.coating.substrate_modulus is not None:
        return
    first, second = ((body.material, body.modulus, body.poisson) for body in (config.body_1, config.body_2))
    if first != second:
        yield (
            "coating.substrate_modulus is not given: half of both bodies' compliance counts as that of the "
            "coated one, and these differ"
        )


ROUNDED = 0.01
"""K by which a temperature that was given in other degrees may be off."""


def _range(section, p_h):
    oil = OILS[section.oil]
    if not oil.coldest - ROUNDED <= section.temperature <= oil.warmest + ROUNDED:
        yield (
            f"lubricant.temperature = {section.temperature - CELSIUS:.4g} C: {section.oil} was measured "
            f"from {oil.coldest - CELSIUS:g} to {oil.warmest - CELSIUS:g} C: its law is extended beyond"
        )
    if p_h > oil.highest:
        yield (
            f"p_h = {1e-9 * p_h:.3g} GPa: {section.oil} was measured up to {1e-9 * oil.highest:g} GPa: "
            "its law is extended beyond"
        )
