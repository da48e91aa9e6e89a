import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations

GAPS = np.array([-0.1, 0.0, 0.005, 0.01, 0.02])


def test_what_was_let_go_closes_again_only_when_the_bodies_overlap():
    """Node by node."""
    law, released = InterfaceConditions(0.01), np.array([True, True, True, False, True])
    assert law.closed(GAPS, released).tolist() == [True, True, False, True, False]


def test_interface_conditions_let_fluid_into_a_gap_only():
    assert InterfaceConditions(0.01).takes_fluid(GAPS).tolist() == [False, False, True, True, True]


def test_a_boundary_film_closes_continuously():
    """At the gap that it keeps, whatever the node was before; thinner fluid flows as through that gap."""
    law = BoundaryFilm(0.01)
    for was_released in (False, True):
        assert law.closed(GAPS, was_released).tolist() == [True, True, True, True, False]
    assert law.takes_fluid(GAPS).tolist() == [False, False, False, True, True]
    assert law.contact_gap == law.thinnest == 0.01 and not law.closes_faces
    gap, slope = law.flow_gap(GAPS)
    assert gap.tolist() == [0.01, 0.01, 0.01, 0.01, 0.02]
    assert slope.tolist() == [False, False, False, False, True]


def test_the_layers_of_a_boundary_film_are_not_carried_as_fluid():
    assert BoundaryFilm(0.01).carried(GAPS) == pytest.approx(GAPS - 0.01)
    assert InterfaceConditions(0.01).carried(GAPS) is GAPS and UnifiedEquations(0.01).carried(GAPS) is GAPS


def test_unified_equations_never_close_a_gap_and_fill_any():
    law = UnifiedEquations(0.01)
    assert not law.closed(GAPS, was_released=False).any()
    assert law.takes_fluid(GAPS).all()
