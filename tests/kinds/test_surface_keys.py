import numpy as np
import pytest
from told import refusal

from mgehl.config import config_from_tables, load_config
from mgehl.errors import ConfigError
from mgehl.kinds import check_contact, contact_from

WAVES = {"kind": "waviness", "amplitude": "50 nm", "wavelength_x": "60 um"}
ROUGH = {
    "kind": "self-affine", "rms": "0.1 um", "shortest_wavelength": "20 um", "longest_wavelength": "200 um",
}  # fmt: skip
DENT = {"kind": "dent", "amplitude": "1 um", "width": "100 um", "x": "-50 um"}
RIDGE = {"kind": "ridge", "amplitude": "1 um", "width": "100 um"}
SPEED = {"motion": {"speed": 1.0}}


def config_of(**sections):
    return config_from_tables(SPEED | sections)


def checked(**sections):
    config = config_of(**sections)
    check_contact(config, contact_from(config))


def test_a_peak_lowers_the_gap():
    """By its height, of whichever source: the paper's -delta  [Liu eq. 48]."""
    smooth, ridged = contact_from(config_of()), contact_from(config_of(surface=RIDGE))
    lower = smooth.undeformed_gap(0.0, 0.0) - ridged.undeformed_gap(0.0, 0.0)
    assert lower * ridged.film_scale == pytest.approx(1e-6)


def test_surfaces_add_up(tmp_path):
    (tmp_path / "mine.py").write_text("def up(x, y): return 3e-6 + 0 * x * y")
    both = config_of(surface=RIDGE, second_surface=WAVES, contact={"surface": f"{tmp_path}/mine.py:up"})
    assert contact_from(both).surface.height(0.0, 0.0) == pytest.approx(1e-6 + 50e-9 + 3e-6)


def test_waves_may_be_along_y_alone():
    waves = {"kind": "waviness", "amplitude": 5e-8, "wavelength_y": 6e-5}
    assert contact_from(config_of(surface=waves)).surface.height(1e-5, 3e-5) == pytest.approx(-5e-8)


REFUSED = {
    "no source": ({"hurst": 0.5}, "surface.hurst = 0.5: means nothing without surface.kind or"),
    "two sources": (DENT | {"file": "z.npy"}, "surface.kind = 'dent': means nothing with surface.file"),
    "another's key": (WAVES | {"hurst": 0.5}, "surface.hurst = 0.5: means nothing with surface.kind = "),
    "a key of files": (DENT | {"remove": "tilt"}, "surface.remove = 'tilt': means nothing with"),
    "what it needs": ({"kind": "dent", "width": 1e-4}, "surface.amplitude: must be given with"),
    "no wavelength": ({"kind": "waviness", "amplitude": 1e-8}, "surface.wavelength_x: it or"),
    "cut-offs": (ROUGH | {"longest_wavelength": "20 um"}, "surface.shortest_wavelength = 2e-05: must be b"),
    "too many waves": (
        ROUGH | {"longest_wavelength": "6 mm"}, "surface.shortest_wavelength = 2e-05: must be at least",
    ),
    "a moving body": (WAVES | {"body": "moving"}, 'surface.body = "moving": its heights change along'),
    "a moving dent": (DENT | {"body": "moving"}, 'surface.body = "moving": its heights change'),
    "too high": (RIDGE | {"amplitude": "1.3 mm"}, "surface.kind = 'ridge': its height is 0.0013 m at x"),
    "no length": (WAVES | {"amplitude": "50 s"}, "surface.amplitude = '50 s': wrong unit"),
    "an unknown kind": ({"kind": "rough"}, "surface.kind = 'rough': must be one of waviness, self-affine"),
}  # fmt: skip


