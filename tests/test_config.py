import os
import shlex
import tomllib

import numpy as np
import pytest
import tomli_w
from places import CONFIGS
from processes import MGEHL, ended
from told import refusal

from mgehl.config import Config, ConfigError, config_from_tables, load_config
from mgehl.config_file import default_config


def with_settings(*settings):
    """All defaults but for the settings: an empty file, since every unit in a file takes its time."""
    return load_config(os.devnull, settings)


def error_of(*settings, tables=None):
    """The message of the ConfigError that settings (or nested values) raise: always one line."""
    call, what = (with_settings, settings) if tables is None else (config_from_tables, [tables])
    return refusal(call, *what, error=ConfigError)


def test_default_configuration_is_the_point_contact():
    assert default_config() == CONFIGS / "point_contact.toml"
    config = load_config()
    assert config == load_config(default_config()) and config.contact.load == 800.0
    assert (config.grid.nodes, config.grid.x, config.grid.y) == (257, (-1.9, 1.3), (-1.5, 1.5))


@pytest.mark.parametrize(
    "setting, value",
    [("motion.speed=7.5 mm/s", 7.5e-3), ("motion.speed='27 km/hour'", 7.5), ("motion.speed=0.25", 0.25),
     ("motion.speed=2", 2.0), ("contact.load='0.8 kN'", 800.0), ("contact.radius_x=0.5 inch", 12.7e-3),
     ("contact.reduced_modulus=219.78 GPa", 219.78e9), ("lubricant.viscosity=96 mPa*s", 0.096),
     ("motion.speed=1e-6 mm s-1", 1e-9), ("contact.radius_x=9\u03bcm", 9e-6),
     ("lubricant.viscosity=96 mPa·s", 0.096), ("lubricant.viscosity=96 mPas", 0.096),
     ("lubricant.viscosity=96 mPa.s", 0.096), ("lubricant.viscosity=0.096 Ns/m²", 0.096),
     ("lubricant.pressure_viscosity=1.82e-8 m2/N", 18.2e-9), ("motion.speed=2e3 mm/s", 2.0),
     ("motion.speed=100 fpm", 0.508), ("contact.reduced_modulus=220 kN/mm2", 220e9),
     ("lubricant.pressure_viscosity=18.2/GPa", 18.2e-9),
     ("lubricant.pressure_viscosity=18.2 GPa⁻¹", 18.2e-9), ("lubricant.conductivity=0.14 W/(m K)", 0.14),
     ("lubricant.conductivity=0.14 W/m/degC", 0.14),
     ("lubricant.conductivity=0.14 W/(m·K)", 0.14), ("lubricant.conductivity=0.14 W/mK", 0.14),
     ("lubricant.conductivity=0.14 W/m K", 0.14), ("contact.reduced_modulus=226e3 N/mm²", 226e9),
     ("discretization.film_threshold=0.2 angstrom", 0.02e-9), ("discretization.film_threshold=0", 0.0),
     ("solver.tolerance=1e-6", 1e-6)],
)  # fmt: skip
def test_units_end_as_SI_floats(setting, value):
    section, key = setting.split("=")[0].split(".")
    found = getattr(getattr(with_settings(setting), section), key)
    assert isinstance(found, float)
    assert found == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    "setting, value",
    [("grid.nodes=513", 513), (" grid.nodes = 129 ", 129), ("grid.nodes=129.0", 129),
     ("grid.x=[-4.5, 1.5]", (-4.5, 1.5)), ("grid.y=[-3, 3]", (-3.0, 3.0)), ("grid.x=auto", "auto"),
     ("grid.x=Auto", "auto"),
     ("discretization.couette=S2C", "S2C"), ('discretization.couette="2B"', "2B"),
     ("lubricant.viscosity_law=roelands", "roelands"), ("lubricant.density_law=constant", "constant"),
     ("solver.error=false", False), ("lubricant.viscosity_law=Roelands", "roelands"),
     ("solver.omega=.9", 0.9), ("contact.load=5.", 5.0)],
)  # fmt: skip
def test_settings_are_toml_or_numbers_or_else_plain_strings(setting, value):
    section, key = setting.split("=")[0].strip().split(".")
    found = getattr(getattr(with_settings(setting), section), key)
    assert found == value and type(found) is type(value)


