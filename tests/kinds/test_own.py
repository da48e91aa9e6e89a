"""The key of an own function that fails is named, even where two keys name the same function."""

import pytest

from mgehl.config import config_from_tables
from mgehl.errors import ConfigError
from mgehl.kinds import check_contact, contact_from
from mgehl.kinds.own import naming_keys

TABLES = {
    "lubricant": {"viscosity_law": "/m.py:law", "density_law": "/m.py:law"},
    "contact": {"surface": "/m.py:law", "deformation": "/m.py:law"},
    "motion": {"speed": 1.0},
}
FUNCTIONS = {
    "lubricant.viscosity_law": lambda contact: contact.lubricant.viscosity_law.function,
    "lubricant.density_law": lambda contact: contact.lubricant.density_law.function,
    "contact.surface": lambda contact: contact.surface.function,
    "contact.deformation": lambda contact: contact.deformation.function,
}


@pytest.mark.parametrize("key", FUNCTIONS)
def test_its_own_key_and_no_other(key):
    contact = contact_from(config_from_tables(TABLES))
    with pytest.raises(ConfigError) as caught, naming_keys(contact):
        raise FUNCTIONS[key](contact.at_speed(2.0)).error("is wrong")
    assert str(caught.value) == f"{key} = '/m.py:law': is wrong"


def test_the_ambient_viscosity_is_called_by_its_key(tmp_path):
    (tmp_path / "mine.py").write_text("def law(at): return 50.0, 0.0")
    config = config_from_tables({"lubricant": {"viscosity_law": f"{tmp_path}/mine.py:law"}})
    with pytest.raises(ConfigError, match="must be 0.096, lubricant.viscosity in Pa s$"):
        check_contact(config, contact_from(config))
