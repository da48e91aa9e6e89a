"""The configuration: TOML with SI numbers or strings with units, validated key by key.

Every mistake is one line that names the key, the value and what is allowed (`ConfigError`).
"""

import difflib
import os
import sysconfig
import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from mgehl import config_sections as sections
from mgehl.config_value import read_value, shown
from mgehl.errors import ConfigError
from mgehl.model.coating import Coating
from mgehl.model.lubricant import VISCOSITY_LAWS
from mgehl.model.own_function import absolute, is_own

COARSEST_NODES = 33
"""Nodes along each side of the coarsest grid, which is solved directly."""

MOES_REPLACES = (("contact", "load"), ("motion", "speed"))
"""Keys that moes.M and moes.L stand for."""

FOREIGN = {
    "point": ("contact.load_per_length", "wedge"),
    "line": (
        "contact.load", "contact.radius_y", "contact.deformation", "coating", "grid.y", "moes", "wedge",
    ),
    "wedge": (
        "contact.load", "contact.load_per_length", "contact.radius_x", "contact.radius_y",
        "contact.reduced_modulus", "contact.deformation", "contact.surface", "coating",
        "lubricant.pressure_viscosity",
        "lubricant.viscosity_law", "lubricant.density_law", "moes", "grid.x", "grid.y",
        "discretization.contact_model", "discretization.unified_gap", "discretization.film_threshold",
        "solver.method", "solver.start", "solver.first_nodes", "solver.inlet_cells",
        "solver.release_budget", "solver.linear_tolerance", "solver.sweeps", "solver.omega",
        "solver.cycle_couette", "relaxation",
    ),
}  # fmt: skip
"""Sections and keys that a kind of contact has no use for."""

_INSTALLED = Path("share") / "mgehl" / "configs"
_CONFIG_DIRECTORIES = (
    Path(__file__).resolve().parent.parent / "configs",
    Path(sysconfig.get_path("data")) / _INSTALLED,
    Path(sysconfig.get_path("data", f"{os.name}_user")) / _INSTALLED,
)
"""Where configurations live in a checkout, and where an installation puts them."""


@dataclass(frozen=True)
class Config:
    """A validated configuration."""

    contact: sections.ContactSection = sections.ContactSection()
    coating: sections.CoatingSection = sections.CoatingSection()
    wedge: sections.WedgeSection = sections.WedgeSection()
    lubricant: sections.LubricantSection = sections.LubricantSection()
    motion: sections.MotionSection = sections.MotionSection()
    moes: sections.MoesSection = sections.MoesSection()
    grid: sections.GridSection = sections.GridSection()
    discretization: sections.DiscretizationSection = sections.DiscretizationSection()
    solver: sections.SolverSection = sections.SolverSection()
    relaxation: sections.RelaxationSection = sections.RelaxationSection()

    @property
    def unused(self):
        """Sections and keys that this contact has no use for."""
        return *FOREIGN[self.contact.kind], *_without_coating(self.contact.deformation)

    def as_toml_tables(self):
        """Nested plain values, without the keys that are not set: what a TOML file can hold."""
        tables = {name: _without_none(section) for name, section in asdict(self).items()}
        if self.moes.M is not None:
            del tables["contact"]["load"], tables["motion"]["speed"]
        for name in self.unused:
            section, _, key = name.partition(".")
            if key:
                tables[section].pop(key, None)
            else:
                tables.pop(section, None)
        return {name: table for name, table in tables.items() if table}


def _without_coating(deformation):
    """Sections that a deformation has no use for."""
    return () if deformation == "coated" else ("coating",)


def _without_none(section):
    plain = {key: list(value) if isinstance(value, tuple) else value for key, value in section.items()}
    return {key: value for key, value in plain.items() if value is not None}


def default_config():
    """Path of the configuration that runs when none is named."""
    paths = [directory / "point_contact.toml" for directory in _CONFIG_DIRECTORIES]
    return next((path for path in paths if path.exists()), paths[0])


SECTIONS = {section.name: type(section.default) for section in fields(Config)}


def load_config(path=None, settings=()):
    """Read a TOML file (default: the point contact) and apply settings, "key=value" or a mapping.

    Raises ConfigError for anything that cannot be used.
    """
    path = Path(path) if path else default_config()
    tables = _read_toml(path)
    _anchor(tables, path.parent)
    given = _pairs(settings)
    _push_out(tables, given)
    for name, value in given.items():
        _apply(tables, name, value)
    return config_from_tables(tables)


def _pairs(settings):
    """{"section.key": value} of a mapping or of "section.key=value" words, the last one in authority."""
    if isinstance(settings, Mapping):
        return {str(name): value for name, value in settings.items()}
    return dict(map(_read_setting, settings))


def _push_out(tables, given):
    """Drop what the file says and a setting makes meaningless: another kind, Moes numbers, no coating."""
    names = list(FOREIGN.get(str(given.get("contact.kind")), ()))
    if "contact.deformation" in given:
        names += _without_coating(given["contact.deformation"])
    if any(key.startswith("moes.") for key in given):
        names += [f"{section}.{key}" for section, key in MOES_REPLACES]
    for name in names:
        section, _, key = name.partition(".")
        if not key:
            tables.pop(section, None)
        elif isinstance(tables.get(section), dict):
            tables[section].pop(key, None)


def _anchor(tables, directory):
    """Count the paths of a file's own functions from where that file is."""
    for table in tables.values():
        for key, value in table.items() if isinstance(table, dict) else ():
            table[key] = absolute(value, directory) or value


