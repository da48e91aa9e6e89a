import os
from dataclasses import replace
from math import pi

import pytest
from places import CONFIGS
from told import refusal

from mgehl.config import KEYS, ConfigError, config_from_tables, load_config, not_given
from mgehl.kinds import contact_from
from mgehl.kinds.bodies import arms
from mgehl.kinds.derived import EITHER, FOLLOWS, NEEDS
from mgehl.kinds.heat import heat_words
from mgehl.model.oils import OILS

STEEL = {"body_1.material": "steel", "body_2.material": "steel"}
OIL = {"lubricant.oil": "M100", "lubricant.temperature": "60 degC"}
TWO = {"lubricant.kinematic_viscosity_40": "68 cSt", "lubricant.kinematic_viscosity_100": "8.5 cSt"}


def of(settings):
    return load_config(os.devnull, settings)


def test_a_6206_of_a_catalogue_has_the_numbers_that_were_worked_out_by_hand():
    config = load_config(CONFIGS / "bearing_6206.toml")
    assert 1e3 * config.contact.radius_x == pytest.approx(3.776, abs=5e-4)
    assert 1e3 * config.contact.radius_y == pytest.approx(163.5, abs=0.05)
    assert config.motion.speed == pytest.approx(6.916, abs=5e-4)
    assert config.lubricant.viscosity == pytest.approx(0.0171, abs=5e-5)
    assert config.contact.reduced_modulus == pytest.approx(206e9 / 0.91, rel=1e-14)
    formulas = contact_from(config).formulas
    assert 1e9 * formulas["hamrock_dowson_central"] == pytest.approx(370.3, rel=5e-4)
    assert 1e9 * formulas["hamrock_dowson_minimum"] == pytest.approx(298.1, rel=5e-4)


def test_what_is_derived_is_not_written_and_comes_out_the_same_when_read_again():
    config = load_config(CONFIGS / "bearing_6206.toml")
    tables = config.as_toml_tables()
    assert "radius_x" not in tables["contact"] and "speed" not in tables["motion"]
    assert config_from_tables(tables) == config
    assert config.inputs["motion.speed"] == config.motion.speed


def test_numbers_of_a_run_stand_for_those_of_this_version():
    config = of(STEEL).with_numbers({"contact.reduced_modulus": 2e11, "contact.load": 1.0})
    assert config.contact.reduced_modulus == 2e11 and config.contact.load == 800.0


def test_inner_and_outer_ring_of_one_bearing_have_the_same_speed():
    ball = {"body_1.diameter": "10 mm", "motion.ring_rotation": "6000 rpm"}
    inner, outer = (of(ball | {"body_2.diameter": f"{d} mm"}).motion.speed for d in (40, -60))
    assert inner == pytest.approx(outer, rel=1e-14)
    # Whichever body is named first: the one with a groove, or hollow, is the ring.
    turned = {"body_2.diameter": "10 mm", "motion.ring_rotation": "6000 rpm"}
    for ring in ({"body_1.diameter": "40 mm", "body_1.conformity": 0.52}, {"body_1.diameter": "-60 mm"}):
        assert of(turned | ring).motion.speed == pytest.approx(inner, rel=1e-14)
    # No slip: the ring turns against the cage, which turns by half as much as the ball's centre is away.
    omega = 200.0 * pi
    assert inner == pytest.approx((omega - 0.5 * omega * (1.0 - 0.2)) * 20e-3, rel=1e-14)


def test_viscosity_by_density_and_by_two_temperatures():
    data = {"lubricant.kinematic_viscosity": "20 cSt", "lubricant.density": "0.85 g/cm^3"}
    assert of(data).lubricant.viscosity == pytest.approx(0.017)
    for temperature, nu in (("40 degC", 68.0), ("373.15 K", 8.5), ("100 C", 8.5), ("104 degF", 68.0)):
        config = of(TWO | {"lubricant.temperature": temperature, "lubricant.density": 850})
        assert config.lubricant.viscosity == pytest.approx(1e-6 * nu * 850.0, rel=1e-6)


@pytest.mark.parametrize("name, eta, alpha", [("N100", 27, 22.9), ("M100", 31, 19.1), ("PAO100", 37, 13.8)])
def test_an_oil_by_its_name(name, eta, alpha):
    config = of(OIL | {"lubricant.oil": name})
    assert 1e3 * config.lubricant.viscosity == pytest.approx(eta, abs=0.5)
    assert 1e9 * config.lubricant.pressure_viscosity == pytest.approx(alpha, abs=0.06)
    law = contact_from(config).lubricant.viscosity_law
    assert law == OILS[name].law(config.lubricant.temperature)


