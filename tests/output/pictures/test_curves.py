import pytest

from mgehl.output.pictures.curves import curves
from mgehl.output.quantities import Told


def told(speed, solids):
    result = {
        "settled": True,
        "converged": True,
        "mixed": {"solid_load_fraction": solids, "mean_gap_nm": 9.0},
    }
    return Told({"motion": {"speed": speed}}, result)


def shaded(figure):
    """Ends along x of what is grey in each panel."""
    return [tuple(patch.get_extents().transformed(axis.transData.inverted()).intervalx)
            for axis in figure.axes for patch in axis.patches]  # fmt: skip


def test_mixed_lubrication_is_grey_up_to_halfway_to_what_is_not():
    runs = [told(speed, solids) for speed, solids in ((1e-3, 0.95), (1e-2, 0.5), (1e-1, 0.02), (1.0, 0.0))]
    for ends in shaded(curves(runs, "motion.speed")):
        assert ends == pytest.approx((10**-2.5, 10**-0.5))


def test_full_films_have_no_grey():
    assert shaded(curves([told(0.1, 0.0), told(0.2, 0.001)], "motion.speed")) == []
