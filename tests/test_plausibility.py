"""Values that are fine one by one and no contact together."""

import os

import pytest
from told import refusal

from mgehl.config import load_config
from mgehl.errors import ConfigError
from mgehl.kinds import check_contact, contact_from


def error_of(settings, path=os.devnull):
    config = load_config(path, settings)
    return refusal(lambda: check_contact(config, contact_from(config)), error=ConfigError)


@pytest.mark.parametrize(
    "settings, key",
    [(["contact.radius_y=100", "contact.radius_x=0.001"], "contact.radius_y"),
     (["contact.load=1e9"], "contact.load"), (["contact.reduced_modulus=1e6"], "contact.load"),
     (["lubricant.pressure_viscosity=1e-7"], "lubricant.pressure_viscosity"),
     (["grid.x=[-1.000001, 1.000001]"], "grid.x"), (["motion.speed=1000"], "grid.x"),
     (["moes.M=1e7", "moes.L=100"], "moes.M")],
)  # fmt: skip
def test_one_line_names_the_key(settings, key):
    assert error_of(settings, None).startswith(key)


class TestTheInletLiesUpstream:
    """The domain of each case ends beside the contact on one side: if that is upstream, it is refused."""

    SIDES = {
        "left": ("grid.x=[-1.01, 1.9]", "grid.y=[-1.9, 1.9]", "grid.x", "begin before -1."),
        "right": ("grid.x=[-1.9, 1.01]", "grid.y=[-1.9, 1.9]", "grid.x", "end beyond 1."),
        "below": ("grid.x=[-1.9, 1.9]", "grid.y=[-1.01, 1.9]", "grid.y", "begin before -1."),
        "above": ("grid.x=[-1.9, 1.9]", "grid.y=[-1.9, 1.01]", "grid.y", "end beyond 1."),
    }

    UPSTREAM = {
        0: ("left",), 30: ("left", "below"), 90: ("below",), 135: ("right", "below"), 180: ("right",),
        "-90 deg": ("above",), 315: ("left", "above"),
    }  # fmt: skip

    @pytest.mark.parametrize("side", SIDES)
    @pytest.mark.parametrize("angle", UPSTREAM)
    def test_a_domain_without_room_for_it(self, angle, side):
        *domain, key, words = self.SIDES[side]
        settings = [f"motion.angle={angle}", "motion.speed=1 m/s", "contact.radius_y=20 mm", *domain]
        if side not in self.UPSTREAM[angle]:
            config = load_config(os.devnull, settings)
            check_contact(config, contact_from(config))
        else:
            message = error_of(settings)
            assert message.startswith(key) and words in message and "inlet" in message


LINE, WEDGE = "contact.kind=line", "contact.kind=wedge"
SQUARE = (WEDGE, "wedge.pillar=square")
POCKET = ("wedge.pocket_depth=1 um", "wedge.pocket_from=30 mm", "wedge.pocket_to=30.1 mm")


@pytest.mark.parametrize(
    "settings, start, words",
    [([LINE, "contact.load_per_length=1e9"], "contact.load_per_length: ", ["wide", "half"]),
     ([LINE, "contact.reduced_modulus=1e6"], "contact.load_per_length: ", ["0.0127 m"]),
     ([LINE, "grid.x=[-1.000001, 1.5]"], "grid.x", ["begin before"]),
     ([*SQUARE, "wedge.pillar_x=0.1"], "wedge.pillar_x = 0.1: ", ["exit at 0.02", "inlet at 0.05"]),
     ([*SQUARE, "wedge.pillar_x=23 mm"], "wedge.pillar_x = 0.023: ", ["pillar of 0.008 m"]),
     ([*SQUARE, "wedge.pillar_y=7 mm"], "wedge.pillar_y = 0.007: ", ["width of 0.02"]),
     ([*SQUARE, "wedge.pillar_y=-7 mm"], "wedge.pillar_y = -0.007: ", ["width of 0.02"]),
     ([*SQUARE, "wedge.pillar_size=20 mm"], "wedge.pillar_y = 0: ", ["pillar of 0.02 m"]),
     ([WEDGE, "wedge.pillar=cylinder", "wedge.pillar_size=40 mm"], "wedge.pillar_x", ["0.04 m"]),
     ([*SQUARE, "wedge.pillar_size=1e-5"], "wedge.pillar_size = 1e-05: ", ["at least 2 cells"]),
     ([WEDGE, "grid.nodes=65", "wedge.exit=1e-5"], "wedge.exit = 1e-05: ", ["2 cells", "65 nodes"]),
     ([WEDGE, "wedge.width=1e-5"], "wedge.width = 1e-05: ", ["within a factor of 100"]),
     ([WEDGE, "grid.nodes=65", *POCKET], "wedge.pocket_to = 0.0301: ", ["at least 2 cells", "65 nodes"])],
)  # fmt: skip
def test_lines_and_wedges_are_checked_too(settings, start, words):
    message = error_of(settings)
    assert message.startswith(start) and all(word in message for word in words)


def test_the_place_of_no_pillar_does_not_matter():
    config = load_config(os.devnull, [WEDGE, "wedge.pillar_x=0.1"])
    check_contact(config, contact_from(config))
