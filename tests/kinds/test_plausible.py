import os
import re
from types import SimpleNamespace

import numpy as np
import pytest
from places import CONFIGS

from mgehl.config import load_config
from mgehl.errors import ConfigError
from mgehl.kinds import checked_case, contact_from, mesh_from
from mgehl.kinds.cited import cited
from mgehl.kinds.heat import factor_words
from mgehl.kinds.plausible import implausible
from mgehl.model.sources import SOURCES

BALL = {"motion.speed": "1 m/s"}
STEEL = {"conductivity": 46.0, "capacity": 3.6e6}
SLIDES = {"motion.slide_to_roll": 0.1}
BOTH = {f"heat.{name}_{body}": value for name, value in STEEL.items() for body in (1, 2)}
LAYER = {"contact.deformation": "coated", "coating.thickness": "0.1 mm", "coating.modulus": "50 MPa"}
OIL = BALL | {"lubricant.oil": "PAO100", "lubricant.temperature": "60 degC"}


def odd(settings, path=os.devnull):
    config = load_config(path, settings)
    return list(implausible(config, contact_from(config)))


@pytest.mark.parametrize("path", sorted(CONFIGS.glob("*.toml")), ids=lambda path: path.stem)
def test_nothing_is_odd_in_what_comes_with_mgehl(path):
    assert odd({}, path) == []


def test_gels_and_rubber_are_machines_too():
    gel = {"contact.reduced_modulus": "80 kPa", "contact.load": "1 mN", "lubricant.viscosity": "1 mPa s"}
    rubber = {"contact.reduced_modulus": "20 MPa", "contact.load": "1 N", "lubricant.viscosity": "0.1 Pa s"}
    assert odd(BALL | gel | {"motion.speed": "1 mm/s"}) == [] and odd(BALL | rubber) == []


@pytest.mark.parametrize(
    "settings, words",
    [({"lubricant.viscosity": "100 Pa s"}, "lubricant.viscosity = 100 Pa s: machines have 0.0002 to 5"),
     ({"lubricant.viscosity": "17.1 Pa s"}, "lubricant.viscosity = 17.1 Pa s"),
     ({"body_1.Ra": "30 um"}, "body_1.Ra = 3e-05 m: machines have 0 to 2e-05"),
     ({"contact.radius_x": "10 m", "contact.radius_y": "10 m"}, "contact.radius_x = 10 m"),
     ({"contact.radius_x": "10 m", "contact.radius_y": "10 m"}, "GPa: hard bodies mostly have 0.1 to 5"),
     ({"contact.reduced_modulus": "2 kPa", "contact.load": "1 uN"}, "contact.reduced_modulus = 2000 Pa"),
     ({"contact.reduced_modulus": "20 MPa", "contact.load": "80 N"}, "strains are not small"),
     ({"contact.load": "10 kN"}, "p_h = 5.25 GPa: above 5 GPa all steels yield"),
     ({"motion.speed": "300 m/s"}, "motion.speed = 300 m/s"),
     ({"body_1.roughness": "50 um"}, "body_1.roughness"), ({"motion.speed": "100 m/s"}, "um by a formula"),
     ({"lubricant.viscosity_law": "roelands", "lubricant.pressure_viscosity": "45 1/GPa"}, "its z is 1.2"),
     (OIL | {"lubricant.temperature": "0 degC"}, "PAO100 was measured from 40 to 100 C"),
     (OIL, "p_h = 2.26 GPa: PAO100 was measured up to 1 GPa: its law is extended beyond"),
     ({"contact.load": "1 mN", "lubricant.viscosity": "1 Pa s"}, "fold apart"),
     ({"motion.speed": "0.1 um/s", "solver.start": "film"}, "below discretization.film_threshold"),
     (SLIDES | BOTH | {"heat.capacity_1": 3600.0}, "heat.capacity_1 = 3600 J/(m3 K): machines have 500000"),
     (SLIDES | BOTH | {"lubricant.conductivity": 140.0}, "lubricant.conductivity = 140 W/(m K)"),
     (SLIDES | BOTH | LAYER, "flash temperatures know no layer"), (BOTH, "bodies that do not slide"),
     (SLIDES | {"friction.model": "eyring", "friction.eyring_stress": 7200.0}, "eyring_stress = 7200 Pa"),
     (LAYER | {"coating.thickness": "2 um"}, "presses a layer of 2 um by some"),
     (LAYER | {"coating.thickness": "40 mm"}, "coating.thickness = 40 mm is more than a radius of 12.7")],
)  # fmt: skip
def test_what_is_unusual_is_named(settings, words):
    found = odd(BALL | settings)
    assert any(words in line for line in found), found


