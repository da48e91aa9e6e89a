import numpy as np

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions, UnifiedEquations

GAPS = np.array([-0.1, 0.0, 0.005, 0.01, 0.02])


def test_interface_conditions():
    """Node by node: what was let go closes again only when the bodies overlap; fluid needs a gap."""
    law, released = InterfaceConditions(0.01), np.array([True, True, True, False, True])
    assert law.closed(GAPS, released).tolist() == [True, True, False, True, False]
    assert law.takes_fluid(GAPS).tolist() == [False, False, True, True, True]


def test_a_boundary_film_closes_continuously():
    """At the gap that it keeps, whatever the node was before; thinner fluid flows as through that gap, and
    the layers are not carried as fluid."""
    law = BoundaryFilm(0.01)
    for was_released in (False, True):
        assert law.closed(GAPS, was_released).tolist() == [True, True, True, True, False]
    assert law.takes_fluid(GAPS).tolist() == [False, False, False, True, True]
    gap, slope = law.flow_gap(GAPS)
    assert gap.tolist() == [0.01, 0.01, 0.01, 0.01, 0.02]
    assert slope.tolist() == [False, False, False, False, True]
    np.testing.assert_array_equal(law.carried(GAPS), GAPS - 0.01)


def test_unified_equations_never_close_a_gap_and_fill_any():
    law = UnifiedEquations(0.01)
    assert not law.closed(GAPS, was_released=False).any()
    assert law.takes_fluid(GAPS).all()