# setting; words that must appear: the key, the value, what is allowed
MISTAKES = [
    ("contact.load=0", "contact.load = 0: ", "a number in N", "at least 1e-06"),
    ("motion.speed=nan", "motion.speed = nan: ", "a number in m/s"),
    ("motion.speed=7.5 mm", "motion.speed = '7.5 mm': ", "wrong unit", '"1 m/s"'),
    ("motion.speed='7.5'", "motion.speed = '7.5': ", "has no unit", '"1 m/s"'),
    ("motion.speed=fast", "motion.speed = 'fast': ", "not understood", '"1 m/s"'),
    ("contact.radius_x=cam.csv", "contact.radius_x = 'cam.csv': ", "follows no table: only speed"),
    ("contact.load=10 lb", "contact.load = '10 lb': ", "is a mass, its weight is in kgf or lbf"),
    ("motion.angle='5'", "motion.angle = '5': has no unit", '"1 deg"'),
    ("motion.angle=5 alpha", "motion.angle = '5 alpha': of what, turns or radians?"),
    ("contact.load=9**9**9 N", "contact.load = '9**9**9 N': ", "not understood"),
    ("contact.load=800 N # x", "contact.load = '800 N # x': ", "not understood"),
    ("grid.nodes=64.5", "grid.nodes = 64.5: ", "a whole number", "at least 65", "at most 16385"),
    ("grid.nodes=32769", "grid.nodes = 32769: ", "at most 16385"),
    ("grid.nodes=100", "grid.nodes = 100: ", "2^k + 1", "65 or 129"),
    ("grid.x=[-1.9]", "grid.x = [-1.9]: ", "two numbers", "first < -1", "last > 1"),
    ('grid.y=["a", 2]', "grid.y = ['a', 2]: ", "two numbers"),
    ("contact.kind=roller", "contact.kind = 'roller': ", "must be one of point, line, wedge"),
    ('wedge.blocked_exit="true"', "wedge.blocked_exit = 'true': ", "true or false"),
    ("relaxation.omega=0", "relaxation.omega = 0: ", "above 0", "at most 1"),
    ("relaxation.load=1", "relaxation.load = 1: ", "unknown key", "did you mean contact.load?"),
    ("discretization.couette=4B", "discretization.couette = '4B': ", "1B, 2B, 2C, 3B, 3L, S1B, S2C"),
    ("gird.nodes=129", "gird = {'nodes': 129}: ", "unknown section", "did you mean grid?"),
    ("qqqq.w=1", "qqqq = {'w': 1}: ", "unknown section",
     "known are contact, coating, wedge, lubricant, motion"),
    ("grid.nodes", "--set grid.nodes: ", "must be section.key=value"),
]  # fmt: skip


@pytest.mark.parametrize("setting, start, words", [(m[0], m[1], m[2:]) for m in MISTAKES])
def test_mistake_is_one_line_with_key_value_and_what_is_allowed(setting, start, words):
    message = error_of(setting)
    assert message.startswith(start)
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    "setting, start",
    [("grid.nodes=" + 5000 * "1", "grid.nodes = '11"), ("grid.x=" + 5000 * "[", "grid.x = '[["),
     ("grid.nodes=0x" + 5000 * "f", "grid.nodes = <int too long to show>: "),
     ("motion.speed=" + 5000 * "1 ", "motion.speed = '1 1")],
    ids=["digits", "nest", "hexadecimal", "text"],
)  # fmt: skip
def test_what_is_too_long_is_refused_and_cut_short(setting, start):
    """More digits than Python reads, or shows; brackets deeper than it recurses."""
    message = error_of(setting)
    assert message.startswith(start) and len(message) < 300


FILES = {
    "that is not there": (None, "cannot be read: No such file"),
    "of too many digits": (b"x = " + 5000 * b"1", "not valid TOML: "),
    "of too deep a nest": (b"x = " + 5000 * b"[", "not valid TOML: "),
    "of half a heading": (b"[grid\nnodes = 5", "not valid TOML: "),
    "of words": (b"nodes 5", "not valid TOML: "),
    "of bytes": (b"\xff\xfe", "cannot be read: is no text in UTF-8 (byte 1)"),
    "without a section": (b"load = 5\n", "load = 5: must stand in a section, such as [contact]"),
}


