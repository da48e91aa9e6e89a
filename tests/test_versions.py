"""One version, wherever it is told."""

import re
from pathlib import Path

from mgehl.version import VERSION

ROOT = Path(__file__).resolve().parent.parent


def test_citation_names_this_version():
    assert re.findall(r"^version: (.+)$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE) == [VERSION]


def test_changelog_has_a_heading_for_this_version_beneath_what_is_not_released():
    headings = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert headings[0] == "Unreleased" and headings[1] == VERSION
