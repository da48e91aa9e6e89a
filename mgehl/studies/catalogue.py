"""The studies by name: what each is, and which options of `mgehl study` it takes."""

from typing import NamedTuple


class Entry(NamedTuple):
    """A study."""

    what: str
    grids: int | None = None
    """How many grids --nodes must name, where that is limited; 0 where it has its own."""
    doubles: bool = False
    """Whether each grid has half the spacing of the one before: it tells orders and limits."""
    draws: bool = False
    """Whether chance draws its cases."""


STUDIES = {
    "wedge": Entry("the rigid wedge bearing: Figures 7 to 10, exact series", doubles=True),
    "grid": Entry("full contact and full film on ever finer grids: Figures 11 to 13"),
    "transition": Entry("from full film to full contact and back: Figure 14, Table 1"),
    "methods": Entry("Newton beside relaxation, interface conditions beside none", grids=0),
    "schemes": Entry("a film by every differential scheme", doubles=True),
    "error": Entry("do the bands about films hold? Point contacts by chance", doubles=True, draws=True),
    "rough": Entry("do the bands about rough contacts hold? By chance", grids=0, draws=True),
    "passages": Entry("do the bands about runs in time hold? By chance", doubles=True, draws=True),
    "mixed": Entry("rough balls by chance: verdicts and work", grids=1, draws=True),
    "machine": Entry("rough contacts of machines by chance: verdicts and gaps", grids=1, draws=True),
    "rollers": Entry("rough line contacts by chance: verdicts and gaps", grids=1, draws=True),
    "stribeck": Entry("friction of a rough ball over speed, three oils", grids=1),
    "solids": Entry("from which lambda on solids carry load: at rest and moving", grids=1),
    "waviness": Entry("waves in the film of a line contact, beside published numbers", grids=0),
    "moving": Entry("waves and a dimple that pass through full films", grids=1),
    "courses": Entry("speed, direction and load that change", grids=1),
    "dry": Entry("dry contacts beside a public code's numbers"),
}

WHAT = {name: entry.what for name, entry in STUDIES.items()} | {
    "sweep": "a contact at many values of its keys, each point from its neighbours"
}
"""As a page introduces them."""
