"""A python-type SNES: PETSc's options, monitors and viewers of SNES, KSP and PC see what is solved."""

from dataclasses import replace

from petsc4py import PETSc

from mgehl.errors import OptionError
from mgehl.multigrid.options import OF_A_RUN


class PythonSnes:
    """The SNES that a subclass iterates by `_iterate`, with its `_form_function` and `_form_jacobian`.
    Linear systems are a `MultigridSolver`'s; `settings` are `NewtonSettings`; `free` destroys them."""

    def __init__(self, multigrid, settings):
        self._multigrid, self._space = multigrid, multigrid.space
        self._unknown, self._f, self._rhs, self._correction = (self._space.create_vec() for _ in range(4))
        self._snes = PETSc.SNES().create(self._space.grid.comm)
        self._snes.setOptionsPrefix(OF_A_RUN)
        self._snes.setType(PETSc.SNES.Type.PYTHON)
        self._snes.setPythonContext(self)
        self._snes.setFunction(self._form_function, self._f)
        self._snes.setJacobian(self._form_jacobian, multigrid.jacobian.mat)
        self._snes.setTolerances(atol=settings.tolerance, rtol=0.0, max_it=settings.max_steps)
        multigrid.configure(self._snes.getKSP(), settings.linear_tolerance)
        self._snes.setFromOptions()
        # PETSc's options may give others.
        self._linear_tolerance = self._snes.getKSP().getTolerances()[0]
        _, tolerance, _, max_steps = self._snes.getTolerances()
        self._settings = replace(settings, tolerance=tolerance, max_steps=max_steps)
        if self._snes.getType() != PETSc.SNES.Type.PYTHON:
            self.free()
            raise OptionError(f"-{OF_A_RUN}snes_type: the solver is the SNES type python, no other")

    def free(self):
        """Destroy the PETSc objects, the multigrid solver's too: the KSP refers to them. (Not called
        `destroy`: PETSc calls a context's method of that name.)"""
        for each in (self._snes, self._unknown, self._f, self._rhs, self._correction):
            each.destroy()
        self._multigrid.free()

    def solve(self, snes, _b, _x):
        """Called by PETSc, which could not free objects if an exception passed: it is raised later."""
        try:
            self._iterate()
        except Exception as stopped:
            self._stopped = _first_cause(stopped)
            snes.setConvergedReason(PETSc.SNES.ConvergedReason.DIVERGED_INNER)

    def _let_it_solve(self):
        """Let SNES iterate."""
        self._stopped = None
        self._snes.solve(None, self._unknown)
        if self._stopped:
            raise self._stopped


def _first_cause(error):
    """The exception that a callback raised: newer PETSc wraps it in an error of its own."""
    while isinstance(error, PETSc.Error) and error.__cause__:
        error = error.__cause__
    return error
