"""Rough bodies under a thick film: from a film and from contact the same."""

import pytest
from mpi4py import MPI

from mgehl.config import chosen_config, load_config
from mgehl.run import solve

THICK_FILM = {
    "contact.load": 100.0, "motion.speed": "1 m/s", "grid.nodes": 129, "solver.error": False,
    "surface.kind": "self-affine", "surface.rms": "20 nm", "surface.shortest_wavelength": "60 um",
    "surface.longest_wavelength": "200 um",
}  # fmt: skip
"""By contact that closes its faces a start from contact does not end: it would open everywhere."""


def test_either_start_leads_to_the_film():
    film, contact = (
        solve(load_config(chosen_config(), THICK_FILM | {"solver.start": start}), MPI.COMM_SELF).result
        for start in ("film", "contact")
    )
    assert film.converged and contact.converged and not contact.contact.nodes
    assert contact.work.convolutions < 150.0
    for name in ("central_film_nm", "minimum_film_nm"):
        assert getattr(contact, name) == pytest.approx(getattr(film, name), rel=1e-6)
