"""Which smoother a grid of the cycle has."""

from mgehl.multigrid.crossed_lines import CliffSmoother, CrossedLineSmoother
from mgehl.multigrid.smoother import LineSmoother
from mgehl.multigrid.valleys import RoughLineSmoother, ValleySmoother


def smoother_of(is_line, holds_film=False, in_valleys=False, finest=False):
    """The class of a grid's smoother: a single line has nothing beside it.

    A film `in_valleys` has smoothers of its own, another on the `finest` grid. Cliffs are looked for where
    a grid holds the film.
    """
    if is_line:
        return LineSmoother
    if in_valleys:
        return ValleySmoother if finest else RoughLineSmoother
    return CliffSmoother if finest or holds_film else CrossedLineSmoother
