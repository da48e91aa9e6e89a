import numpy as np
import pytest

from mgehl.config import load_config
from mgehl.errors import ConfigError
from mgehl.kinds.time import course

ROWS = "0;100\n1000;300\n"


def read(tmp_path, heading, key="motion.speed", rows=ROWS):
    (tmp_path / "course.csv").write_text(f"{heading}\n{rows}")
    return course(key, str(tmp_path / "course.csv"))


@pytest.mark.parametrize(
    "heading, end, value",
    [("t;v", 1000.0, 300.0), ("s;m/s", 1000.0, 300.0), ("t [ms];v [mm/s]", 1.0, 0.3),
     ("t / ms;v / mm/s", 1.0, 0.3), ("t/ms;v/(mm/s)", 1.0, 0.3), ("ms;mm/s", 1.0, 0.3),
     ("time ms;speed km/h", 1.0, 300.0 / 3.6), ("# t (ms); speed", 1.0, 300.0),
     ("time_s;speed_mm_s", 1000.0, 0.3), ("t.ms;v mm s-1", 1.0, 0.3), ("t-ms;v {mm/s}", 1.0, 0.3),
     ("t;c", 1000.0, 300.0), ("t;speed_mean", 1000.0, 300.0)],
)  # fmt: skip
def test_a_heading_tells_units(tmp_path, heading, end, value):
    found = read(tmp_path, heading)
    assert found.kinks() == pytest.approx((0.0, end))
    assert found.value(end) == pytest.approx(value)


def test_each_key_has_its_unit(tmp_path):
    assert read(tmp_path, "t (ms), v", rows="0 100\n1000 300\n").kinks() == pytest.approx((0.0, 1.0))
    assert read(tmp_path, "t;F [kN]", "contact.load").value(0.0) == 1e5
    assert read(tmp_path, "t;F [N/mm]", "contact.load_per_length").value(0.0) == 1e5
    assert read(tmp_path, "t;angle [rad]", "motion.angle").value(0.0) == pytest.approx(18000.0 / np.pi)


def test_a_table_of_several_columns_has_one_in_the_unit_of_the_key_or_of_its_name(tmp_path):
    rows = "0;100;2;\n1000;300;4;7\n"
    assert read(tmp_path, "t [s];v [mm/s];F [N];T", "contact.load", rows).value(1000.0) == 4.0
    assert read(tmp_path, "t;load;speed;rpm", rows=rows).value(0.0) == 2.0
    for heading in ("t;v;F;T", "t;v [m/s];u [m/s];T [K]", "t;a [N];b [N];c [N]"):
        with pytest.raises(ConfigError, match="which of its columns .* must be one in m/s, or one whose"):
            read(tmp_path, heading, rows=rows)


@pytest.mark.parametrize("heading", ["t;alpha", "t;pi", "t;count", "t;angle"])
def test_a_name_of_an_angle_is_no_unit(tmp_path, heading):
    """Alpha was the fine-structure constant: 90 degrees were 37.6."""
    assert read(tmp_path, heading, "motion.angle").value(0.0) == 100.0


@pytest.mark.parametrize(
    "heading", ["t;v_kN", "t;v [furlong]", "t;v [N]", "t;speed rpm", "t [mm];v", "t;v / x", "t;kN"]
)
def test_a_unit_that_is_none_of_the_column_is_refused(tmp_path, heading):
    with pytest.raises(ConfigError, match="its heading '.*' tells (no|the) unit .*; must be such as"):
        read(tmp_path, heading)


def test_a_direction_that_changes_needs_time_and_an_end(tmp_path):
    """Of a body whose heights move, too: that was an error of mgehl's own."""
    (tmp_path / "angle.csv").write_text("0,0\n1,1e6\n")
    turns = {"motion.angle": str(tmp_path / "angle.csv")}
    waves = {"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_x": 1e-4}
    for more in ({}, waves | {"surface.body": "body_1"}):
        with pytest.raises(ConfigError, match="changes with time, and time.end is not given"):
            load_config(settings=turns | more)
    with pytest.raises(ConfigError, match="turns to 1e.06; must stay within 36000"):
        load_config(settings=turns | {"time.end": 1.0})
