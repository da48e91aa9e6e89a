import pytest

from mgehl.output.pictures.curves import PANELS, curves
from mgehl.output.quantities import QUANTITIES, Told

NO_CURVES = {
    "loaded_gap_nm", "friction_of_rolling", "bearing_drag_N", "bearing_power_W", "bearing_centre_mm",
    "approach_um", "contact_area", "lambda_ratio", "convolutions",
}  # fmt: skip


def told(speed, solids):
    result = {
        "settled": True,
        "converged": True,
        "mixed": {"solid_load_fraction": solids, "mean_gap_nm": 9.0},
    }
    return Told({"motion": {"speed": speed}}, result)


def shaded(figure):
    return [tuple(patch.get_extents().transformed(axis.transData.inverted()).intervalx)
            for axis in figure.axes for patch in axis.patches]  # fmt: skip


def test_mixed_lubrication_is_grey_up_to_halfway_to_what_is_not():
    runs = [told(speed, solids) for speed, solids in ((1e-3, 0.95), (1e-2, 0.5), (1e-1, 0.02), (1.0, 0.0))]
    for ends in shaded(curves(runs, "motion.speed")):
        assert ends == pytest.approx((10**-2.5, 10**-0.5))


def test_full_films_have_no_grey():
    assert shaded(curves([told(0.1, 0.0), told(0.2, 0.001)], "motion.speed")) == []


def test_a_decade_has_numbers_that_can_be_read():
    figure = curves([told(0.05, 0.5), told(1.0, 0.4)], "motion.speed")
    figure.draw_without_rendering()
    shown = {text.get_text() for text in figure.axes[0].get_xticklabels(which="both")} - {""}
    assert {"0.05", "0.1", "0.2", "0.5", "1"} <= shown and "0.3" not in shown


def labels(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_a_point_without_a_band_that_others_have_is_hollow_and_the_legend_says_so():
    runs = [told(speed, 0.5) for speed in (0.1, 0.2)]
    assert "no band: the grid's" not in labels(curves(runs, "motion.speed"))
    runs[0].result["mixed"]["error"] = {"mean_nm": 1.0}
    figure = curves(runs, "motion.speed")
    assert "no band: the grid's" in labels(figure)


def test_each_quantity_has_a_curve_or_none_on_purpose():
    drawn = {name for panel in PANELS.values() for name in panel}
    assert drawn | NO_CURVES == QUANTITIES.keys() and not drawn & NO_CURVES