@pytest.mark.parametrize("table, start", REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_used_is_one_line(table, start):
    assert refusal(checked, surface=table, error=ConfigError).startswith(start)


OF_A_PLANE = {
    "waves along y": (WAVES | {"wavelength_y": 3e-5}, "surface.wavelength_y = 3e-05: means nothing with"),
    "turned waves": (WAVES | {"angle": 90.0}, "surface.angle = 90.0: means nothing with surface.kind = "),
    "a dent beside": (DENT | {"y": 1e-3}, "surface.y = 0.001: means nothing with surface.kind = "),
    "a turned ridge": (RIDGE | {"angle": 90.0}, "surface.angle = 90.0: means nothing with surface.kind"),
    "no wavelength": ({"kind": "waviness", "amplitude": 1e-8}, "surface.wavelength_x: must be given"),
}


@pytest.mark.parametrize("table, start", OF_A_PLANE.values(), ids=OF_A_PLANE)
def test_a_line_contact_has_no_heights_that_vary_along_y(table, start):
    """They would be those at y = 0. Self-affine ones at another angle or y are another profile."""
    assert start in refusal(checked, contact={"kind": "line"}, surface=table)
    checked(contact={"kind": "line"}, surface=ROUGH | {"angle": 30.0, "aspect": 2.0})


@pytest.mark.parametrize("angle", [0.0, 90.0])
def test_ridges_along_the_motion_may_move(angle):
    ridges = {"kind": "ridge", "amplitude": 1e-7, "width": 1e-4, "angle": angle + 90.0, "body": "moving"}
    config = config_of(second_surface=ridges, motion={"speed": 1.0, "angle": angle})
    assert not contact_from(config).surface.varies_along(contact_from(config).motion)


def test_a_profile_is_of_a_line_contact(tmp_path):
    """It has the heights of a file over a rectangle whose rows are alike, and is called long alone."""
    x = np.arange(-1000, 1001, 20)
    profile, rows = tmp_path / "z.csv", tmp_path / "z.npy"
    heights = np.round(10.0 * np.cos(x / 30.0), 6)
    profile.write_text("\n".join(f"{a},{b}" for a, b in zip(x, heights, strict=True)))
    np.save(rows, np.tile(heights, (4, 1)))
    common = {"height_unit": "nm"}
    one = common | {"file": str(profile), "position_unit": "um"}
    other = common | {"file": str(rows), "spacing": "20 um"}
    checked(contact={"kind": "line"}, surface=one)
    surfaces = (
        contact_from(config_of(contact={"kind": "line"}, surface=each)).surface for each in (one, other)
    )
    at = np.linspace(-1e-4, 1e-4, 51)
    np.testing.assert_allclose(*(surface.height(at, 0.0) for surface in surfaces), rtol=0, atol=1e-20)
    assert "a profile along a line, which contact.kind" in refusal(checked, surface=one)
    short = one | {"x": "950 um"}
    said = refusal(checked, contact={"kind": "line"}, surface=short)
    assert "is 2000 um long and ends inside the contact, such as at x = " in said and "y =" not in said


class TestFile:
    @pytest.fixture
    def file(self, tmp_path):
        np.save(tmp_path / "z.npy", np.zeros((65, 65)))
        return {"file": str(tmp_path / "z.npy"), "height_unit": "nm", "spacing": "20 um"}

    def test_by_its_keys(self, file):
        place = {"x": "1 um", "y": "2 um", "angle": 90}
        surface = contact_from(config_of(surface=file | place | {"spacing_y": "30 um"})).surface
        assert (surface.x, surface.y, surface.angle) == pytest.approx((1e-6, 2e-6, 90.0))
        assert (surface.preparation.dx, surface.preparation.dy) == pytest.approx((20e-6, 30e-6))
        assert surface.preparation.height_unit == 1e-9

    def test_a_file_smaller_than_the_contact_needs_a_continuation(self, file):
        small = file | {"spacing": "10 um"}
        message = refusal(checked, surface=small)
        assert message.startswith(f"surface.file = {file['file']!r}: is 640 um by 640 um and ends inside")
        checked(surface=small | {"continuation": "mirror"})

    def test_heights_a_ball_cannot_have(self, file):
        """Seen at the file's points, wherever nodes are; what all have in common is no matter."""
        heights = np.full((65, 65), 70.0)
        heights[1, 2] = 68.0
        np.save(file["file"], heights)
        message = refusal(checked, surface=file | {"height_unit": "mm"})
        start = f"surface.file = {file['file']!r}: row 2, column 3 is -2000 um off the median"
        assert message.startswith(start)
        assert "must be at most 1270, a tenth of the radius; is it a missing value?" in message
        checked(surface=file | {"height_unit": "um"})

    def test_its_path_counts_from_the_configuration(self, file, tmp_path):
        (tmp_path / "mine.toml").write_text('[surface]\nfile = "z.npy"\n')
        assert load_config(tmp_path / "mine.toml").surface.file == file["file"]


class TestSettings:
    @pytest.fixture
    def path(self, tmp_path):
        (tmp_path / "mine.toml").write_text('[surface]\nkind = "dent"\namplitude = 1e-6\nwidth = 1e-4\n')
        return tmp_path / "mine.toml"

    def test_a_file_pushes_the_kind_out(self, path):
        config = load_config(path, {"surface.file": "z.npy"})
        assert config.surface.kind is None and config.surface.file.endswith("/z.npy")

    @pytest.mark.parametrize("table", [WAVES, ROUGH, DENT, RIDGE, {"file": "/z.npy"}])
    def test_what_is_written_can_be_read(self, table):
        written = config_of(surface=table, second_surface=RIDGE).as_toml_tables()
        assert config_from_tables(written) == config_of(surface=table, second_surface=RIDGE)
        assert "surface" not in config_of().as_toml_tables()
