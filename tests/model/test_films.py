from types import SimpleNamespace

import pytest

from mgehl.model import films
from mgehl.model.contact import Groups
from mgehl.model.films import chittenden, grubin, hamrock_dowson, nijenbanning_venner_moes

GROUPS = SimpleNamespace(U=1e-11, W=1e-6, G=4500.0)
PRINTED = {
    "hamrock, dowson": (
        lambda: hamrock_dowson(GROUPS, 1.0, 1.0), (1.765149363430689e-5, 1.002685985506984e-5)),
    "hamrock, dowson, 0.02 m, an ellipse": (
        lambda: hamrock_dowson(GROUPS, 0.02, 3.0), (4.65881378992432e-7, 3.536027815704578e-7)),
    "chittenden, a circle of 0.02 m": (
        lambda: chittenden(GROUPS, 0.02, 0.02), (3.415349464143568e-7, 2.012014198794409e-7)),
    "chittenden, wide": (
        lambda: chittenden(GROUPS, 0.02, 0.06), (4.452307761672909e-7, 3.097945192042367e-7)),
    "chittenden, long": (
        lambda: chittenden(GROUPS, 0.02, 0.005), (1.863893350052562e-7, 9.620436324916264e-8)),
    # (12*0.2687 * 2e-8 * 0.05 * 0.3 * 4e-4)^(3/4)/sqrt(1.6e-5)
    "grubin": (lambda: grubin(2e-8, 0.05, 0.3, 4e-4, 1.6e-5), 1.226486091358103e-7),
}  # fmt: skip
"""In 30-digit decimal arithmetic from the formulas as printed in the literature, with no line of mgehl."""


@pytest.mark.parametrize("film, expected", PRINTED.values(), ids=PRINTED)
def test_formulas_as_printed(film, expected):
    assert film() == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    "M, L, D, H, rel",
    [
        (20.0, 10.0, 1.0, 4.708073308, 1e-9), (200.0, 10.0, 1.0, 4.380290978, 1e-9),
        (200.0, 10.0, 0.25, 5.390596135, 1e-9), (1e4, 40.0, 1.0, 9.028713288, 1e-9),
        (5.0, 100.0, 1.0, 19.79027532, 1e-9),
        # Circular contacts far into one regime: isoviscous elastic, piezoviscous elastic, isoviscous rigid.
        (1e5, 1e-6, 1.0, 3.18 * 1.636 ** (-14 / 25) * 1e5 ** (-2 / 15), 2e-3),
        (1e7, 100.0, 1.0, 1.48 * 1.63 ** (-7 / 20) * 1e7 ** (-1 / 12) * 100.0**0.75, 1e-2),
        (0.1, 1e-3, 1.0, 145.0 * 1.796 ** (-15 / 7) * 0.1**-2.0, 1e-2),
    ],
)  # fmt: skip
def test_nijenbanning_venner_moes(M, L, D, H, rel):
    """Central film H (h/R_x)(2U)^(-1/2), for U = 2e-12 and R_x = 0.02: so printed, and asymptotes."""
    film = nijenbanning_venner_moes(SimpleNamespace(U=2e-12, M=M, L=L), 0.02, 0.02 / D)
    assert film / 0.02 / 4e-12**0.5 == pytest.approx(H, rel=rel)


@pytest.mark.parametrize(
    "M, L, name",
    [(1.0, 0.1, "rigid isoviscous"), (1000.0, 0.1, "elastic isoviscous"),
     (3.0, 20.0, "rigid piezoviscous"), (2000.0, 10.0, "elastic piezoviscous")],
)  # fmt: skip
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
