"""Where the values of a configuration come from: a file, one that comes with mgehl, a pipe, a setting."""

import os
import re
import select
import stat
import sysconfig
import tomllib
from collections.abc import Iterable, Mapping
from contextlib import contextmanager
from math import isfinite
from pathlib import Path

from mgehl.config_value import shown
from mgehl.errors import ConfigError

ROUGH_BALL, PAPERS_BALL = "rough.toml", "point_contact.toml"
"""Configurations that come with mgehl: the one it shows, and the one that settings alone change."""

_INSTALLED = Path("share") / "mgehl" / "configs"
_CONFIG_DIRECTORIES = (
    Path(__file__).resolve().parent.parent / "configs",
    Path(sysconfig.get_path("data")) / _INSTALLED,
    Path(sysconfig.get_path("data", f"{os.name}_user")) / _INSTALLED,
)
"""Where configurations live in a checkout, and where an installation puts them."""

PATIENCE = 30.0
"""Seconds without a word after which a pipe is given up."""

LARGEST_FILE = 10**6
"""Bytes of a configuration."""


def default_config():
    """Path of the configuration that settings change when none is named: the paper's ball."""
    return _shipped(PAPERS_BALL)


def chosen_config(path=None, settings=()):
    """Path of the configuration that a command line means: the one it names; without any, the paper's ball
    where settings change it, and else the rough ball."""
    if path:
        return Path(path)
    return default_config() if settings else _shipped(ROUGH_BALL)


def _shipped(name):
    """Path of a configuration that comes with mgehl."""
    paths = [directory / name for directory in _CONFIG_DIRECTORIES]
    return next((path for path in paths if path.exists()), paths[0])


def read_toml(path):
    """The nested values of a TOML file. Raises ConfigError."""
    try:
        return tomllib.loads(_text_of(path))
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:  # no TOML or no text, or a number or a nest too long
        raise ConfigError(f"{path}: not valid TOML: {error}") from None


def nested(settings):
    """The nested values of settings, "section.key=value" each or alone, or a mapping: of each "section.key"
    to its value, or of a section to its keys. Raises ConfigError."""
    settings = [settings] if isinstance(settings, str) else settings
    if not isinstance(settings, Iterable):
        raise ConfigError(f'settings = {shown(settings)}: must be {{"section.key": value, ...}}')
    pairs = _of_mapping(settings) if isinstance(settings, Mapping) else map(_read_setting, settings)
    tables = {}
    for name, value in pairs:
        section, dot, key = str(name).partition(".")
        if not (dot and section and key):
            raise ConfigError(f"{name} = {shown(value)}: must be section.key, such as grid.nodes")
        tables.setdefault(section, {})[key] = value
    return tables


def _of_mapping(settings):
    """Each "section.key" of a mapping with its value; a section may be a mapping of its keys."""
    for name, value in settings.items():
        if isinstance(value, Mapping) and "." not in str(name):
            yield from ((f"{name}.{key}", each) for key, each in value.items())
        else:
            yield name, value


def _read_setting(setting):
    """Name and value of one "section.key=value": TOML, a number that TOML does not know, or a string."""
    if not isinstance(setting, str):
        raise ConfigError(f'settings: {shown(setting)}: must be "section.key=value"')
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
        value = _number_or_text(text.strip())
    return f"{section}.{name}", value


def _number_or_text(text):
    """A number such as .045 or 1., which people write and TOML does not know, or the text as it is."""
    try:
        number = float(text)
    except ValueError:
        return text
    return number if isfinite(number) else text


@contextmanager
def naming_file(path, settings=()):
    """Let what is wrong with a file begin with its name; what is wrong with a setting has its key alone."""
    set_anew = {setting.partition("=")[0].strip() for setting in settings}
    try:
        yield
    except ConfigError as error:
        key = re.match(r"[\w.]+", str(error))
        if str(error).startswith((str(path), "--set")) or (key and key[0] in set_anew):
            raise
        raise ConfigError(f"{path}: {error}") from None


def _text_of(path):
    """The text of a file in UTF-8, as TOML demands, or what comes out of a pipe such as <(...). The null
    device is the empty configuration."""
    kind = path.stat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISFIFO(kind) or path == Path(os.devnull)):
        raise OSError("is no file")
    content = _out_of_pipe(path) if stat.S_ISFIFO(kind) else _beginning(path)
    if len(content) > LARGEST_FILE:
        raise OSError(f"has more than {LARGEST_FILE} bytes")
    try:
        return content.decode("utf-8-sig")  # some editors begin a file with a mark
    except UnicodeDecodeError as error:
        raise OSError(f"is no text in UTF-8 (byte {error.start + 1}): save it as UTF-8") from None


def _beginning(path):
    with path.open("rb") as file:
        return file.read(LARGEST_FILE + 1)


def _out_of_pipe(path):
    """What comes out of a pipe until its writer ends, or says nothing for too long."""
    content, number = b"", os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        while len(content) <= LARGEST_FILE:
            if not select.select([number], [], [], PATIENCE)[0]:
                raise OSError(f"is a pipe into which nobody writes, for {PATIENCE:g} s")
            part = os.read(number, LARGEST_FILE)
            if not part:
                break
            content += part
        return content
    finally:
        os.close(number)