@pytest.mark.parametrize("content, words", FILES.values(), ids=FILES)
def test_a_file(tmp_path, content, words):
    path = tmp_path / "my.toml"
    if content is not None:
        path.write_bytes(content)
    said = refusal(load_config, path, error=ConfigError).removeprefix(f"{path}: ")
    assert said.startswith(words)


MOES = {"moes": {"M": 200, "L": 10}}
COATED = ("contact.deformation=coated", "coating.thickness=10 um", "coating.modulus=400 GPa")


@pytest.mark.parametrize(
    "settings, message",
    [(("moes.M=20",), "moes.L: must be given with moes.M"),
     (("moes.L=10",), "moes.M: must be given with moes.L"),
     (COATED[:2], 'coating.modulus: must be given where contact.deformation = "coated"'),
     (COATED[::2], 'coating.thickness: must be given where contact.deformation = "coated"'),
     (("contact.deformation=half-space", "coating.poisson=0.2"),
      'coating.poisson = 0.2: means nothing where contact.deformation = "half-space"'),
     ((*COATED, "coating.substrate_modulus=50 GPa"), "coating.substrate_modulus = 50000000000.0: both "
      "bodies without the coating have a reduced modulus of "),
     (("lubricant.viscosity_law=roelands", "lubricant.viscosity=6e-5"),
      "lubricant.viscosity = 6e-05: Roelands' law needs a viscosity above 6.3e-5 Pa s"),
     (("contact.kind=wedge", "wedge.inlet=20 mm"), "wedge.inlet = 0.02: must be above wedge.exit = ")],
)  # fmt: skip
def test_what_is_missing_or_does_not_fit_is_named(settings, message):
    assert error_of(*settings).startswith(message)


@pytest.mark.parametrize(
    "tables, message",
    [(MOES | {"contact": {"load": 800.0}}, "contact.load = 800.0: means nothing with moes.M"),
     (MOES | {"motion": {"speed": 1.0}}, "motion.speed = 1.0: means nothing with moes.M"),
     ({"grid": 5}, "grid = 5: is a section, its keys go under [grid]"),
     ({"contact": {"kind": [1]}}, "contact.kind = [1]: must be one of point, line, wedge")],
)  # fmt: skip
def test_what_a_file_says_twice_or_in_another_form(tables, message):
    assert error_of(tables=tables) == message


def test_a_deformation_that_is_set_pushes_out_the_coating_of_the_file():
    config = load_config(CONFIGS / "coated.toml", ["contact.deformation=half-space"])
    assert config.coating == Config().coating != load_config(CONFIGS / "coated.toml").coating


FOREIGN_KEYS = [
    ("point", "contact.load_per_length=5e5"), ("point", "wedge.slope=1e-3"),
    ("line", "contact.load=800"), ("line", "grid.y=auto"), ("line", "moes.M=20"),
    ("line", "motion.angle=0"),
    ("line", "contact.deformation=half-space"), ("line", "coating.poisson=0.3"),
    ("wedge", "contact.reduced_modulus=2e11"),
    ("wedge", "grid.x=auto"), ("wedge", "discretization.film_threshold=0"), ("wedge", "solver.start=film"),
    ("wedge", "relaxation.omega=0.1"), ("wedge", "surface.kind=dent"),
    ("wedge", "lubricant.heating=factor"), ("wedge", "contact.ambient_pressure=1e5"),
]  # fmt: skip


@pytest.mark.parametrize("kind, setting", FOREIGN_KEYS)
def test_key_that_means_nothing_to_the_kind_of_contact(kind, setting):
    """Even with the value it has by default: whoever gives it expects it to matter."""
    message = error_of(f"contact.kind={kind}", setting)
    assert message.startswith(f"{setting.partition('=')[0]} = ")
    assert message.endswith(f': means nothing where contact.kind = "{kind}"')


