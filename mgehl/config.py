"""The configuration: TOML with SI numbers or strings with units, validated key by key.

Every mistake is one line that names the key, the value and what is allowed (`ConfigError`).
"""

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from math import pi
from os import PathLike
from pathlib import Path

from mgehl import config_sections as sections
from mgehl.config_file import default_config, nested, read_toml
from mgehl.config_mistakes import check_section, check_together, closest, closest_key, naming_words
from mgehl.config_value import chosen, read_value, shown
from mgehl.errors import ConfigError
from mgehl.kinds import KINDS, choices, derived
from mgehl.kinds.bodies import BodySection
from mgehl.kinds.choice import named, value_of
from mgehl.kinds.derived import NUMBERS, check_arms, left_over, orphans, overridden
from mgehl.kinds.dry import DRY
from mgehl.kinds.friction import FrictionSection
from mgehl.kinds.heat import HeatSection
from mgehl.kinds.lubricant import LubricantSection
from mgehl.kinds.point import CoatingSection, MoesSection
from mgehl.kinds.surface_kinds import SurfaceSection
from mgehl.kinds.time import TimeSection
from mgehl.kinds.wedge import WedgeSection

COARSEST_NODES = 33
"""Nodes along each side of the coarsest grid, which is solved directly."""


@dataclass(frozen=True, repr=False)
class Config:
    """A validated configuration."""

    contact: sections.ContactSection = sections.ContactSection()
    coating: CoatingSection = CoatingSection()
    wedge: WedgeSection = WedgeSection()
    lubricant: LubricantSection = LubricantSection()
    motion: sections.MotionSection = sections.MotionSection()
    time: TimeSection = TimeSection()
    body_1: BodySection = BodySection()
    body_2: BodySection = BodySection()
    friction: FrictionSection = FrictionSection()
    heat: HeatSection = HeatSection()
    surface: SurfaceSection = SurfaceSection()
    second_surface: SurfaceSection = SurfaceSection()
    moes: MoesSection = MoesSection()
    grid: sections.GridSection = sections.GridSection()
    discretization: sections.DiscretizationSection = sections.DiscretizationSection()
    solver: sections.SolverSection = sections.SolverSection()
    relaxation: sections.RelaxationSection = sections.RelaxationSection()

    @property
    def kind(self):
        """The `Kind` of contact, with a fluid or without."""
        return (DRY if self.is_dry else KINDS)[self.contact.kind]

    @property
    def is_dry(self):
        """Whether there is no fluid."""
        return self.discretization.contact_model == "dry"

    @property
    def is_in_time(self):
        """Whether it is a run in time, and no steady state."""
        return self.time.end is not None

    @property
    def unused(self):
        """Keys, "section.key", that do nothing for this contact."""
        found = choices(asdict(self))
        return {key for key in KEYS if any(c.leaves_out(key) or named(key, c.idle) for c in found)}

    def __repr__(self) -> str:
        """The keys that differ from their defaults."""
        changed = {key: self.value(key) for key, field in KEYS.items() if self.value(key) != field.default}
        return f"Config({', '.join(f'{key} = {value!r}' for key, value in changed.items())})"

    @property
    def physics(self):
        """Keys of the numbers that make this contact."""
        used = (key for key in self.kind.essential if key not in self.unused)
        return [key for key in used if KEYS[key].metadata["unit"] is not None]

    @property
    def derived(self):
        """The `Derived` keys, which follow from others. Raises ConfigError where those do not fit."""
        return [each for each in derived(self) if each.key in KEYS]

    @property
    def physical(self):
        """Every key that makes this contact: numbers of `physics`, laws of the oil, what else was set."""
        of = [key for key in KEYS if key.partition(".")[0] in PHYSICAL and key not in self.unused]
        always = {*self.physics, *(each.key for each in self.derived), *LAWS}
        return [key for key in of if key in always or self.value(key) != KEYS[key].default]

    def said(self, key):
        """A value with its unit."""
        value, unit = self.value(key), KEYS[key].metadata["unit"]
        if isinstance(value, bool) or not isinstance(value, int | float):
            return str(value)
        return f"{value:.6g} {unit or ''}".rstrip()

    @property
    def inputs(self):
        """{"section.key": value} of the numbers that make this contact, given or derived."""
        return {key: self.value(key) for key in (*self.physics, *(each.key for each in self.derived))}

    def with_numbers(self, numbers):
        """The same with other numbers, {"section.key": value}, for what is derived: as a run had them,
        whose version may have known materials and oils by other numbers."""
        config = self
        for key in (each.key for each in self.derived if each.key in numbers):
            section, _, name = key.partition(".")
            number = read_value(key, KEYS[key].metadata, numbers[key])
            config = replace(config, **{section: replace(getattr(config, section), **{name: number})})
        return config

    def value(self, key):
        """The value of "section.key"."""
        section, _, name = key.partition(".")
        return getattr(getattr(self, section), name)

    def with_(self, settings: Mapping[str, object] | Iterable[str]) -> "Config":
        """Another configuration with some keys set anew: {"motion.speed": "0.5 m/s", ...}, as --set does.
        Raises ConfigError, as `load_config`."""
        return config_from_tables(_set_anew(self.as_toml_tables(), settings))

    def as_toml_tables(self):
        """Nested plain values of the keys that are set and mean something: what a TOML file can hold."""
        tables = asdict(self)
        found = choices(tables)
        for section, table in tables.items():
            tables[section] = {
                key: list(value) if isinstance(value, tuple) else value
                for key, value in table.items()
                if value is not None and not _mean_nothing(f"{section}.{key}", found)
            }
        return {section: table for section, table in tables.items() if table}


