import pytest
from told import refusal

from mgehl.config import config_from_tables, load_config
from mgehl.errors import ConfigError
from mgehl.kinds import check_contact, contact_from

DRY = {"discretization.contact_model": "dry"}
COATED = {"contact.deformation": "coated", "coating.thickness": 2e-4, "coating.modulus": 2e9}


def dry(**settings):
    """The paper's ball with other keys; a dot is written as two underscores."""
    return load_config(None, DRY | {key.replace("__", "."): value for key, value in settings.items()})


@pytest.mark.parametrize(
    "settings, said",
    [({"solver__method": "relaxation"}, 'solver.method = "relaxation": means nothing where'),
     ({"contact__kind": "wedge"}, "discretization.contact_model = 'dry': means nothing where")],
)  # fmt: skip
def test_what_makes_no_sense_is_one_line(settings, said):
    assert said in refusal(dry, **settings, error=ConfigError)


def test_a_domain_within_the_contact_is_one_line():
    config = load_config(None, DRY | COATED | {"grid.x": [-1.05, 3.0]})
    with pytest.raises(ConfigError, match="grid.x = .*must reach beyond .* on a layer so soft"):
        check_contact(config, contact_from(config))


@pytest.mark.parametrize("speed", [1e-9, 5e-6, 100.0])
def test_speed_and_lubricant_do_not_matter(speed):
    config = dry(motion__speed=speed, lubricant__viscosity=0.01, motion__angle=30.0)
    contact = contact_from(config)
    check_contact(config, contact)
    assert config.is_dry and contact.is_at_rest and contact.motion == (1.0, 0.0)
    assert {"motion.speed", "lubricant.viscosity", "relaxation.omega", "solver.start"} <= config.unused
    assert not {"discretization.contact_model", "solver.tolerance", "solver.max_steps"} & config.unused


def test_the_keys_of_its_fluid_are_kept():
    of_fluid = {"motion.speed": 3e-4, "lubricant.viscosity": 0.01, "solver.start": "film"}
    config = load_config(None, DRY | of_fluid)
    tables = config.as_toml_tables()
    assert config_from_tables(tables) == config
    del tables["discretization"]["contact_model"]
    assert config_from_tables(tables) == load_config(None, of_fluid)
