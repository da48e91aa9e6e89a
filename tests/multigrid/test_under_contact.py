import numpy as np
import pytest
from scipy.sparse import csr_matrix

from mgehl.multigrid.under_contact import factored


def test_nodes_that_keep_what_they_have_leave_the_others_their_pressure():
    """A rough roller of 1 um (226 GPa, Barus, 5 p_h on its peaks) had two such nodes."""
    balance = np.array([[-2.0, 0.0, 0.0], [0.0, -1e-30, 1e-30], [0.0, 1e-30, -1e-30]])
    p = factored(csr_matrix(balance)).solve(np.array([4.0, 0.0, 0.0]))
    assert p[0] == pytest.approx(-2.0, rel=1e-11) and np.isfinite(p).all()


@pytest.mark.parametrize("nothing", [0.0, 1e-310])
def test_nodes_without_any_flow_keep_their_pressure(nothing):
    """Far from a solution pressures may be so large that nothing flows at all (soft line contacts)."""
    balance = np.array([[-2.0, 0.0, 0.0], [0.0, -nothing, nothing], [0.0, nothing, -nothing]])
    p = factored(csr_matrix(balance)).solve(np.array([4.0, 0.0, 0.0]))
    assert p == pytest.approx([-2.0, 0.0, 0.0])


def test_a_balance_without_a_solution_has_no_number():
    """Of a state that has run away: the error of the factorisation ended the run, and `--resume`, too."""
    balance = np.full((2, 2), np.nan)
    assert np.isnan(factored(csr_matrix(balance)).solve(np.ones(2))).all()
