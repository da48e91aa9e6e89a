"""Study waviness: small waves at rest in full films, beside an independent linear calculation."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.model.conditions import Conditions
from mgehl.output.study_directory import StudyRecord
from mgehl.studies import venner_laws, waviness
from mgehl.studies.study import Study, merged
from mgehl.studies.waviness import GRIDS, LINES, REFERENCE, line_case, respond


def responses(directory, couette, mean, nodes, line):
    """Smooth film by Moes, and what waves of each length change."""
    scheme = {"grid": {"nodes": nodes}, "discretization": {"couette": couette, "face_mobility": mean}}
    study = Study(directory, MPI.COMM_SELF, StudyRecord("waviness", (), 1, {}), speak=False)
    case = merged(line_case(*line), scheme)
    smooth = study.solve("smooth", case)
    found = {length: respond(study, "waves", case, smooth, length) for length in (1.0, 0.5)}
    return smooth.result.moes_film.central, found


@pytest.mark.parametrize("line, film", zip(LINES, (3.6315, 3.9852), strict=True))
def test_by_the_scheme_of_the_reference_it_is_the_reference(tmp_path, line, film):
    """To the digits that are given, smooth film and waves."""
    smooth, found = responses(tmp_path, *GRIDS[0], line)
    assert smooth == pytest.approx(film, abs=6e-5)
    for length, each in found.items():
        assert each.converged and each.uniform == pytest.approx(REFERENCE[line[0], length], rel=2e-3)


def test_waves_are_flattened_but_for_what_the_density_gives_way(tmp_path):
    """a/A = C/(1 + C), C = h E' k/(4 B), where nothing flows through the wave [Hooke 2006]."""
    _, found = responses(tmp_path, "3B", "linear-gap", 1025, LINES[0])
    p = np.array([1.995e9])
    density, slope = venner_laws.dowson_higginson(Conditions(p))
    film = 3.64 * (2.2e-8 * 220e9 / 11.0) ** -2 * waviness.RADIUS
    b = 4.606e-4
    C = film * 220e9 * (2.0 * np.pi / b) / 4.0 * (slope / density)[0]
    assert found[1.0].wave == pytest.approx(C / (1.0 + C), rel=0.1)
    assert found[0.5].wave == pytest.approx(2.0 * C / (1.0 + 2.0 * C), rel=0.1)