PHYSICAL = (
    "contact", "body_1", "body_2", "coating", "wedge", "lubricant", "motion", "surface", "second_surface",
    "moes", "friction", "heat", "time",
)  # fmt: skip
"""Sections that tell what is solved; the others tell how."""

LAWS = "lubricant.viscosity_law", "lubricant.density_law"

SECTIONS = {section.name: type(section.default) for section in fields(Config)}
KEYS = {f"{name}.{key.name}": key for name, section in SECTIONS.items() for key in fields(section)}
"""Every key, "section.key", with its field, whose metadata are its rules."""


def _mean_nothing(key, choices):
    """Whether it is a mistake to give a key beside some choices."""
    return any(choice.means_nothing(key) for choice in choices)


def load_config(path=None, settings=()):
    """Read a TOML file (default: the paper's ball) and apply settings, "key=value" or a mapping. Raises
    ConfigError for anything that cannot be used."""
    return config_from_tables(read_tables(path, settings))


def not_given(config, tables):
    """{key: words} of the `physics` of a `Config` that its tables do not give: the paper's are taken, but
    of line contacts, of which the paper has none, a default. And of rotations that tell no unit."""
    known = {each.key for each in config.derived}
    missing = (key for key in config.physics if key not in known and value_of(tables, key) is None)
    whose = {key: "the default" if key == "contact.load_per_length" else "the paper's" for key in missing}
    words = {key: f"{key}: {config.said(key)} is {words}" for key, words in whose.items()}
    for key in (key for key, field in KEYS.items() if field.metadata["unit"] == "rad/s"):
        omega = value_of(tables, key)
        # One of many digits was reckoned, as in the file that a run leaves.
        if omega and not isinstance(omega, str) and omega == round(omega, 2):
            words[key] = f"the unit of {key}: rad/s is taken, which makes {30.0 / pi * omega:.4g} rpm"
    return words


