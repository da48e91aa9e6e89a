"""What the solver is asked for, made once at its door and handed through all ways to an answer."""

from dataclasses import dataclass, replace
from functools import cached_property

from mgehl.grid.hierarchy import Hierarchy
from mgehl.solver.journal import NOTHING_KEPT, Journal
from mgehl.solver.problem import ContactProblem
from mgehl.solver.recipe import recipe_on
from mgehl.solver.settings import SolverSettings


@dataclass(frozen=True)
class Task:
    """A loaded contact that is to be solved on the finest grid of a hierarchy."""

    hierarchy: Hierarchy
    contact: object
    settings: SolverSettings
    monitor: object = lambda level, cycle: None
    """Called with a `LevelSolve` and the `Cycle` for every cycle."""
    journal: Journal = NOTHING_KEPT

    @property
    def mesh(self):
        """The finest one."""
        return self.hierarchy.grids[-1].mesh

    @cached_property
    def recipe(self):
        """The `Recipe` of its solve from nothing."""
        return recipe_on(self.mesh, self.settings, self.contact)

    def problem(self):
        """The `ContactProblem` on the finest grid."""
        grid, deflection = self.hierarchy.grids[-1], self.hierarchy.deflections[-1]
        return ContactProblem(grid, deflection, self.contact, self.settings.scheme)

    def at_speed(self, speed):
        """The same at another speed in m/s."""
        return replace(self, contact=self.contact.at_speed(speed))

    def but(self, **settings):
        """The same but for some of its settings."""
        return replace(self, settings=replace(self.settings, **settings))

    @property
    def may_go_on(self):
        """Whether the run has made fewer convolutions than it may (collective)."""
        comm, hierarchy = self.hierarchy.grids[-1].comm, self.hierarchy
        made = comm.bcast(hierarchy.convolutions, root=comm.size - 1)  # the last rank has all grids
        return made < self.settings.newton.max_work

    def limited(self, **newton):
        """The same with other limits of Newton's method."""
        return replace(self, settings=self.settings.limited(**newton))

    def within(self, part):
        """The same with a part of the work that is allowed (`solver.max_work`)."""
        return self.limited(max_work=part * self.settings.newton.max_work)
