import re

import pytest
from places import CONFIGS

from mgehl.cli import main


@pytest.fixture
def told(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run(name, *words):
        assert main(["check", str(CONFIGS / name), *words]) == 0
        assert not list(tmp_path.iterdir())
        return capsys.readouterr().out

    return run


def number(text, pattern):
    return float(re.search(pattern, text)[1])


def test_a_point_contact_is_described(told):
    text = told("full_film.toml", "--ranks", "2")
    assert "valid, a point contact" in text
    assert number(text, r"Hertz +a ([\d.]+) mm") == pytest.approx(0.4108, rel=1e-3)
    assert number(text, r"p_h ([\d.]+) GPa") == pytest.approx(2.263, rel=1e-3)
    assert number(text, r"hamrock dowson central ([\d.]+)") == pytest.approx(14.74, rel=1e-3)
    assert "elastic piezoviscous" in text
    assert "on 2 ranks" in text and "timed just now" in text


def test_formulas_are_isothermal_and_heat_is_told_beside_them(told):
    """With heating = "factor" groups and films had the heated viscosity and were called isothermal."""
    oil = "lubricant.conductivity=0.14", "lubricant.thermoviscosity=0.04", "motion.speed=2 m/s"
    words = ["full_film.toml", *(f"--set={each}" for each in oil)]
    text, heated = told(*words), told(*words, "--set=lubricant.heating=factor")
    begin, end = (re.search(rf"^{head} .*$", text, re.M)[0] for head in ("groups", "films, nm"))
    assert begin in heated and end in heated
    left = number(text, r'heat +isothermal films: lubricant.heating = "factor" would leave some (\d+) %')
    assert number(heated, r'"factor" leaves some (\d+) %') == left < 98


def test_keys_that_do_nothing_are_named(told):
    """A dry contact keeps those of a fluid for another day."""
    words = "--set", "discretization.contact_model=dry", "--set", "friction.boundary_coefficient=0.12"
    (line,) = [line for line in told("full_film.toml", *words).splitlines() if line.startswith("not used")]
    assert "friction.boundary_coefficient" in line and "motion.speed" in line
    assert "not used" not in told("full_film.toml")


def test_all_physical_input_is_told_and_what_nobody_gave(told, tmp_path, capsys):
    text = told("full_film.toml")
    assert "viscosity 0.096 Pa*s" in text and "reduced_modulus 2.1978e+11 Pa" in text
    assert "not given" not in text
    (tmp_path / "forgot.toml").write_text('[contact]\nload = "30 N"\n[lubricant]\nviscosity = 0.01\n')
    assert main(["check", str(tmp_path / "forgot.toml")]) == 0
    lines = capsys.readouterr().out.splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("not given"))
    keys = [line[11:].partition(":")[0] for line in lines[first : first + 5]]
    assert keys == [
        "contact.radius_x", "contact.radius_y", "contact.reduced_modulus", "lubricant.pressure_viscosity",
        "motion.speed",
    ]  # fmt: skip
    assert lines[first + 4].endswith("motion.speed: 5e-06 m/s is the paper's")


def test_friction_heat_and_time_are_told_and_from_where_to_where_speed_and_load_go(told, tmp_path_factory):
    folder = tmp_path_factory.mktemp("courses")
    (folder / "load.csv").write_text("0,20\n0.001,40\n")
    (folder / "speed.csv").write_text("0,0\n0.001,0.3\n")
    settings = {
        "motion.speed": folder / "speed.csv", "contact.load": folder / "load.csv", "time.end": "1 ms",
        "friction.model": "eyring", "friction.eyring_stress": "5 MPa", "motion.slide_to_roll": 0.1,
        "heat.conductivity_1": 46, "heat.conductivity_2": 46, "heat.capacity_1": 3.6e6,
        "heat.capacity_2": 3.6e6, "grid.nodes": 65,
    }  # fmt: skip
    text = told("ball_bearing.toml", *(f"--set={key}={value}" for key, value in settings.items()))
    assert "friction   model eyring   eyring_stress 5e+06 Pa" in text
    assert "heat       conductivity_1 46 W/m/K" in text and "time       end 0.001 s" in text
    assert "load       20 to 40 N   speed 0 to 0.3 m/s" in text
    assert "begins from the dry contact: the surfaces are at rest" in text and "a full film" not in text


