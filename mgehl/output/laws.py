"""A run's own laws and heights: their files are kept in its directory, for a run that goes on, too."""

import os
import re
from contextlib import suppress
from pathlib import Path

from mgehl.config import config_from_tables
from mgehl.kinds.time import is_table, with_recorded
from mgehl.model.own_function import file_and_function
from mgehl.output.whole_file import is_plain, whole_file

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


def laws_of(config):
    """{laws/NAME: bytes} of the files of own functions. Raises OSError."""
    return {name: Path(file).read_bytes() for file, name in law_files(config).items()}


def laws_beside(directory):
    """{laws/NAME: bytes} of the laws that the run in a directory has. Raises OSError."""
    folder = Path(directory) / FOLDER
    files = sorted(filter(is_plain, folder.iterdir())) if folder.is_dir() else ()
    return {f"{FOLDER}/{file.name}": file.read_bytes() for file in files}


def changed_laws(directory, config):
    """Files of own functions and of heights that are not what the run in a directory has kept of them, in
    order. Raises OSError."""
    kept = laws_beside(directory)
    return sorted(
        file for file, name in law_files(config).items() if name in kept and content_of(file) != kept[name]
    )


def portable(config):
    """The tables of a `Config` as they stand in a run directory: own functions in laws/."""
    return _moved(config.as_toml_tables(), law_files(config))


def placed(tables, places, courses=None):
    """The `Config` of such tables; `places` are the files that its laws are now, by their names. With
    `courses`, as `own_courses` has them, no function is run."""
    tables = _moved(tables, places)
    return config_from_tables(tables if courses is None else with_recorded(tables, courses))


def laws_in(tables):
    """Names of the laws of such tables."""
    return {file for _, _, (file, _) in _own(tables)}


def content_of(file):
    """The bytes of a plain file; None where there is none that can be read."""
    with suppress(OSError):
        return Path(file).read_bytes() if is_plain(file) else None


def is_law(name):
    """True of laws/NAME: nothing outside of a run's directory is named."""
    return re.fullmatch(r"laws/[^/\0]+", name) is not None and not name.endswith("/..")


def put_files(folder, files):
    """Write {name, such as laws/NAME: bytes} into a folder. Raises OSError."""
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        with whole_file(folder / name) as part:
            part.write_bytes(content)


def as_they_were(begun, folder, directory):
    """A run's `Config` with the laws where they were when it began, with the files that they read, if they
    are still the same; and messages. Raises OSError.

    Otherwise, as on another machine, the copies in `folder` are run. `begun` is the directory's `Begun`.
    """
    places, said = {}, []
    for name, place in begun.origins.items():
        origin = Path(os.path.normpath(Path(directory) / place))
        found, kept = content_of(origin), (folder / name).read_bytes()
        if found not in (None, kept):
            said.append(f"{origin} has changed since the run began, which goes on with its copy of it")
        places[name] = str((origin if found == kept else folder / name).resolve())
    return placed(begun.tables, places), said


def _own(tables):
    """(Section, key, (file, function)) of every own function in nested tables, and of files of heights. A
    file of heights, or a table of time, has no function: None."""
    for section, table in tables.items():
        for key, value in table.items():
            if (key == "file" and value is not None) or is_table(f"{section}.{key}", value):
                yield section, key, (value, None)
            elif found := file_and_function(value):
                yield section, key, found


def _moved(tables, places):
    """The tables with other files, {file: where it is}, for own functions and heights."""
    for section, key, (file, function) in _own(tables):
        file = places.get(file, file)
        tables[section][key] = file if function is None else f"{file}:{function}"
    return tables
