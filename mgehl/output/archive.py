"""Plain data and arrays in one file: record.json with arrays beside it, zipped as numpy does.

`numpy.load` reads them, too. Nothing in such a file is ever run. The record's "checksum" is the SHA-256 of
the rest of it and of all arrays.
"""

import hashlib
import io
import json
import os
from zipfile import ZipFile

import numpy as np
from numpy.lib import format as npy

from mgehl.errors import OutputError
from mgehl.output.whole_file import is_plain, whole_file

RECORD = "record.json"
"""Member of a file; the others are its arrays."""

CHECKSUM = "checksum"


def save(path, record, arrays):
    """Write a record and its arrays as one whole file. Raises OutputError."""
    record = record | {CHECKSUM: _checksum(record, arrays)}
    try:
        path.parent.mkdir(exist_ok=True)
        with whole_file(path) as part, ZipFile(part, "w") as archive:
            archive.writestr(RECORD, json.dumps(record))
            for name, array in arrays.items():
                with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                    npy.write_array(member, array, allow_pickle=False)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None


def unpacked(path):
    """(record, arrays, whether they are those that were saved) of a file.

    What a damaged file raises is anybody's guess; FileNotFoundError where there is none. A link, a pipe or
    a device is not read: it may have no end.
    """
    if os.path.lexists(path) and not is_plain(path):
        raise ValueError("it is no plain file")
    with ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    record = dict(json.loads(members.pop(RECORD)))
    arrays = {
        name.removesuffix(".npy"): npy.read_array(io.BytesIO(member), allow_pickle=False)
        for name, member in members.items()
    }
    return record, arrays, record.pop(CHECKSUM, None) == _checksum(record, arrays)


def _checksum(record, arrays):
    """SHA-256 of a record and its arrays."""
    digest = hashlib.sha256(json.dumps(record, sort_keys=True).encode())
    for name, array in sorted(arrays.items()):
        digest.update(f"{name} {array.dtype} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).data)
    return digest.hexdigest()
