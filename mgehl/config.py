"""The configuration: TOML with SI numbers or strings with units, validated key by key.

Every mistake is one line that names the key, the value and what is allowed (`ConfigError`).
"""

import difflib
import os
import sysconfig
import tomllib
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from mgehl.config_value import ConfigError, key_field, read_value
from mgehl.discretization.couette import SCHEMES
from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS

COARSEST_NODES = 33
"""Nodes along each side of the coarsest grid, which is solved directly."""

MOES_REPLACES = (("contact", "load"), ("motion", "speed"))
"""Keys that moes.M and moes.L stand for."""

_INSTALLED = Path("share") / "mgehl" / "configs"
_CONFIG_DIRECTORIES = (
    Path(__file__).resolve().parent.parent / "configs",
    Path(sysconfig.get_path("data")) / _INSTALLED,
    Path(sysconfig.get_path("data", f"{os.name}_user")) / _INSTALLED,
)
"""Where configurations live in a checkout, and where an installation puts them."""


@dataclass(frozen=True)
class ContactSection:
    kind: str = key_field("point", "kind of contact", choices=("point",), kind=str)
    load: float = key_field(800.0, "normal load", "N", low=1e-6, high=1e9)
    radius_x: float = key_field(12.7e-3, "reduced radius along the motion", "m", low=1e-6, high=100.0)
    radius_y: float = key_field(12.7e-3, "reduced radius across the motion", "m", low=1e-6, high=100.0)
    reduced_modulus: float = key_field(
        219.78e9, "E' of 2/E' = sum of (1 - nu^2)/E", "Pa", low=1e6, high=1e13
    )


@dataclass(frozen=True)
class LubricantSection:
    viscosity: float = key_field(0.096, "viscosity at ambient pressure", "Pa*s", low=1e-6, high=1e4)
    viscosity_law: str = key_field(
        "barus", "viscosity-pressure law", choices=tuple(VISCOSITY_LAWS), kind=str
    )
    pressure_viscosity: float = key_field(
        18.2e-9, "pressure-viscosity coefficient", "1/Pa", low=1e-10, high=1e-6
    )
    density_law: str = key_field(
        "dowson-higginson", "density-pressure law", choices=tuple(DENSITY_LAWS), kind=str
    )


@dataclass(frozen=True)
class MotionSection:
    speed: float = key_field(5e-6, "entrainment speed u of the flow rho u h", "m/s", low=1e-12, high=1e3)


@dataclass(frozen=True)
class MoesSection:
    M: float | None = key_field(None, "Moes load number, instead of load and speed", "", low=1.0, high=1e7)
    L: float | None = key_field(
        None, "Moes material number, instead of load and speed", "", low=0.1, high=100.0
    )


@dataclass(frozen=True)
class GridSection:
    nodes: int = key_field(257, "nodes along each side, 2^k + 1", low=65, high=16385, kind=int)
    x: tuple = key_field((-1.9, 1.3), "domain along x in units of the Hertz semi-axis a", kind=tuple)
    y: tuple = key_field((-1.5, 1.5), "domain along y in units of the Hertz semi-axis b", kind=tuple)


@dataclass(frozen=True)
class DiscretizationSection:
    couette: str = key_field(
        "1B", "differential scheme of the Couette flow", choices=tuple(SCHEMES), kind=str
    )
    film_threshold: float = key_field(0.02e-9, "gap H_th at which a node is in contact", "m", low=0.0)


@dataclass(frozen=True)
class SolverSection:
    tolerance: float = key_field(1e-8, "rms residual and load error at convergence", above=0.0, high=1e-2)
    start: str = key_field(
        "film", "first guess: a full film, or the Hertz ellipse in contact",
        choices=("film", "contact"), kind=str,
    )  # fmt: skip
    max_steps: int = key_field(60, "Newton steps on one grid at the most", low=1, high=10000, kind=int)
    linear_tolerance: float = key_field(
        0.1, "relative tolerance of GMRES in a Newton step", above=0.0, high=0.5
    )
    sweeps: int = key_field(
        1, "line relaxations before and after the coarse grids", low=1, high=10, kind=int
    )
    omega: float = key_field(0.8, "damping of the line relaxation", above=0.0, high=1.0)
    first_nodes: int = key_field(65, "nodes of the first grid of the nested iteration", low=33, kind=int)
    inlet_cells: float = key_field(
        2.0, "cells the inlet gets on coarse grids by raising the speed", low=0.0
    )
    release_budget: int = key_field(
        2, "times a contact node may be released on Eq. 2 after convergence", low=0, high=100, kind=int
    )


@dataclass(frozen=True)
class Config:
    """A validated configuration."""

    contact: ContactSection = ContactSection()
    lubricant: LubricantSection = LubricantSection()
    motion: MotionSection = MotionSection()
    moes: MoesSection = MoesSection()
    grid: GridSection = GridSection()
    discretization: DiscretizationSection = DiscretizationSection()
    solver: SolverSection = SolverSection()

    def as_toml_tables(self):
        """Nested plain values, without the keys that are not set: what a TOML file can hold."""
        tables = {name: _without_none(section) for name, section in asdict(self).items()}
        if self.moes.M is not None:
            del tables["contact"]["load"], tables["motion"]
        return {name: table for name, table in tables.items() if table}


