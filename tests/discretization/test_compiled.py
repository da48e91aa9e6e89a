import sys

from places import ROOT, ROUGH
from processes import ended


def test_without_any_place_functions_are_compiled_again(tmp_path):
    """No HOME, and an installation that nobody may write: a copy whose cache is a file."""
    text = (
        "import numba.core.caching as c\n"
        "def none(*_): raise RuntimeError('no locator available')\n"
        "c.CacheImpl.__init__ = none\n"
        "import numpy as np\n"
        "from mgehl.discretization.band_kernels import span_of\n"
        "assert span_of(np.array([[True, True, False, True, True]]), (0, 1)) == (1, 4)\n"
    )
    done = ended([sys.executable, "-c", text], PYTHONPATH=str(ROOT))
    assert done.returncode == 0, done.stderr


SOLVED = """
import hashlib
import mgehl
settings = {"grid.nodes": 65, "solver.max_steps": 8, "solver.error": False}
solution = mgehl.solve(mgehl.load(%r, settings))
print(hashlib.sha256(solution.fields.P.tobytes()).hexdigest())
"""


def test_what_was_just_compiled_gives_the_bits_of_what_was_kept(tmp_path):
    """Functions that are compiled together may be fused, and are not when they are read again.

    A multiplication and an addition that are one instruction round otherwise: a rough ball took 168
    convolutions where it was the first run of a copy, and 152 in all later runs.
    """
    run = [sys.executable, "-c", SOLVED % str(ROUGH)]
    variables = {"NUMBA_CACHE_DIR": str(tmp_path), "PYTHONPATH": str(ROOT)}
    first, second = (ended(run, **variables).stdout for _ in "12")
    assert list(tmp_path.iterdir()) and len(first) > 60 and first == second