def read_tables(path=None, settings=()):
    """The nested values, right or wrong, of which `load_config` makes a `Config`. Raises ConfigError."""
    if not isinstance(path, str | PathLike | None):
        raise ConfigError(
            f"{shown(path)}: must be the path of a configuration; keys are for mgehl.load(settings=...)"
        )
    path = Path(path) if path else default_config()
    tables = _in_our_words(read_toml(path))
    _anchor(tables, path.parent)
    return _set_anew(tables, settings)


def _set_anew(tables, settings):
    """Nested values with settings laid over them; keys that a setting leaves without a meaning go. What
    those gave beside it stays, as a number. Raises ConfigError."""
    given = _in_our_words(nested(settings))
    laid = _laid(_laid(tables, _left_alone(tables, given)), given)
    for section, _, key in (word.partition(".") for word in left_over(tables, laid, given)):
        laid[section].pop(key, None)
    check_arms(tables, laid, given)
    return laid


def _left_alone(tables, given):
    """Numbers, nested, that follow from words which are overruled by what is `given`. Where a viscosity is
    set over an oil, the oil goes, and its pressure_viscosity stays."""
    found = choices(tables)
    # A law beside a viscosity means something when the oil has gone, and not yet.
    others = {
        section: {
            key: value for key, value in table.items()
            if (name := f"{section}.{key}") not in NUMBERS and not _mean_nothing(name, found)
        }
        for section, table in given.items()
    }  # fmt: skip
    before = _laid(tables, others)
    alone = orphans(before, given)
    if not alone:
        return {}
    derived = config_from_tables(before).derived
    return nested({each.key: each.value for each in derived if each.key in alone})


def _laid(tables, given):
    """Nested values with others over them, without the keys that mean nothing beside those."""
    gone = [*choices(given), *overridden(given)]
    laid = {
        section: {
            key: value for key, value in table.items()
            if (name := f"{section}.{key}") not in KEYS or not _mean_nothing(name, gone)
        } if isinstance(table, dict) else table
        for section, table in tables.items()
    }  # fmt: skip
    for section, table in given.items():
        check_section(section, laid.setdefault(section, {}))
        laid[section] |= table
    return laid


def _in_our_words(tables):
    """Nested values in which a choice written in another way ("Line", "Si3N4") is the key's own."""
    for key, field in KEYS.items():
        if (word := chosen(field.metadata, value_of(tables, key))) is not None:
            tables[key.partition(".")[0]][field.name] = word
    return tables


def _anchor(tables, directory):
    """Count the paths of a file's own functions and surfaces from where that file is."""
    for key, field in KEYS.items():
        own, value = field.metadata["own"], value_of(tables, key)
        if own and value is not None and value not in (field.metadata["choices"] or ()):
            tables[key.partition(".")[0]][field.name] = own(value, directory) or value


def config_from_tables(tables):
    """Validate nested values as read from TOML."""
    sections = {}
    for section, table in tables.items():
        if section not in SECTIONS:
            if not isinstance(table, dict):
                raise ConfigError(f"{section} = {shown(table)}: must stand in a section, such as [contact]")
            raise ConfigError(f"{section} = {shown(table)}: unknown section{closest(section, SECTIONS)}")
        check_section(section, table)
        for name in table:
            if (key := f"{section}.{name}") not in KEYS:
                raise ConfigError(f"{key} = {shown(table[name])}: unknown key{closest_key(key, KEYS)}")
        keys = {name: f"{section}.{name}" for name in table}
        values = {name: read_value(key, KEYS[key].metadata, table[name]) for name, key in keys.items()}
        sections[section] = SECTIONS[section](**values)
    config = Config(**sections)
    check_together(config, tables)
    for each in config.derived:
        with naming_words(tables, each.key):
            config = config.with_numbers({each.key: each.value})
    config.kind.check_keys(config)
    return config


def checked_key(option, key):
    """A "section.key" that an option names. Raises ConfigError where there is none."""
    if key not in KEYS:
        raise ConfigError(f"{option} {key}: unknown key{closest_key(key, KEYS)}")
    return key