def _without_none(section):
    plain = {key: list(value) if isinstance(value, tuple) else value for key, value in section.items()}
    return {key: value for key, value in plain.items() if value is not None}


def default_config():
    """Path of the configuration that runs when none is named."""
    paths = [directory / "point_contact.toml" for directory in _CONFIG_DIRECTORIES]
    return next((path for path in paths if path.exists()), paths[0])


SECTIONS = {section.name: type(section.default) for section in fields(Config)}


def load_config(path=None, settings=()):
    """Read a TOML file (default: the point contact) and apply `key=value` settings.

    Raises ConfigError for anything that cannot be used.
    """
    tables = _read_toml(Path(path) if path else default_config())
    if any(setting.strip().startswith("moes.") for setting in settings):
        # Moes numbers set by hand replace the file's load and speed.
        for section, key in MOES_REPLACES:
            if isinstance(tables.get(section), dict):
                tables[section].pop(key, None)
    for setting in settings:
        _apply_setting(tables, setting)
    return config_from_tables(tables)


def check_ranks(ranks):
    """Raise ConfigError if the lines of the coarsest grid cannot be shared by so many ranks."""
    most = (COARSEST_NODES - 1) // 2
    if ranks > most:
        raise ConfigError(
            f"{ranks} ranks: at most {most} can share the coarsest grid of {COARSEST_NODES} lines"
        )


def config_from_tables(tables):
    """Validate nested values as read from TOML."""
    sections = {}
    for name, table in tables.items():
        if name not in SECTIONS:
            raise ConfigError(f"{name} = {table!r}: unknown section{_closest(name, SECTIONS)}")
        if not isinstance(table, dict):
            raise ConfigError(f"{name} = {table!r}: is a section, its keys go under [{name}]")
        sections[name] = _section(name, table)
    config = Config(**sections)
    _check_together(config, tables)
    return config


def _section(name, table):
    known = {key.name: key for key in fields(SECTIONS[name])}
    for key in table:
        if key not in known:
            raise ConfigError(f"{name}.{key} = {table[key]!r}: unknown key{_closest_key(name, key)}")
    return SECTIONS[name](
        **{key: read_value(f"{name}.{key}", known[key].metadata, table[key]) for key in table}
    )


def _check_together(config, tables):
    """Rules that concern more than one key."""
    nodes = config.grid.nodes
    if (nodes - 1) & (nodes - 2):
        lower = 2 ** ((nodes - 1).bit_length() - 1) + 1
        raise ConfigError(f"grid.nodes = {nodes}: must be 2^k + 1, such as {lower} or {2 * lower - 1}")
    if (config.moes.M is None) != (config.moes.L is None):
        missing = "moes.L" if config.moes.L is None else "moes.M"
        raise ConfigError(f"{missing}: must be given too, moes.M and moes.L go together")
    if config.moes.M is not None:
        for section, key in MOES_REPLACES:
            if key in tables.get(section, {}):
                raise ConfigError(
                    f"{section}.{key} = {tables[section][key]!r}: cannot be given with moes.M and moes.L"
                )
    try:
        VISCOSITY_LAWS[config.lubricant.viscosity_law](
            config.lubricant.viscosity, config.lubricant.pressure_viscosity
        )
    except ValueError as error:
        raise ConfigError(f"lubricant.viscosity = {config.lubricant.viscosity!r}: {error}") from None


def _read_toml(path):
    try:
        return tomllib.loads(path.read_text())
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ConfigError(f"{path}: not valid TOML: {error}") from None


def _apply_setting(tables, setting):
    """Put one "section.key=value" into the tables; the value is TOML, or else a plain string."""
    key, equals, text = setting.partition("=")
    section, dot, name = (part.strip() for part in key.partition("."))
    if not (equals and dot and section and name):
        raise ConfigError(
            f"--set {' '.join(setting.split())}: must be section.key=value, such as grid.nodes=513"
        )
    try:
        parsed = tomllib.loads(f"value = {text}")
        value = parsed["value"] if len(parsed) == 1 else text.strip()
    except tomllib.TOMLDecodeError:
        value = text.strip()
    table = tables.setdefault(section, {})
    if not isinstance(table, dict):
        raise ConfigError(f"{section} = {table!r}: is a section, its keys go under [{section}]")
    table[name] = value


def _closest(name, known):
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.4)
    return f"; did you mean {close[0]}?" if close else f"; known are {', '.join(known)}"


def _closest_key(section, key):
    """The nearest known key, of this section if one is near, else of any."""
    everywhere = [f"{name}.{each.name}" for name, kind in SECTIONS.items() for each in fields(kind)]
    close = difflib.get_close_matches(f"{section}.{key}", everywhere, n=1, cutoff=0.6)
    same_name = [each for each in everywhere if each.endswith(f".{key}")]
    return f"; did you mean {(same_name or close)[0]}?" if same_name or close else ""
