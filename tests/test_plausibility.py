"""Values that are fine one by one and no contact together."""

import pytest

from mgehl.config import ConfigError, load_config
from mgehl.plausibility import check_contact
from mgehl.solver.from_config import contact_from


@pytest.mark.parametrize(
    "settings, key",
    [
        (["contact.radius_y=100", "contact.radius_x=0.001"], "contact.radius_y"),
        (["contact.load=1e9"], "contact.load"),
        (["contact.reduced_modulus=1e6"], "contact.load"),
        (["lubricant.pressure_viscosity=1e-6"], "lubricant.pressure_viscosity"),
        (["grid.x=[-1.000001, 1.000001]"], "grid.x"),
        (["motion.speed=1000"], "grid.x"),
        (["moes.M=1e7", "moes.L=100"], "moes.M"),
    ],
)
def test_one_line_names_the_key(settings, key):
    config = load_config(None, settings)
    with pytest.raises(ConfigError) as caught:
        check_contact(config, contact_from(config))
    assert str(caught.value).startswith(key) and "\n" not in str(caught.value)


def test_the_paper_s_contact_passes():
    config = load_config()
    check_contact(config, contact_from(config))