def test_a_run_cites_what_it_used():
    config = load_config(None, OIL | {"body_1.material": "glass", "body_2.material": "steel"})
    found = cited(config, contact_from(config))
    assert found[:3] == ["liu2021", "elrod1981", "johnson1985"]
    assert {"schott", "iso6336", "arana2019", "dowson1966", "hamrock1977", "grubin1949"} <= set(found)
    assert "barus1893" not in found and set(found) <= set(SOURCES)
    dry = load_config(None, {"discretization.contact_model": "dry"})
    assert cited(dry, contact_from(dry)) == ["liu2021", "johnson1985", "yastrebov2017"]
    wedge = load_config(CONFIGS / "wedge_open.toml")
    assert cited(wedge, contact_from(wedge)) == ["liu2021"]
    torn = wedge.with_({"discretization.cavitation": True})
    assert cited(torn, contact_from(torn)) == ["liu2021", "elrod1981"]


@pytest.mark.parametrize(
    "radius, off", [("9 mm", None), ("30 mm", "off by a fifth"), ("50 mm", "off by half")]
)
def test_formulas_are_not_made_for_contacts_that_are_long_along_the_motion(radius, off):
    settings = {"contact.radius_x": radius, "contact.radius_y": "5 mm", "contact.load": "100 N"}
    found = [line for line in odd(BALL | settings) if "film formulas" in line]
    assert (off in found[0]) if off else not found


@pytest.mark.parametrize(
    ("height", "spacing", "is_odd"), [(1e-7, 2e-3, True), (1e-7, 2e-6, False), (0.0, 2e-6, False)]
)
def test_spacings_that_have_another_unit_are_odd(tmp_path, height, spacing, is_odd):
    """Steps of 2 mm for 2 um made a lambda of 48 for .56, and "resolved"."""
    path = tmp_path / "heights.txt"
    np.savetxt(path, height * np.random.default_rng(1).standard_normal((200, 200)))
    settings = {"surface.file": str(path), "surface.height_unit": "m", "surface.spacing": spacing}
    assert any("the unit of the file's spacing" in line for line in odd(BALL | settings)) is is_odd


HIP = {
    "contact.load": "1500 N", "motion.speed": "10 mm/s", "lubricant.viscosity": 5e-3,
    "body_1.modulus": "210 GPa", "body_1.poisson": 0.3, "body_1.diameter": "28 mm",
    "body_2.modulus": "1 GPa", "body_2.poisson": 0.4,
}  # fmt: skip

WAVES = {"surface.kind": "waviness", "surface.amplitude": "50 nm", "surface.wavelength_x": "40 um"}


THIN = LAYER | {"coating.thickness": "2 um", "contact.load": "30 N"}
ROLLS = {"motion.speed": None, "body_1.speed": 1.0}
GROUND = {"surface.kind": "self-affine", "surface.rms": 1e-7, "surface.angle": 30,
          "surface.shortest_wavelength": 2e-5, "surface.longest_wavelength": 2e-4}  # fmt: skip
LINE = BOTH | {"contact.kind": "line", "contact.load_per_length": 1e5}
COATED = {"contact.deformation": "coated", "coating.thickness": 1e-5, "coating.modulus": 4e9,
          "body_1.material": "steel"}  # fmt: skip
MOVES = {"motion.speed": 0.5, "time.end": 6e-4, "grid.nodes": 65}
SHORT = MOVES | {"surface.kind": "waviness", "surface.amplitude": 4e-8, "surface.wavelength_x": 8e-5,
                 "motion.slide_to_roll": 0.5, "surface.body": "body_1"}  # fmt: skip
WHEEL = {"body_1.radius_x": "10 mm", "body_1.radius_y": "20 mm", "body_1.rotation": "100 rpm",
         "body_2.speed": 0.05, "contact.load": 20.0, "motion.angle": 90.0,
         "motion.speed": None}  # fmt: skip
USUAL = "lubricant.conductivity is not given: flash temperatures take 0.14 W/(m K), as is usual"