def value_for(key):
    rules = KEYS[key].metadata
    low = 0.6 if rules["above"] else (rules["low"] or 0.0)
    low = low if low > 0.0 else min(1e-4, rules["high"] or 1e-4)
    return rules["choices"][0] if rules["choices"] else low


def refused_together(*keys):
    tables = {}
    for key in keys:
        section, _, name = key.partition(".")
        tables.setdefault(section, {})[name] = value_for(key)
    return refusal(config_from_tables, tables, error=ConfigError)


@pytest.mark.parametrize("one, other", EITHER)
def test_two_ways_to_say_one_thing_are_a_mistake(one, other):
    said = refused_together(one, other)
    assert "means nothing with" in said and one in said and other in said


@pytest.mark.parametrize("targets, words", FOLLOWS)
def test_a_number_and_the_words_that_it_follows_from_are_a_mistake(targets, words):
    for target in (target for target in targets if target in KEYS):
        for word in words:
            said = refused_together(target, word)
            assert "follows already with" in said and target in said and word.partition(".")[0] in said


@pytest.mark.parametrize("word", NEEDS)
def test_what_a_word_needs_is_named(word):
    message = refusal(of, {word: value_for(word)})
    assert message.startswith(NEEDS[word][0]) and f"must be given with {word}" in message


