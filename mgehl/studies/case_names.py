"""Names of the run directories of a study's cases: by all that an answer depends on, the code included."""

import hashlib
import json
import re
from functools import cache
from pathlib import Path

from mgehl.version import VERSION

COMPUTING = (
    *(f"{layer}/**/*.py" for layer in ("model", "discretization", "kinds", "grid", "multigrid", "solver")),
    *("output/*.py", "run.py", "studies/branch.py"),
)
"""Modules that make an answer: after a change in one of them cases are solved anew."""

LONGEST = 60
"""Characters of a title that are in a name."""


def key_of(description):
    """A hash of plain data and of the code."""
    text = json.dumps([VERSION, code(), description], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@cache
def code():
    """A hash of what is `COMPUTING`."""
    root, digest = Path(__file__).parents[1], hashlib.sha256()
    for pattern in COMPUTING:
        for module in sorted(root.glob(pattern)):
            digest.update(module.read_bytes())
    return digest.hexdigest()


def directory_of(folder, title, description):
    """Path in a folder; a case that is there by another title has its name by that."""
    key = key_of(description)
    words = re.sub(r"[^\w.]+", "-", title, flags=re.ASCII)[:LONGEST].strip("-.")
    return next(iter(sorted(Path(folder).glob(f"*-{key}"))), Path(folder) / f"{words}-{key}")
