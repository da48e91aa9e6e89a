import numpy as np
import pytest

from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.output.pictures import maps
from mgehl.output.pictures.lines import centre_lines


def lines_of(axes):
    return {line.get_label(): line for line in axes.get_lines()}


def test_both_axes_show_the_fields_in_GPa_and_nm(make_solution, drawn):
    solution = make_solution()
    i, j = solution.mesh.centre
    axes, (GPa, nm) = drawn(centre_lines, solution).axes, (1e-9 * solution.pressure, 1e9 * solution.film)
    for above, below, line, position in (
        (*axes[::2], (j, slice(None)), solution.mesh.X),
        (*axes[1::2], (slice(None), i), solution.mesh.Y),
    ):
        np.testing.assert_allclose(lines_of(above)["pressure"].get_xydata().T, [position, GPa[line]])
        np.testing.assert_allclose(lines_of(below)["film"].get_xydata().T, [position, nm[line]])
        assert above.get_xlim() == below.get_xlim() == pytest.approx(tuple(position[[0, -1]]))


def test_a_soft_contact_is_drawn_in_kPa_as_it_is_told(make_solution, drawn):
    solution = make_solution(settings=["contact.reduced_modulus=100 kPa", "contact.load=1 mN"])
    above, axes = drawn(centre_lines, solution).axes[0], drawn(maps.pressure_map, solution).axes
    assert above.get_ylabel() == "pressure, kPa" and axes[0].child_axes[0].get_ylabel() == "pressure, kPa"
    drawn_lines = lines_of(above)
    assert drawn_lines["pressure"].get_ydata().max() == pytest.approx(1e-3 * solution.pressure.max())
    (hertz,) = [line for label, line in drawn_lines.items() if label.startswith("dry contact")]
    assert hertz.get_ydata().max() == pytest.approx(1e-3 * solution.contact.hertz.p_h, rel=1e-3)


def test_suction_behind_a_contact_under_pressure_is_seen(make_solution, drawn):
    solution = make_solution()
    i, j = solution.mesh.centre
    solution.fields.P[j, i + 3] = -0.2
    low, _ = drawn(centre_lines, solution).axes[0].get_ylim()
    assert low < 1e-9 * solution.pressure.min() < 0.0


@pytest.mark.parametrize("suction", [0.0, -0.2])
def test_bodies_that_overlap_are_seen_below_nothing(make_solution, drawn, suction):
    """Deeper than the film is thick, on one node; elsewhere it differs by decades."""
    solution = make_solution()
    i, j = solution.mesh.centre
    solution.fields.P[j, i + 3] = suction
    solution.fields.H[j] *= 1.0 + 1e3 * np.abs(solution.mesh.X)
    assert drawn(centre_lines, solution).axes[2].get_yscale() == "log"
    solution.fields.H[j, i - 1] = -2.0 * solution.fields.H[j].min()
    low, _ = drawn(centre_lines, solution).axes[2].get_ylim()
    assert low < 1e9 * solution.film.min() < 0.0


def test_what_carries_load_is_shown_beside_a_smooth_dry_contact(make_solution, drawn):
    """Of a domain of 60 semi-axes a side; and Hertz's pressure is no polygon of few nodes."""
    solution = make_solution(settings=["grid.x=[-60,60]"])
    above = drawn(centre_lines, solution).axes[0]
    left, right = above.get_xlim()
    assert -15.0 < left < -1.5 and 1.5 < right < 15.0
    (hertz,) = [line for label, line in lines_of(above).items() if label.startswith("dry contact")]
    assert len(hertz.get_xdata()) > 10 * solution.mesh.nx


def test_the_fluid_in_layers_has_a_line_and_solids_carry_the_rest(make_solution, drawn, check_texts):
    """Layers of 2 nm, in which the fluid carries half of the pressure."""
    solution = make_solution(65, contact=0.3, settings=["contact.boundary_film=2 nm"])
    fields, nm = solution.fields, 1e9 * solution.contact.film_scale
    fields.H[:] = (2.0 + 300.0 * np.abs(solution.mesh.X)) / nm
    fields.H[fields.status == CONTACT] = 2.0 / nm
    fields.p = np.where(fields.status == CONTACT, 0.5, 1.0) * fields.P
    fields.filling = np.where(fields.status == CAVITATED, 0.1, 1.0)
    pressure = drawn(centre_lines, solution).axes[0]
    own = lines_of(pressure)["pressure of the fluid in contact"].get_ydata()
    np.testing.assert_allclose(own, 1e-9 * solution.contact.pressure_scale * solution.fields.p[32])
    (solids,) = pressure.collections
    assert solids.get_label() == "carried by solids"
    check_texts(pressure.figure, "carried by solids", "oil in a cavity", "contact")


@pytest.mark.parametrize("contact, reach", [(0.9, 1.9), (1.05, 1.9), (0.0, 60.0)])
def test_it_is_drawn_where_no_film_or_no_node_is_inside(make_solution, drawn, contact, reach):
    solution = make_solution(contact=contact, settings=[f"grid.x=[-{reach},{reach}]"])
    low, high = drawn(centre_lines, solution).axes[2].get_ylim()
    assert 0.0 <= low < high


def test_layers_in_contact_beyond_the_dry_contact_make_the_axis(make_solution, drawn):
    """The picture was 800 000 pixels high: dots of contact stood far outside of its axis."""
    solution = make_solution(contact=1.4, settings=["grid.x=[-1.9,1.9]"])
    contact, nm = solution.fields.status == CONTACT, 1e9 * solution.contact.film_scale
    solution.fields.H[contact] = 3.0 / nm
    low, high = drawn(centre_lines, solution).axes[2].get_ylim()
    assert low <= 3.0 < high < 100.0
