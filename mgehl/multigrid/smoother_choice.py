"""Which smoother a grid of the cycle has."""

from mgehl.multigrid.crossed_lines import CliffSmoother, CrossedLineSmoother
from mgehl.multigrid.smoother import LineSmoother, RigidLineSmoother
from mgehl.multigrid.valleys import RoughLineSmoother, ValleySmoother


def smoother_of(jacobian, thin=False, finest=False, apart=False):
    """The class of a grid's smoother: a rigid gap has no K, and a single line has nothing beside it.

    A `thin` film closes at the peaks of rough surfaces and opens in their valleys; it has smoothers of its
    own, on the `finest` grid one for valleys. Where the fluid is solved `apart` hardly more than contact is
    left, which has no direction: lines along X take as many convolutions there, and a tenth less time.
    Cliffs are looked for on the finest grid and on all that hold the film.
    """
    if jacobian.rigid:
        return RigidLineSmoother
    if jacobian.grid.mesh.is_line:
        return LineSmoother
    if thin:
        return ValleySmoother if finest else RoughLineSmoother
    if apart:
        return LineSmoother
    return CliffSmoother if finest or jacobian.holds_film else CrossedLineSmoother
