"""Waves that stand still in the full film of a line contact: how they change it, beside published numbers.

What the contact does not flatten of small waves is mostly a uniform change of film, made in the inlet: told
with a peak in the centre and a quarter of a length further on. Half the difference between waves of either
sign has no part that grows with their square.
"""

from math import hypot, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mgehl.output.table import yes
from mgehl.studies import venner_laws
from mgehl.studies.study import merged

SMALL = 0.01
"""Amplitude of the waves over the smooth central film: with 0.002 the same four digits."""

WITHIN = 0.5
"""Distance from the centre within which the change of film is looked at: units of the half-width."""

LENGTHS = (1.0, 0.5)
"""Of waves, over the half-width."""

MODULUS, RADIUS, VISCOSITY, ALPHA = 220e9, 12.7e-3, 0.04, 2.2e-8
BODIES = {"radius_x": RADIUS, "reduced_modulus": MODULUS}

FLUIDS = {
    "Roelands, compressible": {
        "viscosity_law": f"{Path(venner_laws.__file__)}:roelands",
        "density_law": f"{Path(venner_laws.__file__)}:dowson_higginson",
    },
    "Barus, incompressible": {"viscosity_law": "barus", "density_law": "constant"},
}

LINES = ((100.0, 11.0, "Roelands, compressible"), (200.0, 10.0, "Barus, incompressible"))
"""Moes' M and L, and the fluid."""

REFERENCE = {(100.0, 1.0): 0.0817, (100.0, 0.5): 0.1888, (200.0, 1.0): 0.0492, (200.0, 0.5): 0.1251}
"""Change of film over waves' amplitude by M and length: a linear calculation, 2B on 2049 nodes."""

GRIDS = (("2B", "arithmetic", 2049), ("3B", "linear-gap", 4097))
"""As the reference has it; and the usual scheme on 4097 nodes."""


class Response(NamedTuple):
    """Change of film over the waves' amplitude along the line through the centre: its uniform part, and the
    waves that are left; whether all solves converged, and the mean of their convolutions."""

    uniform: float
    wave: float
    converged: bool
    convolutions: float


def run(study):
    """Solve all; write the table `line`."""
    study.expected = len(GRIDS) * len(LINES) * (1 + 4 * len(LENGTHS))
    rows = [row for grid in GRIDS for line in LINES for row in _rows(study, grid, line)]
    study.write_table("line", rows)


def oil(fluid):
    """The table of an oil, by the name of its laws."""
    return {"viscosity": VISCOSITY, "pressure_viscosity": ALPHA, **FLUIDS[fluid]}


def line_case(M, L, fluid):
    """The tables of a line contact of these Moes numbers."""
    twice_U = (L / (ALPHA * MODULUS)) ** 4
    return {
        "contact": BODIES | {"kind": "line", "load_per_length": M * sqrt(twice_U) * MODULUS * RADIUS},
        "lubricant": oil(fluid),
        "motion": {"speed": 0.5 * twice_U * MODULUS * RADIUS / VISCOSITY},
        "grid": {"x": [-4.0, 1.5]},
    }


def _rows(study, grid, line):
    """Rows of one scheme and contact."""
    (couette, mean, nodes), (M, L, fluid) = grid, line
    scheme = {"couette": couette, "face_mobility": mean}
    case = merged(line_case(*line), {"grid": {"nodes": nodes}, "discretization": scheme})
    title = f"line M {M:g}, L {L:g}, {couette}, {nodes} nodes"
    smooth = study.solve(title, case)
    for length in LENGTHS:
        found = respond(study, title, case, smooth, length)
        known = REFERENCE[M, length]
        yield {
            "M": f"{M:g}", "L": f"{L:g}", "fluid": fluid,
            "scheme": f"{couette}, {mean}", "nodes": str(nodes),
            "smooth film (Moes)": f"{smooth.result.moes_film.central:.4f}",
            "wavelength/b": f"{length:g}",
            "change of film/A": f"{found.uniform:.4f}",
            "reference": f"{known:.4f}",
            "apart %": f"{100.0 * (found.uniform / known - 1.0):+.1f}",
            "wave left/A": f"{found.wave:.4f}",
            "convolutions": f"{found.convolutions:.0f}",
            "converged": yes(found.converged),
        }  # fmt: skip


def respond(study, title, case, smooth, length):
    """The `Response` to waves of a `length` over the half-width (collective)."""
    a = smooth.contact.x_scale
    amplitude = SMALL * 1e-9 * smooth.result.central_film_nm
    changes, results = [], []
    for quarter in (0.0, 0.25):
        films = []
        for half in (0.0, 0.5):
            wave = {"wavelength_x": length * a, "x": (quarter + half) * length * a}
            surface = {"kind": "waviness", "amplitude": amplitude, **wave}
            what = f"{title}, length {length:g}, moved {quarter + half:g}"
            solution = study.solve(what, merged(case, {"surface": surface}))
            films.append(central_line(solution))
            results.append(solution.result)
        if study.first:
            changes.append((films[0] - films[1]) / (2.0 * amplitude))
    parts = fitted(smooth.mesh.X, changes, length) if study.first else None
    convolutions = float(np.mean([result.work.convolutions for result in results]))
    return Response(*study.comm.bcast(parts), all(result.converged for result in results), convolutions)


def central_line(solution):
    """Film in m along the line of nodes through the centre, on rank 0; None elsewhere."""
    film = solution.film
    return None if film is None else film[solution.mesh.centre[1]]


def fitted(X, changes, length):
    """(uniform, wave): the amplitudes in two changes of film, by waves a quarter of a length apart. The
    response to waves anywhere is the real part of one complex function times exp(-ik x0)."""
    near = np.abs(X) <= WITHIN
    response = (changes[0] + 1j * changes[1])[near]
    wave = np.exp(2j * pi / length * X[near])
    parts = np.stack([np.ones_like(wave), wave, wave.conj()], axis=1)
    uniform, along, against = np.abs(np.linalg.lstsq(parts, response, rcond=None)[0])
    return float(uniform), hypot(along, against)