KINDS = {
    "defaults": {},
    "moes": MOES,
    "point": {"discretization": {"contact_model": "unified", "unified_gap": "1 nm", "cavitation": False}},
    "relaxed point": {
        "solver": {"method": "relaxation"},
        "relaxation": {"omega": 0.1, "contact_update": "point", "stability": 10, "max_sweeps": 100},
    },
    "coated point": {
        "contact": {"deformation": "coated"},
        "coating": {"thickness": "10 um", "modulus": "4 GPa", "substrate_modulus": "200 GPa"},
    },
    "point of one's own": {
        "contact": {"deformation": "/there/mine.py:layers", "surface": "/there/mine.py:waves"},
        "lubricant": {"viscosity_law": "/there/mine.py:eta", "density_law": "/there/mine.py:rho"},
    },
    "line": {
        "contact": {"kind": "line", "load_per_length": "1859 N/mm", "surface": "/there/mine.py:waves"},
        "grid": {"x": [-2.5, 1.5]},
        "discretization": {"couette": "2B"},
    },
    "wedge": {
        "contact": {"kind": "wedge"},
        "wedge": {"exit": "4 mm", "inlet": "8 mm", "blocked_exit": True, "reversed": True},
        "discretization": {"couette": "2C", "cavitation": False, "couette_at_interface": "untreated"},
    },
    "wedge with a pocket": {
        "contact": {"kind": "wedge"},
        "wedge": {
            "length": "20 mm", "inlet_film": "1.1 um", "exit_film": "1 um", "sides": "closed",
            "ambient_pressure": "0.1 MPa", "pressure_laws": True,
            "pocket_depth": "0.4 um", "pocket_from": "4 mm", "pocket_to": "10 mm", "pocket_width": "7 mm",
        },
        "lubricant": {"viscosity_law": "roelands", "density_law": "/there/mine.py:rho"},
    },
}  # fmt: skip


@pytest.mark.parametrize("tables", KINDS.values(), ids=KINDS)
def test_every_kind_round_trips(tables):
    """What is written names no key that the kind would refuse when it is read."""
    config = config_from_tables(tables)
    written = config.as_toml_tables()
    again = config_from_tables(tomllib.loads(tomli_w.dumps(written)))
    assert again == config
    assert again.as_toml_tables() == written


BY_FILMS = ("wedge.length=20 mm", "wedge.inlet_film=1.1 um", "wedge.exit_film=1 um")
POCKET = ("wedge.pocket_depth=0.4 um", "wedge.pocket_from=4 mm", "wedge.pocket_to=10 mm")


@pytest.mark.parametrize(
    "settings, message",
    [
        (BY_FILMS[:1], "wedge.inlet_film: must be given with wedge.length"),
        (BY_FILMS[1:], "wedge.length: must be given with wedge.inlet_film"),
        (("wedge.length=0.1 mm", "wedge.inlet_film=1 mm", BY_FILMS[2]), "wedge.length = 0.0001: the slope"),
        (("wedge.inlet_film=0",), "wedge.inlet_film = 0: must be a number in m"),
        (POCKET[:1], "wedge.pocket_from: must be given beside wedge.pocket_depth"),
        (POCKET[:2], "wedge.pocket_to: must be given beside wedge.pocket_depth"),
        (POCKET[1:2], "wedge.pocket_from = '4 mm': means nothing without wedge.pocket_depth"),
        (POCKET, "wedge.pocket_from = 0.004, wedge.pocket_to = 0.01: the first must lie before the second, "
         "both on the pad from 0.02 to 0.05"),
        ((*BY_FILMS, *POCKET, "wedge.pocket_to=21 mm"), "wedge.pocket_from = 0.004, wedge.pocket_to = "
         "0.021: the first must lie before the second, both on the pad from 0 to 0.02"),
        ((*BY_FILMS, *POCKET, "wedge.pocket_to=4 mm"), "wedge.pocket_from = 0.004, wedge.pocket_to = "),
        ((*BY_FILMS, *POCKET, "wedge.pocket_width=30 mm"), "wedge.pocket_width = 0.03: must be at most the "
         "pad's wedge.width = 0.02"),
        (("wedge.pocket_depth=-1 um",), "wedge.pocket_depth = '-1 um': must be a number in m"),
        (("wedge.sides=walls",), "wedge.sides = 'walls': must be one of open, closed"),
        (("wedge.ambient_pressure=-1",), "wedge.ambient_pressure = -1: must be a number in Pa"),
        (("lubricant.viscosity_law=barus",), "lubricant.viscosity_law = 'barus': means nothing without "
         "wedge.pressure_laws = true"),
        (("wedge.pressure_laws=true", "lubricant.viscosity=1e-6", "lubricant.viscosity_law=roelands"),
         "lubricant.viscosity = 1e-06: Roelands' law needs"),
    ],
)  # fmt: skip
def test_a_pad_that_makes_no_sense(settings, message):
    assert error_of("contact.kind=wedge", *settings).startswith(message)


