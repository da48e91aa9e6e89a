import re

from places import ROOT

from mgehl.version import VERSION

CITATION = (ROOT / "CITATION.cff").read_text()


def said(key):
    return re.findall(rf"^{key}: (.+)$", CITATION, re.MULTILINE)


def test_changelog_begins_with_this_version_and_the_day_that_citation_names():
    headings = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    headings = [heading for heading in headings if heading != "Unreleased"]
    assert said("version") == [VERSION]
    assert headings[:1] == [f"{VERSION} - {day}" for day in said("date-released")]
