import numpy as np

from mgehl.discretization.contents import feeding, missing_fillings, passed_on


def masks(*lines):
    """Of nodes by letters, a line each: cavities, and films that receive."""
    letters = np.array([list(line) for line in lines])
    return letters == "c", letters == "f"


def test_cavities_before_a_film_feed_it():
    """Those behind it only feed the domain's end."""
    assert feeding(*masks("bccfccb"), False).tolist() == [[0, 1, 1, 0, 0, 0, 0]]


def test_motion_at_an_angle_feeds_the_next_line_too():
    """A film there is fed from the line before, and so by the cavity before that one."""
    fields = masks("bcccb", "bbbfb", "bcccb")
    assert not feeding(*fields, False).any()
    assert feeding(*fields, True).tolist() == [[0, 1, 1, 1, 0], [0] * 5, [0] * 5]


def test_cavities_feed_through_cavities_of_the_next_line():
    fields = masks("bcbbb", "bccfb")
    assert feeding(*fields, False).tolist() == [[0] * 5, [0, 1, 1, 0, 0]]
    assert feeding(*fields, True).tolist() == [[0, 1, 0, 0, 0], [0, 1, 1, 0, 0]]


def test_what_is_given_is_passed_on_as_far_as_it_is_taken():
    gives, takes = np.zeros((1, 7), dtype=bool), np.array([[0, 1, 1, 1, 0, 1, 1]], dtype=bool)
    gives[0, 2] = True
    for turned in (np.asarray, np.transpose):
        passed = passed_on(turned(gives), turned(takes), int(turned is np.asarray))
        assert turned(passed).tolist() == [[0, 0, 1, 1, 0, 0, 0]]


def test_wherever_a_rise_is_marched_no_inflow_is_left():
    """At an angle; with other nodes between, which carry nothing on."""
    rng = np.random.default_rng(5)
    inflow = rng.uniform(-0.2, 0.2, (4, 7))
    leaving_x, leaving_y = rng.uniform(1.0, 2.0, (2, 4, 7))
    marched = rng.uniform(size=(4, 7)) < 0.7
    marched[:, [0, -1]] = False
    stored = rng.uniform(0.0, 1.0, (4, 7))
    rise = missing_fillings(marched, inflow, leaving_x, leaving_y, stored)
    left = inflow - (leaving_x + leaving_y + stored) * rise
    left[:, 1:] += (leaving_x * rise)[:, :-1]
    left[1:] += (leaving_y * rise)[:-1]
    assert not rise[~marched].any()
    assert rise[marched].all()
    np.testing.assert_allclose(left[marched], 0.0, atol=1e-15)
