"""Which smoother a grid of the cycle has."""

from mgehl.discretization.couette import SCHEMES
from mgehl.multigrid.crossed_lines import CliffSmoother, CrossedLineSmoother
from mgehl.multigrid.smoother import LineSmoother
from mgehl.multigrid.valleys import RoughLineSmoother, ValleySmoother


def smoother_of(is_line, couette, holds_film=False, in_valleys=False, finest=False):
    """The class of the smoother of a grid: a single line has nothing beside it.

    Lines both ways share a diagonal, to which a central `couette` scheme adds nothing: it has lines along X
    alone. A film `in_valleys` has smoothers of its own, another on the `finest` grid. Cliffs are looked for
    where a grid holds the film.
    """
    if is_line:
        return LineSmoother
    if in_valleys:
        return ValleySmoother if finest else RoughLineSmoother
    if SCHEMES[couette].is_central:
        return LineSmoother
    return CliffSmoother if finest or holds_film else CrossedLineSmoother
