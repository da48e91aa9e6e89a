"""Where things are in the repository, and what a run leaves in its directory."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CONFIGS = ROOT / "configs"
ROUGH = CONFIGS / "rough.toml"

RUN_FILES = {"configuration.toml", "fields.h5", "history.csv", "picture.png", "result.json"}
"""Of a run that has ended."""


def names_in(directory):
    """What is in a directory."""
    return {path.name for path in Path(directory).iterdir()}


def content_of(directory):
    """{name: bytes} of the files in a directory."""
    return {path.name: path.read_bytes() for path in Path(directory).iterdir() if path.is_file()}
