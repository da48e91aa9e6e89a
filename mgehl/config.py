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
from mgehl.config_file import text_of
from mgehl.config_value import read_value, shown
from mgehl.errors import ConfigError
from mgehl.kinds import KINDS
from mgehl.kinds.dry import DRY
from mgehl.kinds.point import CoatingSection, MoesSection
from mgehl.kinds.surface_keys import SurfaceSection
from mgehl.kinds.wedge import WedgeSection

COARSEST_NODES = 33
"""Nodes along each side of the coarsest grid, which is solved directly."""

ROUGH_BALL, PAPERS_BALL = "rough.toml", "point_contact.toml"
"""Configurations that come with mgehl: the one it shows, and the one that settings alone change."""

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
    coating: CoatingSection = CoatingSection()
    wedge: WedgeSection = WedgeSection()
    lubricant: sections.LubricantSection = sections.LubricantSection()
    motion: sections.MotionSection = sections.MotionSection()
    surface: SurfaceSection = SurfaceSection()
    second_surface: SurfaceSection = SurfaceSection()
    moes: MoesSection = MoesSection()
    grid: sections.GridSection = sections.GridSection()
    discretization: sections.DiscretizationSection = sections.DiscretizationSection()
    solver: sections.SolverSection = sections.SolverSection()
    relaxation: sections.RelaxationSection = sections.RelaxationSection()

    @property
    def kind(self):
        """The `Kind` of contact."""
        kinds = KINDS | DRY if self.discretization.contact_model == "dry" else KINDS
        return kinds[self.contact.kind]

    @property
    def is_dry(self):
        """Whether there is no fluid."""
        return self.kind in DRY.values()

    @property
    def unused(self):
        """Sections and keys that this contact has no use for."""
        return *self._meaningless, *self.kind.unheeded(self)

    @property
    def _meaningless(self):
        """Those that may not even stand there."""
        return *FOREIGN[self.contact.kind], *self.kind.unused(self)

    def as_toml_tables(self):
        """Nested plain values, without the keys that are not set: what a TOML file can hold."""
        tables = {name: _without_none(section) for name, section in asdict(self).items()}
        _remove(tables, self._meaningless)
        return {name: table for name, table in tables.items() if table}


def _remove(tables, names):
    """Take sections and keys out of nested tables, where they are there."""
    for name in names:
        section, _, key = name.partition(".")
        if not key:
            tables.pop(section, None)
        elif isinstance(tables.get(section), dict):
            tables[section].pop(key, None)


def _without_none(section):
    plain = {key: list(value) if isinstance(value, tuple) else value for key, value in section.items()}
    return {key: value for key, value in plain.items() if value is not None}


def default_config():
    """Path of the configuration that settings change when none is named: the paper's ball."""
    return _shipped(PAPERS_BALL)


def chosen_config(path=None, settings=()):
    """Path of the configuration that a command line means.

    The one it names; without any, the paper's ball where there are settings to change it, and else the
    rough ball.
    """
    if path:
        return Path(path)
    return default_config() if settings else _shipped(ROUGH_BALL)


def _shipped(name):
    """Path of a configuration that comes with mgehl."""
    paths = [directory / name for directory in _CONFIG_DIRECTORIES]
    return next((path for path in paths if path.exists()), paths[0])


SECTIONS = {section.name: type(section.default) for section in fields(Config)}


def _foreign(kind):
    """Sections that a kind does not use at all, and single keys of the other sections."""
    for name, section in SECTIONS.items():
        keys = [f"{name}.{key.name}" for key in fields(section)]
        not_taken = [key for key in keys if not {name, key} & {"contact.kind", *kind.takes}]
        yield from [name] if not_taken == keys else not_taken


FOREIGN = {name: tuple(_foreign(kind)) for name, kind in KINDS.items()}
"""Sections and keys that a kind of contact does not use."""


def load_config(path=None, settings=()):
    """Read a TOML file (default: the paper's ball) and apply settings, "key=value" or a mapping.

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
    """{"section.key": value} of a mapping or of "section.key=value" words; of two for one key the last one
    counts."""
    if isinstance(settings, Mapping):
        return {str(name): value for name, value in settings.items()}
    return dict(map(read_setting, settings))


def _push_out(tables, given):
    """Drop keys of the file that a setting leaves without a use, as another kind does, or Moes numbers."""
    _remove(tables, FOREIGN.get(str(given.get("contact.kind")), ()))
    for kind in KINDS.values():
        _remove(tables, kind.pushed_out(given))


def _anchor(tables, directory):
    """Count the paths of a file's own functions and surfaces from where that file is."""
    for name, section in SECTIONS.items():
        table = tables.get(name)
        for key in fields(section) if isinstance(table, dict) else ():
            own = key.metadata["own"]
            if own and key.name in table and table[key.name] not in (key.metadata["choices"] or ()):
                table[key.name] = own(table[key.name], directory) or table[key.name]


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
    config.kind.check_keys(config, tables)


def _check_foreign(kind, tables):
    """A key that this kind of contact does not use is a mistake."""
    for name in FOREIGN[kind]:
        section, _, key = name.partition(".")
        given = tables.get(section, {})
        if key and key in given:
            raise ConfigError(f'{name} = {shown(given[key])}: means nothing where contact.kind = "{kind}"')
        if not key and given:
            raise ConfigError(f'[{section}]: means nothing where contact.kind = "{kind}"')


def _read_toml(path):
    try:
        return tomllib.loads(text_of(path))
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:  # no TOML or no text, or a number or a nest too long
        raise ConfigError(f"{path}: not valid TOML: {error}") from None


def read_setting(setting):
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
