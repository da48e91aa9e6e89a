from types import SimpleNamespace

import pytest

from mgehl.model import films
from mgehl.model.contact import Groups
from mgehl.model.films import nijenbanning_venner_moes

# The literals below were computed in 30-digit decimal arithmetic from the formulas as printed in
# the literature, with no line of mgehl.


@pytest.mark.parametrize(
    "M, L, H, rel",
    [
        (1e5, 1e-6, 3.18 * 1.636 ** (-14 / 25) * 1e5 ** (-2 / 15), 2e-3),
        (1e7, 100.0, 1.48 * 1.63 ** (-7 / 20) * 1e7 ** (-1 / 12) * 100.0**0.75, 1e-2),
        (0.1, 1e-3, 145.0 * 1.796 ** (-15 / 7) * 0.1**-2.0, 1e-2),
    ],
    ids=["isoviscous elastic", "piezoviscous elastic", "isoviscous rigid"],
)
def test_nijenbanning_venner_moes_tends_to_its_asymptotes(M, L, H, rel):
    """Circular contact, far into one regime."""
    groups = SimpleNamespace(U=2e-12, M=M, L=L)
    film = nijenbanning_venner_moes(groups, 0.02, 0.02)
    assert film / 0.02 / 4e-12**0.5 == pytest.approx(H, rel=rel)


@pytest.mark.parametrize(
    "M, L, name",
    [
        (1.0, 0.1, "rigid isoviscous"),
        (1000.0, 0.1, "elastic isoviscous"),
        (3.0, 20.0, "rigid piezoviscous"),
        (2000.0, 10.0, "elastic piezoviscous"),
    ],
)
@pytest.mark.parametrize(
    "asymptotes", [lambda groups: films.point_asymptotes(groups, 1.0), films.line_asymptotes]
)
def test_regime_is_the_corner_of_moes_chart(asymptotes, M, L, name):
    assert films.regime(*asymptotes(Groups(0.0, 0.0, 0.0, M=M, L=L))) == name


@pytest.mark.parametrize(
    "M, L, asymptote", [(0.05, 1.0, 0), (200.0, 0.05, 1), (0.5, 300.0, 2), (2000.0, 20.0, 3)]
)
def test_the_line_contact_s_film_of_every_regime_has_its_asymptotes(M, L, asymptote):
    groups = Groups(U=1e-11, W=1e-4, G=4500.0, M=M, L=L)
    film = films.moes_line(groups, 0.02) / (0.02 * (2e-11) ** 0.5)
    assert film == pytest.approx(films.line_asymptotes(groups)[asymptote], rel=0.15)
