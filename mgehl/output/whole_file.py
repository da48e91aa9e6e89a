"""A text file that is there whole or not at all."""

import os
from pathlib import Path

from mgehl.errors import OutputError


def write_whole(path, text):
    """Write `text` beside `path` and rename it; what was there before stays where that fails.

    Raises OutputError.
    """
    path = Path(path)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(text)
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise OutputError(f"{path}: cannot be written: {error.strerror}") from None
