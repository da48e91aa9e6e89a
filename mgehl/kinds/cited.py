"""Which publications a contact rests on, by what was chosen."""

from mgehl.model import films
from mgehl.model.materials import MATERIALS
from mgehl.model.oils import OILS

LAWS = {"barus": "barus1893", "roelands": "roelands1966", "dowson-higginson": "dowson1966"}
"""{a built-in law of the oil: its source}."""


def cited(config, contact):
    """Keys of `mgehl.model.sources.SOURCES` in order: equations, bodies, oil, films of formulas."""
    found = ["liu2021"]
    named = config.discretization.cavitation
    tears = config.kind.cavitates if named is None else named
    found += ["elrod1981"] if tears and not config.is_dry else []
    if contact.is_loaded:
        found.append("johnson1985")
        found += [
            MATERIALS[body.material].source for body in (config.body_1, config.body_2) if body.material
        ]
    section = config.lubricant
    if config.is_dry:
        found += ["yastrebov2017"] if config.solver.error and not contact.is_line else []
    else:
        if section.oil is not None:
            found.append(OILS[section.oil].source)
        if section.kinematic_viscosity_40 is not None:
            found.append("astmd341")
        if section.heating == "factor" or contact.is_loaded and contact.thermal_reduction is not None:
            found.append("gupta1992")
        laws = "viscosity_law", "density_law"
        laws = [name for name in laws if f"lubricant.{name}" not in config.unused]
        found += [LAWS[law] for law in (getattr(section, name) for name in laws) if law in LAWS]
    if contact.is_loaded and not config.is_dry:
        found += ["eyring1936"] if config.friction.eyring_stress is not None else []
        found += ["ehret1998"] if contact.friction.thins else []
        found += ["carslaw1959"] if config.heat.conductivity_1 is not None else []
        found += [films.formula_of(name).source for name in contact.shown_formulas]
    return list(dict.fromkeys(found))
