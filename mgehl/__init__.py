"""mgehl: multigrid for mixed and boundary lubrication of loaded contacts.

    solution = mgehl.solve(mgehl.load("my.toml"))

`load`, `solve`, `sweep` and `read` are the interface (`mgehl.api`). The layers, lowest first; none imports
a higher one (``tests/test_layers.py`` asserts it):

``model``           what is computed: SI parameters in, dimensionless groups out
``discretization``  finite volumes on one grid: face flows, residual, influence, line bands
``kinds``           point, line, wedge: the keys they take, what is built of them, their words
``grid``            PETSc DMDA hierarchy, transfers between grids, distributed convolution
``multigrid``       line smoothers, coarse solve, F-cycle for the bordered Jacobian
``solver``          Newton, contact and cavitation partition, nested iteration, verification
``output``          files, pictures, tables, progress
``studies``         many solves and what they show
``commands``        the command line, a module for each command
"""

import warnings
from importlib import import_module
from typing import TYPE_CHECKING

from mgehl.version import VERSION

if TYPE_CHECKING:
    from mgehl.answer import Solution
    from mgehl.api import load, read, solve, sweep
    from mgehl.config import Config
    from mgehl.errors import ConfigError, UserError

__version__ = VERSION

__all__ = [
    "Config",
    "ConfigError",
    "Solution",
    "UserError",
    "__version__",
    "load",
    "read",
    "solve",
    "sweep",
]

_MODULES = {
    "Config": "mgehl.config",
    "ConfigError": "mgehl.errors",
    "Solution": "mgehl.answer",
    "UserError": "mgehl.errors",
    "load": "mgehl.api",
    "read": "mgehl.api",
    "solve": "mgehl.api",
    "sweep": "mgehl.api",
}
"""Where each name comes from. It is imported when it is first asked for: where numpy and numba are missing
the command line can then still say how to put the environment on."""


def __getattr__(name: str) -> object:
    """A name of the interface."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of libraries, whose users are not ours
        value = globals()[name] = getattr(import_module(_MODULES[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