@pytest.mark.parametrize(
    "settings, parts",
    [
        ({"body_1.material": "steel"}, ["body_2.material or body_2.modulus: must be given"]),
        ({"body_1.speed": 1}, ["body_2.speed or body_2.rotation: must be given beside a speed of body_1"]),
        ({"body_1.speed": 1, "body_2.speed": -1}, ["1 and -1 m/s", "mean must be positive"]),
        ({"body_1.radius_x": "5 mm"}, ["body_1.radius_y or body_2.radius_y: must be given"]),
        ({"body_1.diameter": "10 mm", "body_2.radius_y": "-4 mm"}, ["along y", "1/5 + 1/-4"]),
        ({"body_1.diameter": "900 m"}, ["body_1.diameter: contact.radius_x = 450.0: must be"]),
        ({"body_1.diameter": 0}, ["body_1: a radius of 0 m along x: must be at least"]),
        ({"body_2.conformity": 0.52}, ["body_2.conformity: needs"]),
        ({"body_1.rotation": "60 rpm", "body_2.speed": 0}, ["body_1.rotation_radius: must be given"]),
        ({"lubricant.temperature": 333, "lubricant.viscosity": 0.01}, ["nothing without lubricant.oil"]),
        ({"lubricant.density": 850}, ["density = 850: means nothing without lubricant.kinematic_visc"]),
        ({"body_1.rotation": "100 Hz"}, ["turns or radians", "6000 rpm"]),
        ({"motion.ring_rotation": "60 rpm"}, ["ring_rotation: needs diameter or radius_x of a ball"]),
        ({"body_1.diameter": 0.04, "body_2.diameter": 0.01, "motion.ring_rotation": 9}, ["exchange them"]),
        ({"motion.speed": "6000 rpm"}, ["wrong unit", "motion.ring_rotation take rpm"]),
        ({"lubricant.viscosity": "20.3 cSt"}, ["wrong unit", "lubricant.kinematic_viscosity takes cSt"]),
        ({"lubricant.oil": "olive"}, ["must be one of N100, M100, PAO100"]),
        ({"lubricant.oil": "M100", "lubricant.temperature": 60}, ["temperature = 60", "at least 200"]),
        ({"body_1.material": "stel"}, ["must be one of steel"]),
        ({"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_x": 1e-5,
          "body_1.roughness": "50 nm"}, ["body_1.roughness", "means nothing with surface.kind"]),
        (TWO | {"lubricant.kinematic_viscosity_100": "70 cSt", "lubricant.temperature": "60 degC",
                "lubricant.density": 850}, ["kinematic_viscosity_40", "must be above"]),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_one_line(settings, parts):
    message = refusal(of, settings)
    assert all(part in message for part in parts), message


def test_a_setting_takes_the_place_of_what_a_file_says_otherwise():
    config = load_config(CONFIGS / "bearing_6206.toml")
    slower = config.with_({"motion.speed": "3 m/s"})
    assert slower.motion.speed == 3.0 and slower.motion.ring_rotation is None
    assert slower.contact == config.contact
    oil = config.with_(OIL)
    assert oil.lubricant.kinematic_viscosity is None
    assert oil.lubricant.viscosity != config.lubricant.viscosity
    glass = config.with_({"body_2.modulus": "82 GPa", "body_2.poisson": 0.206})
    assert glass.body_2.material is None


def test_a_setting_pushes_out_no_more_than_it_replaces():
    """One key of motion dropped the speeds of both bodies: a stranger solved at the paper's 5e-6 m/s."""
    bodies = {"body_1.diameter": "19 mm", "body_1.speed": "1 m/s", "body_2.rotation": "90 rad/s"}
    bodies |= STEEL | OIL | {"body_2.rotation_radius": "10 mm", "body_2.radius_y": "1 m"}
    config = of(bodies)
    slides = config.with_({"motion.slide_to_roll": 0.2})
    assert slides.motion.speed == config.motion.speed == 0.95 and slides.motion.slide_to_roll == 0.2
    faster = config.with_({"motion.speed": 2.0})
    assert faster.motion.slide_to_roll == config.motion.slide_to_roll == pytest.approx(0.1 / 0.95)
    assert config.with_({"motion.speed": 2.0, "body_1.diameter": "20 mm"}).contact.radius_x == 0.01
    narrow = config.with_({"contact.radius_x": "5 mm"}).contact
    assert (narrow.radius_x, narrow.radius_y) == (5e-3, config.contact.radius_y)
    thin = config.with_({"lubricant.viscosity": 0.01}).lubricant
    assert (thin.viscosity, thin.pressure_viscosity) == (0.01, config.lubricant.pressure_viscosity)
    law = {"lubricant.viscosity": 0.01, "lubricant.viscosity_law": "roelands"}
    assert config.with_(law).lubricant == replace(thin, viscosity_law="roelands")


def test_a_radius_that_takes_the_arm_of_a_rotation_says_so():
    roller = {"body_1.radius_x": "9 mm", "body_1.rotation": "3000 rpm", "body_2.speed": 0}
    roller["contact.kind"] = "line"
    words = "contact.radius_x = '5 mm': takes the place of body_1.radius_x, by which body_1.rotation is"
    with pytest.raises(ConfigError, match=words):
        of(roller).with_({"contact.radius_x": "5 mm"})
    bearing = load_config(CONFIGS / "bearing_6206.toml")
    with pytest.raises(ConfigError, match="motion.ring_rotation is a speed: set motion.speed, too"):
        bearing.with_({"contact.radius_y": "50 mm"})
    arm = {"contact.radius_x": "5 mm", "body_1.rotation_radius": "9 mm"}
    assert of(roller).with_(arm).motion.speed == of(roller).motion.speed


@pytest.mark.parametrize("setting", ["lubricant.viscosity=.01", "lubricant.oil=M100", "motion.speed=1",
    "lubricant.kinematic_viscosity=9 cSt", "lubricant.pressure_viscosity=9 1/GPa", "body_1.speed=1",
    "motion.ring_rotation=9 rpm"])  # fmt: skip
@pytest.mark.parametrize("oil", [OIL, TWO | {"lubricant.temperature": 330, "lubricant.density": 850}])
def test_what_nothing_uses_any_more_goes_with_what_a_setting_replaces(setting, oil):
    balls = {"body_1.diameter": "9 mm", "body_2.diameter": "50 mm", "body_2.speed": 0}
    config = of(balls | oil | {"body_1.rotation": "9 rpm", "body_1.rotation_radius": "1 mm"})
    if setting.startswith("lubricant.kin") and oil is OIL:
        setting = {"lubricant.kinematic_viscosity": 9e-6, "lubricant.density": 850}
    config.with_(setting if isinstance(setting, dict) else [setting])


def test_a_bearing_may_slip_and_keeps_its_speed():
    config = load_config(CONFIGS / "bearing_6206.toml")
    slips = config.with_({"motion.slide_to_roll": 0.1})
    assert slips.motion.speed == config.motion.speed and slips.motion.ring_rotation is not None
    faster = slips.with_({"motion.ring_rotation": "9000 rpm"})
    assert faster.motion.speed == pytest.approx(1.5 * config.motion.speed)
    assert faster.motion.slide_to_roll == 0.1


def test_a_dry_contact_has_bodies_and_no_motion():
    dry = {"discretization.contact_model": "dry", "body_1.rotation_radius": 0.1, "body_1.rotation": "1 rpm"}
    config = of(STEEL | dry | {"body_2.speed": 0})
    assert {"body_1.rotation", "motion.speed"} <= config.unused


@pytest.mark.parametrize(
    "known, said",
    [({"thermoviscosity": 0.01}, "beta 0.01 1/K, k 0.14 W/(m K) as is usual"),
     ({"conductivity": 0.1}, "k 0.1 W/(m K), beta 0.04 1/K as is usual"),
     ({}, "beta 0.04 1/K and k 0.14 W/(m K) as is usual")],
)  # fmt: skip
def test_heat_of_the_inlet_goes_by_what_the_oil_tells(known, said):
    config = of({"motion.speed": 10.0} | {f"lubricant.{name}": value for name, value in known.items()})
    (words,) = heat_words(config, contact_from(config))
    assert said in words


@pytest.mark.parametrize("angle, turns, found", [(0.0, {}, (0.03, 0.01)), (90.0, {}, (0.01, None)),
    (-180.0, {}, (0.03, 0.01)), (30.0, {}, (None, None)),
    (90.0, {"body_1.rotation": 9.0, "body_2.speed": 1.0}, (0.03, None))])  # fmt: skip
def test_a_body_rolls_on_its_radius_along_the_motion(angle, turns, found):
    """On that of its speed if it turns; on none where it is flat that way, or goes along neither axis."""
    settings = {"body_1.radius_x": 0.03, "body_1.radius_y": 0.01, "body_2.radius_x": 0.01, **turns}
    assert tuple(arms(load_config(None, settings), angle)) == found


def test_a_ball_rolls_on_its_radius_and_who_tells_it_on_that():
    settings = {"body_1.diameter": 0.02, "body_2.conformity": 0.52, "body_2.rotation_radius": 0.04}
    config = load_config(
        None, settings | {"body_2.radius_x": -0.1, "body_2.rotation": 9.0, "body_1.speed": 1}
    )
    assert arms(config, 30.0) == [0.01, 0.04]


def test_a_constant_viscosity_answers_to_no_pressure():
    """People looked for it among the laws, and found 0 as the pressure's coefficient."""
    law = {"lubricant.viscosity_law": "constant"}
    config, named = of(law), of({"lubricant.pressure_viscosity": 0.0})
    assert config.lubricant.pressure_viscosity == 0.0
    assert contact_from(config).groups == contact_from(named).groups
    assert of({"lubricant.pressure_viscosity": 1e-8}).with_(law).lubricant == config.lubricant
    with pytest.raises(ConfigError, match="give one of them"):
        of(law | {"lubricant.pressure_viscosity": 1e-8})


@pytest.mark.parametrize(
    "unit",
    [" rpm", "Rpm", " 1/min", " 1 / min", "/min", " U/min", "Upm", " min-1", " r/min", " min\u207b\u00b9"],
)
def test_a_rotation_is_read_as_catalogues_print_it(unit):
    """1/min was of what, turns or radians."""
    body = {"body_1.diameter": "10 mm", "body_1.rotation": f"6000{unit}", "body_2.speed": 0}
    assert of(STEEL | body).body_1.rotation == pytest.approx(200.0 * pi)


@pytest.mark.parametrize(
    "said, is_told",
    [(6000, True), ("6000 rpm", False), ("628 rad/s", False), (0, False), (628.3185307179587, False)],
)
def test_a_rotation_without_a_unit_is_said_to_be_one_of_radians(said, is_told):
    tables = {"body_1": {"rotation": said}}
    told = not_given(
        of(STEEL | {"body_1.diameter": "10 mm", "body_1.rotation": 1.0, "body_2.speed": 0}), tables
    )
    assert ("rad/s is taken, which makes 5.73e+04 rpm" in told.get("body_1.rotation", "")) is is_told


@pytest.mark.parametrize("said", ["20 %", "20%", "2e1 %"])
def test_slip_may_be_given_in_per_cent_and_a_whole_number_may_not(said):
    assert of({"motion.slide_to_roll": said}).motion.slide_to_roll == pytest.approx(0.2)
    with pytest.raises(ConfigError, match="must be a whole number"):
        of({"grid.nodes": "6500 %"})
