"""The film that there would be if shear did not thin it: the same contact once more, from the answer."""

from dataclasses import replace

from mgehl.solver.on_grid import solve_near
from mgehl.solver.problem import ContactProblem


def unthinned(hierarchy, problem, state, settings, monitor, journal):
    """The `ContactProblem` whose oil shear does not thin, and its `Outcome`, from a `state` of the thinned
    one (collective); `monitor` and `journal` as of `nested_iteration`."""
    contact = problem.contact
    contact = replace(contact, friction=replace(contact.friction, thins=False))
    thicker = ContactProblem(problem.grid, problem.deflection, contact, problem.scheme)
    begun = thicker.state(state.P, state.H0, state.status, state.p, state.filling)
    return thicker, solve_near(hierarchy, thicker, begun, settings, monitor, journal)
