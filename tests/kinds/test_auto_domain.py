import os
from dataclasses import replace

import pytest
from mpi4py import MPI

from mgehl.config import load_config
from mgehl.errors import ConfigError
from mgehl.kinds import check_contact, checked_case, contact_from, mesh_from, with_domain
from mgehl.model.peaks import reach_of_peaks
from mgehl.model.surface.surface import Surface
from mgehl.output.resolution import resolution
from mgehl.run import solve


def loaded(*settings):
    config = load_config(os.devnull, settings)
    return config, contact_from(config)


@pytest.mark.parametrize("angle", [0, 30, 45, 90, 200])
@pytest.mark.parametrize("speed", ["1e-9", "0.01", "20"])
def test_auto_holds_contact_and_inlet(angle, speed):
    settings = [f"motion.angle={angle}", f"motion.speed={speed}", "contact.radius_y=40 mm"]
    check_contact(*loaded(*settings))


def test_a_soft_layer_and_waves_have_a_domain():
    coating = ["contact.deformation=coated", "coating.thickness=40 um", "coating.modulus=4 GPa"]
    config, contact = loaded("contact.load=100", "motion.speed=0.5", *coating)
    check_contact(config, contact)
    assert mesh_from(config, contact).x[1] > contact.reach


def test_a_load_that_grows_has_a_domain_for_its_largest(tmp_path):
    """A domain for the first load ended inside the contact of the last."""
    (tmp_path / "load.csv").write_text("0,1\n1,1000\n")
    grows = ["time.end=1", f"contact.load={tmp_path / 'load.csv'}", "motion.speed=0.5"]
    config, contact = loaded(*grows)
    _, last = loaded("contact.load=1000", "motion.speed=0.5")
    first = with_domain(*loaded("contact.load=1", "motion.speed=0.5")).grid
    grid = with_domain(config, contact).grid
    assert contact.load == 1.0 and first.x[1] < 10.0 < grid.x[1] and grid.x[0] <= first.x[0]
    check_contact(config, contact)
    check_contact(*loaded(*grows, "motion.angle=30"))
    check_contact(*loaded(*grows, "contact.radius_y=40 mm"))
    with pytest.raises(ConfigError, match=r"grid.x = .*: must begin before -1\d"):
        check_contact(*loaded(*grows, "grid.x=[-8, 8]"))
    assert last.x_scale == pytest.approx(10.0 * contact.x_scale)


def test_a_motion_that_turns_has_a_domain_for_each_of_its_directions(tmp_path):
    (tmp_path / "angle.csv").write_text("0,0\n1,90\n")
    turns = ["time.end=1", f"motion.angle={tmp_path / 'angle.csv'}", "motion.speed=0.5"]
    grid, first = with_domain(*loaded(*turns)).grid, with_domain(*loaded("motion.speed=0.5")).grid
    assert grid.x == grid.y and grid.x[0] <= first.x[0] and grid.y[1] >= first.y[1]
    check_contact(*loaded(*turns))
    short = ["grid.x=[-4, 3]", "grid.y=[-1.5, 1.5]"]
    lost = []
    for motion in (turns, ["time.end=1", "motion.angle=90", "motion.speed=0.5"]):
        case = checked_case(loaded(*motion, *short)[0])
        lost.append(resolution(case.contact, case.mesh, case.scene).domain_loss_percent)
    assert lost[0] == pytest.approx(lost[1]), "judged in the direction that it takes most from"
    with pytest.raises(ConfigError, match=r"grid.y = .*: must begin before"):
        check_contact(*loaded(*turns, "grid.x=[-4, 4]", "grid.y=[-1.05, 4]"))


LIGHT_AND_ROUGH = [
    "contact.radius_x=2.7 mm", "contact.radius_y=2.7 mm", "contact.load=0.12", "motion.speed=0.03",
    "lubricant.viscosity=0.0075", "lubricant.pressure_viscosity=9.5 1/GPa", "grid.nodes=129",
    "surface.kind=self-affine", "surface.rms=66 nm", "surface.hurst=0.5", "surface.seed=5",
    "surface.shortest_wavelength=9 um", "surface.longest_wavelength=47 um",
]  # fmt: skip


@pytest.mark.parametrize("more", [[], ["discretization.contact_model=dry"]])
def test_peaks_that_touch_outside_the_smooth_contact_lie_within(more):
    """A domain for smooth bodies cut them off: the run said so, and told the user to take "auto"."""
    config, contact = loaded(*LIGHT_AND_ROUGH, *more)
    (X, Y), grid = reach_of_peaks(contact, 0.0), with_domain(config, contact).grid
    assert X > 1.5 and min(-grid.x[0], grid.x[1]) > X + 0.2 and min(-grid.y[0], grid.y[1]) > Y + 0.2
    assert solve(config, MPI.COMM_SELF).result.converged


def test_a_domain_in_numbers_does_not_ask_for_heights():
    """A result that was read back has no function of the user's own to ask."""
    for model in ("lcic", "dry"):
        numbers = ["grid.x=[-2, 2]", "grid.y=[-2, 2]", f"discretization.contact_model={model}"]
        config, contact = loaded("motion.speed=1", *numbers)
        contact = replace(contact, surface=Unreadable())
        assert with_domain(config, contact) is config


class Unreadable(Surface):
    def height(self, x, y):
        raise AssertionError("was asked")


def test_a_load_too_light_for_any_domain_is_told_so():
    with pytest.raises(ConfigError, match=r"grid.x: the inlet .* no domain goes beyond 1000"):
        config, contact = loaded("contact.load=1 mN", "motion.speed=0.5")
        check_contact(with_domain(config, contact), contact)