@pytest.mark.parametrize("key", ["exit", "inlet", "slope", "reversed"])
def test_a_pad_is_described_in_one_way(key):
    """In a file; a setting takes the place of what the file says."""
    value = True if key == "reversed" else 1e-3
    wedge = {"length": 20e-3, "inlet_film": 1e-6, "exit_film": 1e-6}
    message = error_of(tables={"contact": {"kind": "wedge"}, "wedge": wedge | {key: value}})
    assert message == f"wedge.{key} = {value!r}: means nothing with wedge.length"
    config = load_config(CONFIGS / "wedge_open.toml", BY_FILMS)
    assert config.wedge.by_films and "slope" not in config.as_toml_tables()["wedge"]


@pytest.mark.parametrize("kind", ["line", "Wedge"])
def test_a_kind_that_is_set_pushes_out_what_the_file_says_of_another(kind):
    """The default file is a point contact's."""
    config = load_config(settings=[f"contact.kind={kind}", "grid.nodes=65"])
    assert config.contact.kind == kind.lower()
    assert config.contact.load == Config().contact.load


@pytest.mark.parametrize(
    ("setting", "value"),
    [
        ("body_1.material=100Cr6", "steel"),
        ("body_1.material=si3n4", "silicon nitride"),
        ("body_1.material=52100", "steel"),
        ("body_1.material=cast-iron", "cast iron"),
        ("lubricant.oil=PAO 100", "PAO100"),
        ("lubricant.viscosity_law=Constant", "constant"),
    ],
)
def test_a_choice_may_be_written_as_people_write_it(setting, value):
    key = setting.partition("=")[0]
    beside = [f"body_{i}.material=steel" for i in (1, 2)] if "material" in key else []
    beside += ["lubricant.temperature=60 degC"] if "oil" in key else []
    assert with_settings(*beside, setting).value(key) == value


class TestPipes:
    """What a shell makes of <(...) is a configuration; a pipe into which nobody writes is none."""

    def check(self, tmp_path, command):
        return ended(["bash", "-c", f"exec {shlex.join(MGEHL)} check <({command})"], cwd=tmp_path)

    def test_what_comes_out_of_one(self, tmp_path):
        done = self.check(tmp_path, "sleep 0.5; printf '[grid]\\nnodes = 129'")
        assert (done.returncode, done.stderr) == (0, "") and "129" in done.stdout

    @pytest.mark.parametrize("writes", ["", "[grid]"])
    def test_one_that_nobody_ends(self, tmp_path, monkeypatch, writes):
        monkeypatch.setattr("mgehl.config_file.PATIENCE", 0.05)
        os.mkfifo(tmp_path / "pipe.toml")
        held = os.open(tmp_path / "pipe.toml", os.O_RDWR) if writes else None
        if writes:
            os.write(held, writes.encode())
        said = refusal(load_config, tmp_path / "pipe.toml", error=ConfigError)
        assert "pipe.toml: cannot be read: is a pipe into which nobody writes" in said

    def test_one_without_end(self, tmp_path):
        done = self.check(tmp_path, "exec cat /dev/zero")
        assert done.returncode == 2 and "has more than" in done.stderr


def test_a_file_may_begin_with_the_mark_of_windows_editors(tmp_path):
    (tmp_path / "my.toml").write_bytes(b"\xef\xbb\xbf[grid]\nnodes = 129\n")
    assert load_config(tmp_path / "my.toml").grid.nodes == 129


def test_numbers_of_numpy_are_numbers():
    numbers = {
        "grid.nodes": np.int64(129),
        "motion.speed": np.float32(0.5),
        "solver.error": np.bool_(False),
    }
    config = load_config(None, numbers)
    assert config.solver.error is False
    assert (config.grid.nodes, type(config.grid.nodes), config.motion.speed) == (129, int, 0.5)
    assert load_config(None, {"solver.error": np.bool_(False)}).solver.error is False