def test_the_recipe_is_that_of_the_axes_in_which_it_is_solved(told):
    """At more than 45 degrees x and y are exchanged, and with them their cells."""
    film = "solver.start=film", "grid.nodes=129", "motion.speed=0.7 m/s"
    film += ("discretization.face_mobility=linear-gap",)
    along_x = "motion.angle=0", "grid.x=[-2.0, 2.0]", "grid.y=[-3.0, 3.0]"
    along_y = "motion.angle=90", "grid.x=[-3.0, 3.0]", "grid.y=[-2.0, 2.0]"

    def way(*settings):
        lines = told("full_film.toml", *(f"--set={each}" for each in (*film, *settings))).splitlines()
        return [line for line in lines if "begins" in line or line.startswith("grid  ")]

    assert way(*along_y) == way(*along_x) and "from a full film, coarse grids first" in way(*along_y)[-1]


def test_a_bearing_of_a_catalogue_is_told_with_what_follows_from_it(told):
    text = told("bearing_6206.toml")
    assert "material steel   diameter 0.009525 m" in text and "not given" not in text
    assert "contact.radius_x = 0.00377635 m: 1/R = 1/4.7625 + 1/18.2375 1/mm" in text
    assert "lubricant.viscosity = 0.0170926 Pa*s: 20.3 cSt, times 842 kg/m^3" in text
    assert number(text, r"nijenbanning venner moes ([\d.]+)") == pytest.approx(370.8, abs=0.1)
    assert "divided by 1.281, the oil's density at p_h" in text and "Gupta 1992" in text
    assert number(text, r"lambda +([\d.]+)") == pytest.approx(5.91, abs=0.01)
    assert "Hamrock, Dowson 1977" in text and "unusual" not in text


def test_two_ways_in_a_file_are_one_line_with_its_name(tmp_path, refused):
    path = tmp_path / "both.toml"
    path.write_text('[contact]\nreduced_modulus = "226 GPa"\n[body_1]\nmaterial = "steel"\n')
    follows = "contact.reduced_modulus = '226 GPa': follows already with body_1.material: give one of them"
    assert refused("check", str(path)) == f"mgehl: {path}: {follows}"


def test_each_grid_has_its_cells_and_the_grid_that_resolves_is_recommended(told):
    text = told("full_film.toml")
    cells = [float(each) for each in re.findall(r"grid +\d+ +([\d.]+) cells", text)]
    assert len(cells) == 6 and cells[-1] == pytest.approx(2.64, abs=0.01)
    assert "recommended: grid.nodes=2049" in text
    assert "this grid does" in told("full_film.toml", "--set", "grid.nodes=2049")
    assert "no grid up to 16385 does" in told("full_film.toml", "--set", "motion.speed=1e-9")


def test_a_course_of_the_speed_is_resolved_where_its_slowest_motion_is(told, tmp_path_factory):
    """By as many nodes as that speed takes in a steady state."""
    speed = tmp_path_factory.mktemp("courses") / "speed.csv"
    speed.write_text("0,2\n0.001,0.2\n0.002,0.3\n")
    ways = (f"motion.speed={speed}", "time.end=0.002"), ("motion.speed=0.2",)
    grid = "grid.x=[-3, 1.5]", "grid.y=[-2, 2]", "grid.nodes=257"
    course, steady = (told("full_film.toml", *(f"--set={each}" for each in (*way, *grid))) for way in ways)
    for each in (r"grid +257 +([\d.]+) cells", r"from (\d+) nodes on"):
        assert number(course, each) == number(steady, each)
    assert "inlet      at the slowest, 200 mm/s" in course and "slowest" not in steady
