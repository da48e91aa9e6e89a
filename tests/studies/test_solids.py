"""From which lambda on solids carry load: what the study asks for, and what it concludes."""

import numpy as np
import pytest

from mgehl.studies.solids import begin


def test_where_a_part_is_carried_is_exact_of_a_power():
    ratio = np.array([0.05, 0.1, 0.3])
    found = begin("Newtonian", "moving", ratio, 1e-5 / ratio**3)
    assert float(found["lambda at 1 %"]) == pytest.approx(0.1, rel=1e-2)
    assert found["lambda at 10 %"] == ""  # it is carried at no lambda that was looked at
