from mgehl.config import config_from_tables
from mgehl.discretization.contact_law import UnifiedEquations
from mgehl.kinds import case_of
from mgehl.solver.from_config import set_up


def test_keys_reach_the_records_that_the_solver_is_given():
    tables = {
        "discretization": {"cavitation": False, "couette_at_interface": "untreated",
                           "contact_model": "unified", "unified_gap": 1e-9},
        "solver": {"tolerance": 1e-6, "method": "relaxation", "start": "contact", "inlet_cells": 3.0,
                   "sweeps": 2, "squeeze": 5.0},
        "relaxation": {"omega": 0.1, "load_every": 4},
    }  # fmt: skip
    setup = set_up(case_of(config_from_tables(tables)))
    settings, scheme, relaxation = setup.settings, setup.settings.scheme, setup.settings.relaxation
    assert (scheme.cavitation, scheme.couette_at_interface) == (False, "untreated")
    assert scheme.contact_law == UnifiedEquations(1e-9 / setup.contact.film_scale)
    assert (settings.method, settings.start) == ("relaxation", "contact")
    assert settings.inlet_cells == 3.0
    assert settings.newton.tolerance == relaxation.tolerance == 1e-6
    assert (relaxation.omega, relaxation.load_every) == (0.1, 4)
    assert settings.cycle.sweeps == 2 and settings.newton.squeeze == 5.0
