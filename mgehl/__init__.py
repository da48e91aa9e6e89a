"""mgehl: multigrid for mixed and boundary lubrication of loaded contacts.

The layers, lowest first; none imports a higher one (``tests/test_layers.py`` asserts it):

``model``           what is computed: SI parameters in, dimensionless groups out
``discretization``  finite volumes on one grid: face flows, residual, influence, line bands
``grid``            PETSc DMDA hierarchy, transfers between grids, distributed convolution
``multigrid``       line smoother, coarse solve, PCMG cycle for the bordered Jacobian
``solver``          Newton, contact and cavitation partition, nested iteration, verification
``output``, ``cli`` files, pictures, command line
"""

__version__ = "0.1.0"
