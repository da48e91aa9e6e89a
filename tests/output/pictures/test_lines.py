"""Centre lines of a run."""

import numpy as np
import pytest

from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.output.pictures import style
from mgehl.output.pictures.lines import centre_lines


@pytest.fixture
def drawn():
    """Function that draws a run's centre lines; its axes: pressure along x and y, films along x and y."""

    def draw(solution):
        with style.applied():
            return centre_lines(solution).axes

    return draw


def lines_of(axes):
    """Each line of an axes by its label."""
    return {line.get_label(): line for line in axes.get_lines()}


def test_both_axes_show_the_fields_in_GPa_and_nm(make_solution, drawn):
    solution = make_solution()
    i, j = solution.mesh.nearest(0.0, 0.0)
    axes, (GPa, nm) = drawn(solution), (1e-9 * solution.pressure, 1e9 * solution.film)
    for above, below, line, position in (
        (*axes[::2], (j, slice(None)), solution.mesh.X),
        (*axes[1::2], (slice(None), i), solution.mesh.Y),
    ):
        np.testing.assert_allclose(lines_of(above)["pressure"].get_xydata().T, [position, GPa[line]])
        np.testing.assert_allclose(lines_of(below)["film"].get_xydata().T, [position, nm[line]])
        assert above.get_xlim() == below.get_xlim() == pytest.approx(tuple(position[[0, -1]]))


def test_against_the_pressure_and_the_gap_of_the_dry_contact(make_solution, drawn):
    solution = make_solution(nodes=129)
    pressure, _, film, _ = drawn(solution)
    X, contact = solution.mesh.X, solution.contact
    hertz = lines_of(pressure)["dry contact (Hertz)"].get_ydata()
    np.testing.assert_allclose(hertz, 1e-9 * contact.hertz.p_h * np.sqrt(np.maximum(1 - X**2, 0)))
    gap = lines_of(film)["dry contact (Hertz)"].get_ydata()
    np.testing.assert_allclose(gap, 1e9 * contact.film_scale * contact.dry_gap(X, 0.0 * X))


class TestRough:
    """A contact with layers of 2 nm whose fluid carries half of the pressure."""

    @pytest.fixture
    def solution(self, make_solution):
        solution = make_solution(65, contact=0.3, settings=["contact.boundary_film=2 nm"])
        fields, nm = solution.fields, 1e9 * solution.contact.film_scale
        fields.H[:] = (2.0 + 300.0 * np.abs(solution.mesh.X)) / nm
        fields.H[fields.status == CONTACT] = 2.0 / nm
        fields.p = np.where(fields.status == CONTACT, 0.5, 1.0) * fields.P
        fields.filling = np.where(fields.status == CAVITATED, 0.1, 1.0)
        return solution

    def test_its_gap_has_a_logarithmic_axis_on_which_all_of_it_is_seen(self, solution, drawn):
        film = drawn(solution)[2]
        assert film.get_yscale() == "log"
        low, high = film.get_ylim()
        contact = lines_of(film)["contact"]
        assert low <= contact.get_ydata().min() and 1e9 * solution.film[32].max() < high
        where = solution.status[32] == CONTACT
        np.testing.assert_allclose(contact.get_xdata(), solution.mesh.X[where])

    def test_its_fluid_has_a_line_of_its_own_and_solids_carry_the_rest(self, solution, drawn, check_texts):
        pressure = drawn(solution)[0]
        own = lines_of(pressure)["pressure of the fluid in contact"].get_ydata()
        np.testing.assert_allclose(own, 1e-9 * solution.contact.pressure_scale * solution.fields.p[32])
        (solids,) = pressure.collections
        assert solids.get_label() == "carried by solids"
        check_texts(pressure.figure, "carried by solids", "oil in a cavity", "contact")

    def test_cavities_have_as_much_oil_as_fills_them_above_the_layers(self, solution, drawn):
        oil = lines_of(drawn(solution)[2])["oil in a cavity"]
        where = solution.status[32] == CAVITATED
        np.testing.assert_allclose(oil.get_xdata(), solution.mesh.X[where])
        np.testing.assert_allclose(oil.get_ydata(), 2.0 + 0.1 * (1e9 * solution.film[32, where] - 2.0))


def test_of_smooth_bodies_fluid_and_total_pressure_are_one(make_solution, drawn):
    assert "pressure of the fluid in contact" not in lines_of(drawn(make_solution(contact=0.4))[0])


def test_texts(make_solution, make_line, drawn, check_texts):
    check_texts(
        drawn(make_solution(settings=["motion.speed=0.5 m/s"]))[0].figure, "pressure, GPa",
        "film thickness, nm", "x, mm", "y, mm", "X = x/a, a = 0.4108 mm", "Y = y/b, b = 0.4108 mm",
        "film", "dry contact (Hertz)", "centre lines, 500 mm/s, 800 N, 33 x 33 nodes: converged",
    )  # fmt: skip
    settings = ["contact.load_per_length=1859 N/mm", "motion.speed=100 mm/s"]
    check_texts(drawn(make_line(settings=settings))[0].figure, "X = x/a, a = 0.523 mm", "x, mm",
                "centre lines, 100 mm/s, 1859 N/mm, 65 nodes: converged")  # fmt: skip


def test_the_dry_contact_of_a_coated_body_is_named_as_another(make_solution, drawn):
    keys = ["contact.deformation=coated", "coating.thickness=40 um", "coating.modulus=4 GPa"]
    assert "dry contact (Hertz, uncoated)" in lines_of(drawn(make_solution(settings=keys))[2])


def test_a_line_contact_has_one_column(make_line, drawn):
    assert len(drawn(make_line())) == 2


def test_millimetres_along_the_upper_side(make_solution, drawn):
    solution = make_solution()
    pressure = drawn(solution)[0]
    pressure.figure.draw_without_rendering()
    (upper,) = pressure.child_axes
    assert upper.get_xlim() == pytest.approx(1e3 * solution.x[[0, -1]], rel=1e-12)


def test_the_axis_of_the_film_shows_what_is_inside_and_below(make_solution, drawn):
    solution = make_solution(65)
    film = 1e9 * solution.film.min()
    assert drawn(solution)[2].get_ylim() == pytest.approx((0.0, 3.0 * film))
    i, j = solution.mesh.nearest(0.0, 0.0)
    solution.fields.H[j, i] *= -2.0  # the bodies overlap
    assert drawn(solution)[2].get_ylim() == pytest.approx((-2.2 * film, 3.0 * film))


@pytest.mark.parametrize("contact, reach", [(0.9, 1.9), (1.05, 1.9), (0.0, 60.0)])
def test_it_is_drawn_where_no_film_or_no_node_is_inside(make_solution, drawn, contact, reach):
    film = drawn(make_solution(contact=contact, settings=[f"grid.x=[-{reach},{reach}]"]))[2]
    low, high = film.get_ylim()
    assert 0.0 <= low < high


@pytest.mark.parametrize(
    "angle, titles",
    {
        0: ["Y = 0, along the motion (left to right)", "X = 0, across the motion"],
        30: ["Y = 0, along x", "X = 0, along y"],
        180: ["Y = 0, along x", "X = 0, along y"],
    }.items(),
)
def test_lines_are_named_by_the_motion_where_that_is_along_x(make_solution, drawn, angle, titles):
    axes = drawn(make_solution(settings=[f"motion.angle={angle}"]))
    assert [each.get_title() for each in axes[:2]] == titles
