import re
from importlib import import_module
from pathlib import Path

import pytest
from places import ROOT

PAGE = (ROOT / "mgehl" / "README.md").read_text()
NAMES = sorted(set(re.findall(r"mgehl(?:\.\w+)+", PAGE)))
LAYERS = "model|discretization|kinds|grid|multigrid|solver|output|studies"
PLACES = sorted(set(re.findall(rf"`((?:{LAYERS})(?:\.\w+)+)`", PAGE)))


def found(dotted):
    parts = dotted.split(".")
    for length in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for name in parts[length:]:
            thing = getattr(thing, name)
        return thing
    raise AssertionError(f"{dotted}: no such module")


@pytest.mark.parametrize("name", NAMES)
def test_a_line_of_pseudo_code_names_a_function(name):
    assert found(name)


@pytest.mark.parametrize("place", PLACES)
def test_a_place_is_there(place):
    assert found(f"mgehl.{place}")


CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text()


@pytest.mark.parametrize("file", sorted(set(re.findall(r"`([\w/]+\.py)`", CONTRIBUTING))))
def test_a_file_to_open_is_there(file):
    package = Path(found("mgehl").__file__).parent
    assert (package / file).exists() or ("/" not in file and list(package.rglob(file)))


@pytest.mark.parametrize(
    "name",
    ["model.lubricant.VISCOSITY_LAWS", "model.surface.files.read_map", "discretization.couette.SCHEMES"],
)
def test_what_to_change_there_has_the_name_that_contributing_tells(name):
    assert found(f"mgehl.{name}") and f"`{name.rpartition('.')[2]}`" in CONTRIBUTING