@pytest.mark.parametrize(
    "words, settings, is_odd",
    [("presses a layer", THIN | {"coating.modulus": "206 GPa"}, False),
     ("presses a layer", THIN | {"coating.modulus": "50 GPa"}, False),
     ("here it stands still", WAVES | SLIDES, True), ("here it stands still", WAVES, False),
     ("here it stands still", WAVES | {"motion.slide_to_roll": 2.0}, False),
     ("here it stands still", WAVES | {"motion.slide_to_roll": 0.0}, True),
     ("here it stands still", WAVES | ROLLS | {"body_2.speed": 1.0}, True),
     ("here it stands still", WAVES | ROLLS | {"body_2.speed": 0.0}, False),
     ("here it stands still", WAVES | SLIDES | {"time.end": "1 ms", "surface.body": "body_1"}, False),
     ("rms slope", WAVES | {"surface.amplitude": "1 um"}, False),
     ("rms slope", WAVES | {"surface.amplitude": "3 um"}, True),
     ("no half-spaces", HIP | {"body_2.diameter": "-28.2 mm"}, True),
     ("no half-spaces", HIP | {"body_2.diameter": "-35 mm"}, False),
     ("no lay", GROUND, True), ("no lay", GROUND | {"surface.aspect": 3.0}, False),
     ("viscosity", {"lubricant.pressure_viscosity": 0.0}, False),
     ("no temperatures", BOTH | SLIDES | {"time.end": "1 ms"}, True),
     ("no temperatures", BOTH | SLIDES, False),
     ("no temperatures", LINE | {"motion.slide_to_roll": 1.99}, False),
     ("slide_to_roll = 2: below a line contact", LINE | {"motion.slide_to_roll": 2.0}, True),
     ("bodies that do not slide", LINE | {"motion.slide_to_roll": 0.0}, True),
     ("a ratio, not in per cent", {"motion.slide_to_roll": 20.0}, True),
     ("a ratio, not in per cent", {"motion.slide_to_roll": -5.0}, True),
     ("a ratio, not in per cent", {"motion.slide_to_roll": 2.0}, False),
     ("substrate_modulus is not given", COATED | {"body_2.material": "aluminium"}, True),
     ("substrate_modulus is not given", COATED | {"body_2.material": "steel"}, False),
     ("substrate_modulus is not given",
      COATED | {"body_2.material": "aluminium", "coating.substrate_modulus": 206e9}, False),
     (USUAL, BOTH | SLIDES, True), (USUAL, BOTH | SLIDES | {"lubricant.conductivity": 0.13}, False),
     (USUAL, SLIDES, False),
     ("cells in a step", SHORT | {"time.step": "10 us"}, False),
     ("cells in a step", SHORT | {"time.step": "100 us"}, True),
     ("of a cell in a step", MOVES | {"time.step": "20 us"}, False),
     ("of a cell in a step", MOVES | {"time.step": "2 us"}, True),
     ("body_1.rotation is a speed", WHEEL, True),
     ("body_1.rotation is a speed", WHEEL | {"motion.angle": 180.0}, False),
     ("body_1.rotation is a speed", WHEEL | {"body_1.rotation_radius": "20 mm"}, False),
     ("body_1.rotation is a speed", WHEEL | {"body_1.radius_y": "10 mm"}, False)],
)  # fmt: skip
def test_what_is_odd_is_named_and_its_like_is_not(words, settings, is_odd):
    given = {key: value for key, value in (BALL | settings).items() if value is not None}
    assert any(words in line for line in odd(given)) == is_odd


def test_a_contact_wider_than_a_body_is_refused():
    with pytest.raises(ConfigError, match=r"wider than a body with a radius of 0.014 m"):
        checked_case(load_config(os.devnull, HIP | {"body_2.diameter": "-28.1 mm"}))


@pytest.mark.parametrize(
    "body, said", [("still", "stands still"), ("moving", "goes at twice"), ("body_1", None)]
)
def test_roughness_that_no_body_carries_is_named_in_time(body, said):
    """A steady run told that time.end would move it."""
    given = BALL | WAVES | {"motion.slide_to_roll": 0.1, "surface.body": body, "time.end": "1 ms"}
    found = [line for line in odd(given) if "body = " in line]
    assert [f'"{body}" {said}' in line for line in found] == [True] * (said is not None)


@pytest.mark.parametrize("layers, is_odd", [(0.0, True), ("2 nm", False)])
def test_a_start_from_rest_wants_layers(tmp_path, layers, is_odd):
    course = tmp_path / "speed.csv"
    course.write_text("0,0\n1,1\n")
    settings = {"motion.speed": str(course), "time.end": 1.0, "contact.boundary_film": layers}
    assert any("part on films" in line for line in odd(settings)) == is_odd