def config_from_tables(tables):
    """Validate nested values as read from TOML."""
    sections = {}
    for name, table in tables.items():
        if name not in SECTIONS:
            raise ConfigError(f"{name} = {shown(table)}: unknown section{_closest(name, SECTIONS)}")
        if not isinstance(table, dict):
            raise ConfigError(f"{name} = {shown(table)}: is a section, its keys go under [{name}]")
        sections[name] = _section(name, table)
    config = Config(**sections)
    _check_together(config, tables)
    return config


def _section(name, table):
    known = {key.name: key for key in fields(SECTIONS[name])}
    for key in table:
        if key not in known:
            raise ConfigError(f"{name}.{key} = {shown(table[key])}: unknown key{_closest_key(name, key)}")
    return SECTIONS[name](
        **{key: read_value(f"{name}.{key}", known[key].metadata, table[key]) for key in table}
    )


def _check_together(config, tables):
    """Rules that concern more than one key."""
    nodes = config.grid.nodes
    if (nodes - 1) & (nodes - 2):
        lower = 2 ** ((nodes - 1).bit_length() - 1) + 1
        raise ConfigError(f"grid.nodes = {nodes}: must be 2^k + 1, such as {lower} or {2 * lower - 1}")
    _check_foreign(config.contact.kind, tables)
    if (config.moes.M is None) != (config.moes.L is None):
        missing = "moes.L" if config.moes.L is None else "moes.M"
        raise ConfigError(f"{missing}: must be given too, moes.M and moes.L go together")
    if config.moes.M is not None:
        for section, key in MOES_REPLACES:
            if key in tables.get(section, {}):
                value = shown(tables[section][key])
                raise ConfigError(f"{section}.{key} = {value}: cannot be given with moes.M and moes.L")
    wedge = config.wedge
    if not wedge.exit < wedge.inlet:
        raise ConfigError(f"wedge.inlet = {wedge.inlet:g}: must be above wedge.exit = {wedge.exit:g}")
    _check_coating(config, tables)
    if is_own(config.lubricant.viscosity_law):
        return
    try:
        VISCOSITY_LAWS[config.lubricant.viscosity_law](
            config.lubricant.viscosity, config.lubricant.pressure_viscosity
        )
    except ValueError as error:
        raise ConfigError(f"lubricant.viscosity = {shown(config.lubricant.viscosity)}: {error}") from None


def _check_coating(config, tables):
    deformation, coating = config.contact.deformation, config.coating
    if deformation != "coated":
        if tables.get("coating"):
            raise ConfigError(f'[coating]: means nothing where contact.deformation = "{deformation}"')
        return
    for key in ("thickness", "modulus"):
        if getattr(coating, key) is None:
            raise ConfigError(f'coating.{key}: must be given where contact.deformation = "coated"')
    try:
        Coating(**asdict(coating), reduced_modulus=config.contact.reduced_modulus)
    except ValueError as error:
        raise ConfigError(f"coating.substrate_modulus = {coating.substrate_modulus!r}: {error}") from None


def _check_foreign(kind, tables):
    """A key that this kind of contact would not heed is a mistake."""
    for name in FOREIGN[kind]:
        section, _, key = name.partition(".")
        given = tables.get(section, {})
        if key and key in given:
            raise ConfigError(f'{name} = {shown(given[key])}: means nothing where contact.kind = "{kind}"')
        if not key and given:
            raise ConfigError(f'[{section}]: means nothing where contact.kind = "{kind}"')


def _read_toml(path):
    try:
        return tomllib.loads(path.read_text())
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, RecursionError) as error:  # no TOML or no text, or a number or a nest too long
        raise ConfigError(f"{path}: not valid TOML: {error}") from None


def _read_setting(setting):
    """Name and value of one "section.key=value"; the value is TOML, or else a plain string."""
    key, equals, text = setting.partition("=")
    section, dot, name = (part.strip() for part in key.partition("."))
    if not (equals and dot and section and name):
        raise ConfigError(
            f"--set {' '.join(setting.split())}: must be section.key=value, such as grid.nodes=513"
        )
    try:
        parsed = tomllib.loads(f"value = {text}")
        value = parsed["value"] if len(parsed) == 1 else text.strip()
    except (ValueError, RecursionError):
        value = text.strip()
    return f"{section}.{name}", value


def _apply(tables, name, value):
    """Put the value of "section.key" into the tables."""
    section, dot, key = name.partition(".")
    if not (dot and section and key):
        raise ConfigError(f"{name} = {shown(value)}: must be section.key, such as grid.nodes")
    table = tables.setdefault(section, {})
    if not isinstance(table, dict):
        raise ConfigError(f"{section} = {shown(table)}: is a section, its keys go under [{section}]")
    table[key] = value


def _closest(name, known):
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    return f"; did you mean {close[0]}?" if close else f"; known are {', '.join(known)}"


def _closest_key(section, key):
    """The nearest known key, of this section if one is near, else of any."""
    everywhere = [f"{name}.{each.name}" for name, kind in SECTIONS.items() for each in fields(kind)]
    close = difflib.get_close_matches(f"{section}.{key}", everywhere, n=1, cutoff=0.6)
    same_name = [each for each in everywhere if each.endswith(f".{key}")]
    return f"; did you mean {(same_name or close)[0]}?" if same_name or close else ""
