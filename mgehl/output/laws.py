"""A run's own laws and heights: their files are kept in its directory, with their hash."""

import os
from pathlib import Path

from mgehl.config import config_from_tables
from mgehl.model.own_function import file_and_function
from mgehl.output.manifest import checksum

FOLDER = "laws"


def law_files(config):
    """{file: its name in a run directory} of all own functions of a `Config`, such as laws/my_laws.py."""
    named = {}
    for _, _, (file, _) in _own(config.as_toml_tables()):
        if file not in named:
            name = Path(file).name
            while f"{FOLDER}/{name}" in named.values():
                name = f"_{name}"
            named[file] = f"{FOLDER}/{name}"
    return named


def portable(config):
    """The tables of a `Config` as they stand in a run directory: own functions in laws/."""
    tables, names = config.as_toml_tables(), law_files(config)
    for section, key, (file, function) in _own(tables):
        tables[section][key] = _value(names[file], function)
    return tables


def laws(config):
    """{laws/NAME: bytes} of the files of own functions. Raises OSError."""
    return {name: Path(file).read_bytes() for file, name in law_files(config).items()}


def origins(config, directory):
    """{laws/NAME: where that file is, counted from a directory}."""
    return {name: os.path.relpath(file, directory) for file, name in law_files(config).items()}


def as_they_were(config, manifest, directory):
    """A `Config` with the laws where they were when the run began, if they are still the same there; and
    messages. There a law finds the files that it reads. Otherwise, as on another machine, the copies are
    run.
    """
    there, said = {}, []
    for file, name in law_files(config).items():
        if name not in manifest.origins:
            continue
        origin = Path(os.path.normpath(Path(directory) / manifest.origins[name]))
        found = checksum(origin)
        if found == manifest.files.get(name):
            there[file] = str(origin.resolve())
        elif found:
            said.append(f"{origin} has changed since the run began, which goes on with its copy of it")
    tables = config.as_toml_tables()
    for section, key, (file, function) in _own(tables):
        tables[section][key] = _value(there.get(file, file), function)
    return config_from_tables(tables), said


def changed_copies(config):
    """Files in the laws/ of run directories that are not as those runs left them."""
    from mgehl.output.manifest import read_manifest

    for file in map(Path, law_files(config)):
        manifest = read_manifest(file.parent.parent) if file.parent.name == FOLDER else None
        known = manifest.files.get(f"{FOLDER}/{file.name}") if manifest else None
        if known and known != checksum(file):
            yield file


def _own(tables):
    """(Section, key, (file, function)) of every own function in nested tables, and of files of heights.

    A file of heights has no function: None.
    """
    for section, table in tables.items():
        for key, value in table.items():
            if key == "file" and value is not None:
                yield section, key, (value, None)
            elif found := file_and_function(value):
                yield section, key, found


def _value(file, function):
    """What stands for a function of a file, or for a file of heights, in a configuration."""
    return file if function is None else f"{file}:{function}"