@pytest.mark.parametrize(
    "rows, end, said",
    [("0,1\n4,2\n", "4 ms", "goes on to 4 s, and the run ends at 0.004 s: look at the unit of its times"),
     ("time_ms,speed_m_s\n0,1\n4,2\n", "4 ms", ""), ("0,1\n4,2\n", 1.0, ""),
     ("0,1\n4,4000\n", 4.0, "up to 4000 m/s: machines have 0 to 200")],
)  # fmt: skip
def test_a_table_in_another_unit_is_named(tmp_path, rows, end, said):
    course = tmp_path / "speed.csv"
    course.write_text(rows)
    found = [line for line in odd({"motion.speed": str(course), "time.end": end}) if "motion.speed" in line]
    assert len(found) == bool(said) and all(said in line for line in found)


def test_friction_and_heat_cite_their_formulas():
    heat = {"lubricant.heating": "factor", "lubricant.conductivity": 0.14}
    eyring = {"friction.model": "eyring", "friction.eyring_stress": 5e6, "motion.slide_to_roll": 0.2}
    steel = {f"heat.{key}_{body}": value for body in (1, 2) for key, value in STEEL.items()}
    config = load_config(os.devnull, OIL | heat | eyring | steel)
    added = ["gupta1992", "eyring1936", "ehret1998", "carslaw1959"]
    assert {*added} <= {*cited(config, contact_from(config))} <= {*SOURCES}
    plain = load_config(os.devnull, OIL)
    assert not {*added} & {*cited(plain, contact_from(plain))}


def test_a_load_that_changes_is_told_by_its_ends(tmp_path):
    (tmp_path / "load.csv").write_text("t [s], load [N]\n0, 50\n0.001, 100\n")
    load = {"contact.load": str(tmp_path / "load.csv"), "time.end": 1e-3, "grid.nodes": 65}
    config = load_config(os.devnull, BALL | load)
    contact = contact_from(config)
    mesh = mesh_from(config, contact)
    told = config.kind.heading(SimpleNamespace(config=config, contact=contact, mesh=mesh))
    lines = "\n".join(config.kind.lines(config, contact, mesh))
    assert re.search("GPa, of the first load$", lines, re.M)
    assert re.search("^films, .*, of the first load$", lines, re.M)
    assert "1 m/s, 50 N to 100 N, 65" in told.replace("\u00a0", " ")


@pytest.mark.parametrize("last, is_odd", [(2.0, True), (362.0, False)])
def test_a_direction_that_turns_back_after_360_is_named(tmp_path, last, is_odd):
    (tmp_path / "angle.csv").write_text(f"0,350\n0.5,358\n1,{last}\n")
    said = odd([f"motion.angle={tmp_path / 'angle.csv'}", "time.end=1"])
    assert any("from one value to the next" in words for words in said) is is_odd


@pytest.mark.parametrize("speed, said", [(1.0, "would leave"), (200.0, "does not hold: it would leave")])
def test_a_factor_that_would_be_refused_is_said_not_to_hold(speed, said):
    heat = {"lubricant.conductivity": 0.14, "motion.speed": speed}
    (line,) = factor_words(contact_from(load_config(settings=OIL | heat)))
    assert f'lubricant.heating = "factor" {said}' in line


@pytest.mark.parametrize("sign, names", [(1.0, []), (-1.0, ["lubricant.density_law falls from 0 GPa on"])])
def test_an_own_law_that_falls_with_pressure_is_named(tmp_path, sign, names):
    law = tmp_path / "mine.py"
    law.write_text(f"def density(at): return 1.0 + {sign} * 1e-10 * at.pressure, {sign} * 1e-10\n")
    found = odd(BALL | {"lubricant.density_law": f"{law}:density"})
    assert [words.partition(":")[0] for words in found] == names


@pytest.mark.parametrize("goes_on", [False, True])
def test_surfaces_that_stand_still_squeeze_the_film_of_another_run(goes_on):
    config = load_config(os.devnull, {"motion.speed": 0.0, "time.end": 1e-3, "grid.nodes": 65})
    said = implausible(config, contact_from(config), goes_on)
    assert any("without --start-from RUN" in words for words in said) is not goes_on
