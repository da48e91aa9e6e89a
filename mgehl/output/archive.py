"""Plain data and arrays in one file, zipped as numpy does, which knows again each bit of them.

Nothing in such a file is ever run.
"""

import json
import os
from zipfile import ZipFile

import numpy as np
from numpy.lib import format as npy

from mgehl.output.whole_file import is_plain, whole_file, writing

RECORD = "record"
"""Member that holds the plain data as JSON; the others are the arrays."""


def save(path, record, arrays):
    """Write a record and its arrays as one whole file. Raises OutputError."""
    members = {RECORD: np.frombuffer(json.dumps(record).encode(), np.uint8), **arrays}
    with writing(path):
        path.parent.mkdir(exist_ok=True)
        # Not `numpy.savez`: where the disk is full it leaves a file that complains at length.
        with whole_file(path) as part, ZipFile(part, "w") as archive:
            for name, array in members.items():
                with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                    npy.write_array(member, array, allow_pickle=False)


def unpacked(path):
    """(record, arrays) of a file.

    What a damaged file raises is anybody's guess; FileNotFoundError where there is none. A link, a pipe or
    a device is not read: it may have no end.
    """
    if os.path.lexists(path) and not is_plain(path):
        raise ValueError("it is no plain file")
    with np.load(path, allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    return json.loads(arrays.pop(RECORD).tobytes()), arrays
