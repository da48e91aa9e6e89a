"""Whether a domain is large enough for its film, and the words for it.

The verdict follows from the contact, the domain and the film of a formula alone: `mgehl check` and the run
say the same.
"""

from math import isnan

from mgehl.model.peaks import reach_of_peaks
from mgehl.model.starvation import Starvation

STARVED_FROM = 1.0
"""A domain starves its film from so many per cent on that a domain of twice the size would have more."""

SUFFICIENT, STARVED, UNKNOWN = "sufficient", "starved", "unknown"
"""Verdicts; the last of runs that older versions made."""


def film_lost(contact, mesh):
    """Estimate, in per cent, of the film that a domain of twice the size would have more.

    Of central and minimum film the one that changes more; good to a factor of two.
    """
    return Starvation(contact, contact.flooded_film).lost(mesh.x, mesh.y)


def domain_verdict(lost):
    """The verdict on a domain that takes so many per cent of the film away."""
    if isnan(lost):
        return UNKNOWN
    return STARVED if lost >= STARVED_FROM else SUFFICIENT


def domain_words(verdict, lost):
    """A verdict and its estimate in words."""
    if verdict == UNKNOWN:
        return "not judged: made by an older version"
    if verdict == SUFFICIENT:
        return f"sufficient: twice the size would change the film by some {lost:.1f} %"
    return (
        f"starved: twice the size would change the film by some {lost:.2g} %; "
        'grid.x = "auto" and grid.y = "auto" choose one as large as the nodes allow'
    )


def beyond_words(percent):
    """How much of the load the film in a domain need not carry, in a list; empty where hardly any."""
    words = f"{percent:.1f} % of it is carried beyond the domain or lost at its sides, the rest within"
    return [words] if percent >= 0.05 else []


def peaks_words(contact, mesh):
    """How far out peaks may touch, in a list; empty where the domain of a mesh holds them."""
    reach = reach_of_peaks(contact, contact.flooded_film)
    sides = zip(reach, (mesh.x,) if mesh.is_line else (mesh.x, mesh.y), "ab", strict=False)
    outside = [f"{peak:.2f} {unit}" for peak, ends, unit in sides if peak > min(-ends[0], ends[1])]
    if not outside:
        return []
    return [f"peaks may touch up to {' and '.join(outside)} from the centre, outside of it"]


def room_words(mesh):
    """The ends of a domain."""
    x = f"x from {mesh.x[0]:g} to {mesh.x[1]:g} a"
    return x if mesh.is_line else f"{x}, y from {mesh.y[0]:g} to {mesh.y[1]:g} b"
